//! Solves symmetric positive definite systems of equations by the factors `A = L D Lᵀ`.

use super::{add_scaled, check_pivot, dot, matrix_rows};
use crate::error::Error;
use crate::scalar::Real;

/// The smallest pivot relative to its own diagonal entry, in units of ε: with a smaller one a solution may have fewer than
/// three correct digits. Linearly dependent rows leave pivots of a few ε, because the entries of most matrices here are
/// solutions of other systems.
const SMALLEST_PIVOT: f64 = 4096.0;

/// Factors a symmetric matrix of `size` rows in place: D on the diagonal, L below it. Entries above the diagonal are
/// neither read nor changed.
///
/// # Errors
/// [`Error::Singular`] unless every pivot is larger than 4096 ε times its diagonal entry, and that is positive; the
/// matrix is then partly factored.
pub(crate) fn factor<T: Real>(what: &'static str, matrix: &mut [T], size: usize) -> Result<(), Error> {
    for i in 0..size {
        let Some((above, rest)) = matrix.split_at_mut_checked(i * size) else { continue };
        // row i of L D, then of L
        for (j, factors) in matrix_rows(above, size).enumerate() {
            let Some((known, [place, ..])) = rest.split_at_mut_checked(j) else { continue };
            *place -= dot(known, factors);
        }
        let Some((lower, [pivot, ..])) = rest.split_at_mut_checked(i) else { continue };
        let diagonal = *pivot;
        for (entry, divisor) in lower.iter_mut().zip(above.iter().step_by(size + 1)) {
            let scaled = *entry;
            *entry = scaled / *divisor;
            *pivot -= scaled * *entry;
        }
        check_pivot(what, *pivot / diagonal.abs(), SMALLEST_PIVOT)?;
    }
    Ok(())
}

/// Solves `L D Lᵀ x = b` with the factors of [`factor`]; b becomes x.
pub(crate) fn substitute<T: Real>(factors: &[T], right: &mut [T]) {
    let size = right.len();
    for (i, row) in matrix_rows(factors, size).enumerate().take(size) {
        if let Some((solved, [value, ..])) = right.split_at_mut_checked(i) {
            *value -= dot(solved, row);
        }
    }
    for (value, divisor) in right.iter_mut().zip(factors.iter().step_by(size + 1)) {
        *value /= *divisor;
    }
    for i in (0..size).rev() {
        if let (Some((unsolved, [value, ..])), Some(row)) = (right.split_at_mut_checked(i), factors.get(i * size..)) {
            add_scaled(unsolved, -*value, row);
        }
    }
}

/// Solves `A x = b` by [`factor`] and [`substitute`]; A becomes its factors, b becomes x.
///
/// # Errors
/// As [`factor`].
pub(crate) fn solve<T: Real>(what: &'static str, matrix: &mut [T], right: &mut [T]) -> Result<(), Error> {
    factor(what, matrix, right.len())?;
    substitute(matrix, right);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::solve;
    use crate::error::Error;

    #[test]
    fn a_small_system() {
        // the entries above the diagonal are not read
        let (mut matrix, mut right) = ([4.0, 0.0, 0.0, 2.0, 5.0, 0.0, 1.0, 3.0, 6.0], [7.0, 10.0, 10.0_f64]);
        assert_eq!(solve("A", &mut matrix, &mut right), Ok(()));
        for x in right {
            assert!((x - 1.0).abs() < 1e-15, "{right:?}");
        }
    }

    #[test]
    fn matrices_that_are_not_positive_definite_are_rejected() {
        let assert_singular = |mut matrix: [f64; 4]| {
            let result = solve("A", &mut matrix, &mut [1.0, 1.0]);
            assert!(matches!(result, Err(Error::Singular { what: "A", .. })), "{matrix:?}: {result:?}");
        };
        assert_singular([1.0, 2.0, 2.0, 4.0]);
        assert_singular([1.0, 1.0, 1.0, 1.0 + 1e-13]);
        assert_singular([-1.0, 0.0, 0.0, -1.0]);
        assert_singular([0.0, 0.0, 0.0, 1.0]);
        assert_singular([f64::NAN, 0.0, 0.0, 1.0]);
    }
}
