//! Part of a symmetric system of equations, solved in place.

use crate::error::Error;
use crate::scalar::Real;

/// A set of rows, by their bits: no more than 64.
pub(super) type Set = u64;

/// Whether a row is in a set.
pub(super) fn has(set: Set, row: usize) -> bool {
    row < 64 && set >> row & 1 == 1
}

/// A pivot beside its diagonal entry, in units of ε, that leaves three digits: of rows that depend on others, rounding leaves
/// more than a few ε, for their entries come from a model's own solution and the pivots before them.
const LEAST_PIVOT: f64 = 4096.0;

/// Solves `A x = b` for the rows and columns of a set by `L D Lᵀ`; x is zero for the others. `b` becomes x and `matrix`,
/// which is A row by row, its factors.
///
/// # Errors
/// [`Error::Singular`] where a pivot is no larger than rounding beside its diagonal entry: rows that depend on each other to
/// 1e-6 in double precision.
pub(super) fn solve<T: Real>(matrix: &mut [T], b: &mut [T], set: Set) -> Result<(), Error> {
    let n = b.len();
    let entry = |matrix: &[T], i: usize, j: usize| matrix.get(i * n + j).copied().unwrap_or(T::ZERO);
    for i in (0..n).filter(|i| has(set, *i)) {
        // row i of L D, then of L
        for j in (0..i).filter(|j| has(set, *j)) {
            let known =
                (0..j).filter(|k| has(set, *k)).fold(T::ZERO, |sum, k| sum + entry(matrix, i, k) * entry(matrix, j, k));
            if let Some(place) = matrix.get_mut(i * n + j) {
                *place -= known;
            }
        }
        let diagonal = entry(matrix, i, i);
        let mut left = diagonal;
        for j in (0..i).filter(|j| has(set, *j)) {
            let scaled = entry(matrix, i, j);
            let lower = scaled / entry(matrix, j, j);
            left -= scaled * lower;
            if let Some(place) = matrix.get_mut(i * n + j) {
                *place = lower;
            }
        }
        pivot(left / diagonal)?;
        if let Some(place) = matrix.get_mut(i * n + i) {
            *place = left;
        }
    }
    for i in 0..n {
        let known = (0..i).filter(|j| has(set, *j)).fold(T::ZERO, |sum, j| sum + entry(matrix, i, j) * at(b, j));
        put(b, i, if has(set, i) { at(b, i) - known } else { T::ZERO });
    }
    for i in (0..n).rev().filter(|i| has(set, *i)) {
        let beyond = (i + 1..n).filter(|j| has(set, *j)).fold(T::ZERO, |sum, j| sum + entry(matrix, j, i) * at(b, j));
        put(b, i, at(b, i) / entry(matrix, i, i) - beyond);
    }
    Ok(())
}

/// Whether a relative pivot says more than rounding.
fn pivot<T: Real>(ratio: T) -> Result<(), Error> {
    let (pivot, limit) = (ratio.to_f64(), T::EPSILON.to_f64() * LEAST_PIVOT);
    if pivot > limit {
        Ok(())
    } else {
        Err(Error::Singular { what: "the inverse inertia at the contacts", pivot, limit })
    }
}

fn at<T: Real>(values: &[T], i: usize) -> T {
    values.get(i).copied().unwrap_or(T::ZERO)
}

fn put<T: Real>(values: &mut [T], i: usize, value: T) {
    if let Some(place) = values.get_mut(i) {
        *place = value;
    }
}
