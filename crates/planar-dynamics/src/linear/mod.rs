//! Linear algebra of the core, on slices: no allocation, no panic, any real scalar.
//!
//! [`factor`] and [`substitute`] solve symmetric systems, [`eliminate`] general ones, [`least_squares`] damped
//! least-squares problems.

mod ldlt;
mod least_squares;
mod lu;

pub(crate) use ldlt::{factor, solve, substitute};
pub(crate) use least_squares::least_squares;
pub(crate) use lu::eliminate;

use crate::error::Error;
use crate::scalar::Real;
use core::borrow::Borrow;

/// [`Error::Singular`] unless a relative pivot is larger than so many ε.
fn check_pivot<T: Real>(what: &'static str, relative: T, smallest: f64) -> Result<(), Error> {
    let (pivot, limit) = (relative.to_f64(), T::EPSILON.to_f64() * smallest);
    if pivot > limit { Ok(()) } else { Err(Error::Singular { what, pivot, limit }) }
}

/// Σ aᵢ bᵢ, in order, over the length of the shorter one.
pub(crate) fn dot<T: Real, B: Borrow<T>>(a: &[T], b: impl IntoIterator<Item = B>) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b.borrow())
}

/// Power of torques at rates: that of every other one, and of the rest.
#[cfg_attr(target_arch = "arm", inline)]
#[cfg_attr(not(target_arch = "arm"), inline(always))]
#[allow(clippy::inline_always, reason = "what it borrows would be in memory")]
pub(crate) fn power<T: Real>(torques: &[T], rates: &[T]) -> T {
    let ((torques, last_torque), (rates, last_rate)) = (torques.as_chunks(), rates.as_chunks());
    let [mut power, mut other] = [T::ZERO; 2];
    for (torques, rates) in torques.iter().zip(rates) {
        [power, other] = T::add_both([power, other], T::mul_both(*torques, *rates));
    }
    for (torque, rate) in last_torque.iter().zip(last_rate) {
        power += *torque * *rate;
    }
    power + other
}

/// The rows of a matrix with so many columns; none without columns.
///
/// `chunks_exact` would do, but it divides by a number that a build for size takes for a possible zero.
pub(crate) fn matrix_rows<T>(mut entries: &[T], columns: usize) -> impl Iterator<Item = &[T]> {
    core::iter::from_fn(move || {
        let (row, rest) = entries.split_at_checked(columns).filter(|_| columns > 0)?;
        entries = rest;
        Some(row)
    })
}

/// As [`matrix_rows`], with mutable rows.
pub(crate) fn matrix_rows_mut<T>(mut entries: &mut [T], columns: usize) -> impl Iterator<Item = &mut [T]> {
    core::iter::from_fn(move || {
        let (row, rest) = core::mem::take(&mut entries).split_at_mut_checked(columns).filter(|_| columns > 0)?;
        entries = rest;
        Some(row)
    })
}

/// `sum += factor · part`, over the length of the shorter one.
pub(crate) fn add_scaled<T: Real>(sum: &mut [T], factor: T, part: &[T]) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += factor * *part;
    }
}

/// Copies the length of the shorter slice; `copy_from_slice` could panic.
pub(crate) fn copy<T: Copy>(from: &[T], to: &mut [T]) {
    for (place, value) in to.iter_mut().zip(from) {
        *place = *value;
    }
}
