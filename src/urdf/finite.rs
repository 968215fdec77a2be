//! Refuses numbers that are not finite.

use super::UrdfError;

/// The numbers, if they are finite.
pub(super) fn finite<const N: usize>(
    what: &str,
    numbers: [f64; N],
    problem: impl FnOnce(String, &'static str) -> UrdfError,
) -> Result<[f64; N], UrdfError> {
    if numbers.iter().all(|number| number.is_finite()) {
        Ok(numbers)
    } else {
        Err(problem(format!("{what} is {numbers:?}"), "expected finite numbers"))
    }
}
