//! Symmetric positive definite systems on slices.

use crate::check::pivot;
use crate::error::Error;
use crate::scalar::Real;

/// Puts `A⁻¹ right` into `right`, by elimination; `matrix` (row-major, the square of `right`'s length) is used up.
///
/// # Errors
/// [`Error::Singular`] where a pivot is no larger than rounding beside the largest diagonal entry.
pub(super) fn solve<T: Real>(what: &'static str, matrix: &mut [T], right: &mut [T]) -> Result<(), Error> {
    let n = right.len();
    let diagonal = matrix.iter().step_by(n + 1);
    let scale = diagonal.fold(T::ZERO, |most, entry| if *entry > most { *entry } else { most });
    for k in 0..n {
        let Some((head, below)) = matrix.split_at_mut_checked((k + 1) * n) else { continue };
        let Some((row, (solved, open))) = head.get(k * n..).zip(right.split_at_mut_checked(k + 1)) else { continue };
        let (Some(diagonal), Some(value)) = (row.get(k), solved.last()) else { continue };
        pivot(what, *diagonal / scale)?;
        for (other, right) in below.chunks_exact_mut(n.max(1)).zip(open) {
            let Some(factor) = other.get(k).map(|entry| *entry / *diagonal) else { continue };
            for (entry, above) in other.iter_mut().zip(row).skip(k) {
                *entry -= factor * *above;
            }
            *right -= factor * *value;
        }
    }
    for k in (0..n).rev() {
        let Some((head, solved)) = right.split_at_mut_checked(k + 1) else { continue };
        let (Some(value), Some(row)) = (head.last_mut(), matrix.get(k * n..(k + 1) * n)) else { continue };
        let known = row.iter().skip(k + 1).zip(solved.iter());
        let sum = known.fold(*value, |sum, (entry, x)| sum - *entry * *x);
        if let Some(diagonal) = row.get(k) {
            *value = sum / *diagonal;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::solve;
    use crate::error::Error;

    #[test]
    fn a_small_system_and_a_singular_one() {
        let (mut matrix, mut right) = ([4.0, 2.0, 1.0, 2.0, 5.0, 3.0, 1.0, 3.0, 6.0], [7.0, 10.0, 10.0_f64]);
        assert_eq!(solve("A", &mut matrix, &mut right), Ok(()));
        for x in right {
            assert!((x - 1.0).abs() < 1e-15, "{right:?}");
        }
        let singular = solve("A", &mut [1.0, 2.0, 2.0, 4.0], &mut [1.0, 1.0_f64]);
        assert!(matches!(singular, Err(Error::Singular { what: "A", .. })), "{singular:?}");
    }
}
