//! Linear algebra of the core, on slices: no allocation, no panic, any real scalar.
//!
//! One solver of symmetric systems ([`factor`], [`substitute`]), one of least squares ([`least_squares`]), one [`dot`].

mod ldlt;
mod least_squares;

pub(crate) use ldlt::{factor, solve, substitute};
pub(crate) use least_squares::least_squares;

use crate::scalar::Real;
use core::borrow::Borrow;

/// Σ aᵢ bᵢ, in order, over as many as both have.
pub(crate) fn dot<T: Real, B: Borrow<T>>(a: &[T], b: impl IntoIterator<Item = B>) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b.borrow())
}

/// Copies what both have room for; `copy_from_slice` could panic.
pub(crate) fn copy<T: Real>(from: &[T], to: &mut [T]) {
    for (place, value) in to.iter_mut().zip(from) {
        *place = *value;
    }
}
