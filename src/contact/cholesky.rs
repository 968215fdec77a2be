//! Part of a symmetric system of equations, solved in place.

use crate::check::pivot;
use crate::error::Error;
use crate::scalar::Real;

/// A set of rows, by their bits: no more than 64.
pub(super) type Set = u64;

/// Whether a row is in a set.
pub(super) fn has(set: Set, row: usize) -> bool {
    row < 64 && set >> row & 1 == 1
}

/// Solves `A x = b` for the rows and columns of a set by `L D Lᵀ`; x is zero for the others. `b` becomes x and `matrix`,
/// which is A row by row, its factors.
///
/// # Errors
/// [`Error::Singular`] where a pivot is no larger than rounding beside its diagonal entry.
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
        pivot("the inverse inertia at the contacts", left / diagonal)?;
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

fn at<T: Real>(values: &[T], i: usize) -> T {
    values.get(i).copied().unwrap_or(T::ZERO)
}

fn put<T: Real>(values: &mut [T], i: usize, value: T) {
    if let Some(place) = values.get_mut(i) {
        *place = value;
    }
}
