//! Impulses of contacts that push but do not pull: a linear complementarity problem.

use super::constraint_row::{RowSet, contains};
use crate::error::Error;
use crate::linear::{dot, matrix_rows, matrix_rows_mut, solve};
use crate::scalar::Real;

/// A dozen rows take a few exchanges.
const MAXIMUM_EXCHANGES: u32 = 10_000;

/// Finds impulses p with `u⁺ = W p + u`: u⁺ = 0 for bilateral rows; p ≥ 0, u⁺ ≥ 0 and p u⁺ = 0 for the others.
///
/// Murty's least-index principal pivoting, which ends because W is positive definite. `factors` is working space of W's
/// size.
///
/// # Errors
/// [`Error::Singular`] where the rows with impulses depend on each other; [`Error::Exchanges`].
pub(super) fn solve_contacts<T: Real>(
    matrix: &[T],
    velocities: &[T],
    bilateral: RowSet,
    factors: &mut [T],
    impulses: &mut [T],
) -> Result<(), Error> {
    let n = velocities.len();
    // unilateral rows become active one by one: of two dependent rows only one does
    let mut active = bilateral;
    for _ in 0..MAXIMUM_EXCHANGES {
        for (impulse, velocity) in impulses.iter_mut().zip(velocities) {
            *impulse = -*velocity;
        }
        solve_rows(matrix, active, factors, impulses)?;
        let rows = matrix_rows(matrix, n).zip(velocities.iter().zip(&*impulses)).enumerate();
        let violated = rows.filter(|(i, _)| !contains(bilateral, *i)).find(|(i, (row, (velocity, impulse)))| {
            if contains(active, *i) {
                return **impulse < T::ZERO;
            }
            let terms = row.iter().zip(&*impulses).fold(velocity.abs(), |sum, (w, p)| sum + (*w * *p).abs());
            **velocity + dot(row, &*impulses) < -(T::EPSILON * T::constant(16.0) * terms)
        });
        match violated {
            Some((i, _)) => active ^= 1 << i,
            None => return Ok(()),
        }
    }
    Err(Error::Exchanges { what: "the impulses of the contacts", exchanges: MAXIMUM_EXCHANGES })
}

/// Solves `W x = b` for the rows and columns of a set; x is zero for the others. b becomes x; `factors` is working space
/// of W's size.
///
/// # Errors
/// [`Error::Singular`] where rows depend on each other: to 1e-6 in double precision.
pub(super) fn solve_rows<T: Real>(matrix: &[T], set: RowSet, factors: &mut [T], b: &mut [T]) -> Result<(), Error> {
    let n = b.len().max(1);
    // rows and columns outside the set are those of the unit matrix
    for (i, (factors, row)) in matrix_rows_mut(factors, n).zip(matrix_rows(matrix, n)).enumerate() {
        for (j, (factor, entry)) in factors.iter_mut().zip(row).enumerate() {
            *factor = match contains(set, i) && contains(set, j) {
                true => *entry,
                false if i == j => T::ONE,
                false => T::ZERO,
            };
        }
    }
    for (_, b) in b.iter_mut().enumerate().filter(|(i, _)| !contains(set, *i)) {
        *b = T::ZERO;
    }
    solve("the inverse inertia at the contacts", factors, b)
}
