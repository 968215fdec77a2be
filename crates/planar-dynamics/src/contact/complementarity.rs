//! Contacts that push but do not pull.

use super::constraint_row::{Set, has};
use crate::error::Error;
use crate::linear::{dot, solve};
use crate::scalar::Real;

/// The most exchanges that are tried; a dozen rows take a handful.
const MOST_EXCHANGES: u32 = 10_000;

/// Finds impulses p with `u⁺ = W p + u`: for bilateral rows u⁺ = 0; for the others p ≥ 0, u⁺ ≥ 0 and p u⁺ = 0.
///
/// Murty's least-index principal pivoting, which ends because W is positive definite. `factors` is working space of W's
/// size.
///
/// # Errors
/// [`Error::Singular`] where the rows that carry impulses depend on each other; [`Error::Exhausted`].
pub(super) fn solve_contacts<T: Real>(
    matrix: &[T],
    velocities: &[T],
    bilateral: Set,
    factors: &mut [T],
    impulses: &mut [T],
) -> Result<(), Error> {
    let n = velocities.len();
    // bounces join one by one: two that say the same never both do
    let mut active: Set = bilateral;
    for _ in 0..MOST_EXCHANGES {
        for (impulse, velocity) in impulses.iter_mut().zip(velocities) {
            *impulse = -*velocity;
        }
        solve_rows(matrix, active, factors, impulses)?;
        let rows = matrix.chunks_exact(n.max(1)).zip(velocities);
        let wrong = rows.enumerate().find(|(i, (row, velocity))| {
            let impulse = impulses.get(*i).copied().unwrap_or(T::ZERO);
            if has(bilateral, *i) {
                return false;
            }
            if has(active, *i) {
                return impulse < T::ZERO;
            }
            let sizes = row.iter().zip(&*impulses).fold(velocity.abs(), |sum, (w, p)| sum + (*w * *p).abs());
            **velocity + dot(row, &*impulses) < -(T::EPSILON * T::constant(16.0) * sizes)
        });
        match wrong {
            Some((i, _)) => active ^= 1 << i,
            None => return Ok(()),
        }
    }
    Err(Error::Exhausted { what: "the impulses of the contacts", rounds: MOST_EXCHANGES })
}

/// Solves `W x = b` for the rows and columns of a set; x is zero for the others. b becomes x, `factors` is working
/// space of W's size.
///
/// # Errors
/// [`Error::Singular`] where rows depend on each other: to 1e-6 in double precision.
pub(super) fn solve_rows<T: Real>(matrix: &[T], set: Set, factors: &mut [T], b: &mut [T]) -> Result<(), Error> {
    let n = b.len().max(1);
    // rows and columns outside of the set are those of the unit matrix
    for (i, (place, row)) in factors.chunks_exact_mut(n).zip(matrix.chunks_exact(n)).enumerate() {
        for (j, (place, entry)) in place.iter_mut().zip(row).enumerate() {
            *place = match has(set, i) && has(set, j) {
                true => *entry,
                false if i == j => T::ONE,
                false => T::ZERO,
            };
        }
    }
    for (i, b) in b.iter_mut().enumerate() {
        *b = if has(set, i) { *b } else { T::ZERO };
    }
    solve("the inverse inertia at the contacts", factors, b)
}
