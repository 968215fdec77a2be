//! Linear algebra of the core, on slices: no allocation, no panic, any real scalar.
//!
//! [`factor`] and [`substitute`] solve symmetric systems, [`least_squares`] damped least-squares problems.

mod ldlt;
mod least_squares;

pub(crate) use ldlt::{factor, solve, substitute};
pub(crate) use least_squares::least_squares;

use crate::scalar::Real;
use core::borrow::Borrow;

/// Σ aᵢ bᵢ, in order, over the length of the shorter one.
pub(crate) fn dot<T: Real, B: Borrow<T>>(a: &[T], b: impl IntoIterator<Item = B>) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b.borrow())
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
