//! Contacts that push but do not pull.

use super::cholesky::{Set, has, solve};
use super::row::{copy, dot};
use crate::error::Error;
use crate::scalar::Real;

/// The most exchanges that are tried; a dozen rows take a handful.
const MOST_EXCHANGES: u32 = 10_000;

/// Finds impulses p with `u⁺ = W p + u`: for bilateral rows u⁺ = 0; for the others p ≥ 0, u⁺ ≥ 0 and p u⁺ = 0.
///
/// Murty's least-index principal pivoting, which ends because W is positive definite. `factors` is working space of W's size.
///
/// # Errors
/// [`Error::Singular`] where the rows that carry impulses depend on each other.
pub(super) fn solve_contacts<T: Real>(
    matrix: &[T],
    velocities: &[T],
    bilateral: Set,
    factors: &mut [T],
    impulses: &mut [T],
) -> Result<(), Error> {
    let n = velocities.len();
    let negative = |(i, u): (usize, &T)| if *u < T::ZERO && i < 64 { 1 << i } else { 0 };
    let mut active = velocities.iter().enumerate().map(negative).fold(bilateral, |set: Set, bit| set | bit);
    for _ in 0..MOST_EXCHANGES {
        copy(matrix, factors);
        for (impulse, velocity) in impulses.iter_mut().zip(velocities) {
            *impulse = -*velocity;
        }
        solve(factors, impulses, active)?;
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
            **velocity + dot(row, impulses) < -(T::EPSILON * T::constant(16.0) * sizes)
        });
        match wrong {
            Some((i, _)) => active ^= 1 << i,
            None => return Ok(()),
        }
    }
    Err(Error::Singular { what: "the inverse inertia at the contacts", pivot: 0.0, limit: 0.0 })
}
