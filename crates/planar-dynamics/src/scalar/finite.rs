//! Whether numbers are finite.

use super::real::Real;

/// Whether the numbers of all slices are finite: 0 x is 0 where x is, else NaN. There is no branch per number.
///
/// A processor with vectors compares several at once, and would wait for a sum. One without adds instead: an addition each,
/// and only where the sum overflows each is looked at.
#[inline]
#[must_use]
#[allow(clippy::needless_bitwise_bool, reason = "a branch per number costs more than the comparison")]
pub fn all_finite<T: Real, const N: usize>(slices: [&[T]; N]) -> bool {
    if cfg!(not(target_arch = "arm")) {
        let each = |all, values: &[T]| values.iter().fold(all, |all, value| all & (*value * T::ZERO == T::ZERO));
        return slices.into_iter().fold(true, each);
    }
    let sums = slices.map(|values| values.iter().fold(T::ZERO, |sum, value| sum + *value));
    let sum = sums.iter().fold(T::ZERO, |sum, value| sum + *value);
    sum * T::ZERO == T::ZERO || is_each_finite(slices)
}

#[cold]
#[inline(never)]
fn is_each_finite<T: Real, const N: usize>(slices: [&[T]; N]) -> bool {
    slices.iter().all(|values| values.iter().all(|value| value.is_finite()))
}
