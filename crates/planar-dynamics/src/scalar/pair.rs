//! Pairs of scalars: what generated code computes for two arms of equal structure at once.

#![allow(clippy::inline_always, reason = "a call would pass pairs through memory")]

use super::Scalar;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// Two scalars, with the operations of each, number by number: a vector of the processor where it has one of two `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair<T> {
    /// Of the earlier arm.
    pub first: T,
    /// Of the later arm.
    pub second: T,
}

impl<T: Scalar> Pair<T> {
    /// Of two numbers.
    #[inline(always)]
    #[must_use]
    pub fn new(first: T, second: T) -> Self {
        Self { first, second }
    }

    /// A number that both arms have.
    #[inline(always)]
    #[must_use]
    pub fn both(number: T) -> Self {
        Self { first: number, second: number }
    }

    /// `self` · `factor` + `addend`, as [`Scalar::mul_add`].
    #[inline(always)]
    #[must_use]
    pub fn mul_add(self, factor: Self, addend: Self) -> Self {
        T::mul_add_pairs(self, factor, addend)
    }
}

impl<T: Scalar> Neg for Pair<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        T::neg_pair(self)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $of_pairs:ident) => {
        impl<T: Scalar> $trait for Pair<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                T::$of_pairs(self, other)
            }
        }
    };
}

operator!(Add, add, add_pairs);
operator!(Sub, sub, sub_pairs);
operator!(Mul, mul, mul_pairs);
operator!(Div, div, div_pairs);

/// The methods of the trait: number by number.
macro_rules! number_by_number {
    ($($method:ident $operator:tt)*) => {
        $(
            #[doc(hidden)]
            #[allow(clippy::inline_always, reason = "a call would pass pairs through memory")]
            #[inline(always)]
            #[must_use]
            fn $method(a: Pair<Self>, b: Pair<Self>) -> Pair<Self> {
                Pair { first: a.first $operator b.first, second: a.second $operator b.second }
            }
        )*

        #[doc(hidden)]
        #[allow(clippy::inline_always, reason = "a call would pass pairs through memory")]
        #[inline(always)]
        #[must_use]
        fn neg_pair(a: Pair<Self>) -> Pair<Self> {
            Pair { first: -a.first, second: -a.second }
        }

        #[doc(hidden)]
        #[allow(clippy::inline_always, reason = "a call would pass pairs through memory")]
        #[inline(always)]
        #[must_use]
        fn mul_add_pairs(a: Pair<Self>, b: Pair<Self>, c: Pair<Self>) -> Pair<Self> {
            Pair { first: a.first.mul_add(b.first, c.first), second: a.second.mul_add(b.second, c.second) }
        }
    };
}

/// The methods for one of the two floats: vectors for `f64`, where the processor has them.
macro_rules! at_once {
    (f32) => {};
    (f64) => {
        $crate::scalar::pair::at_once!(add_pairs + sub_pairs - mul_pairs * div_pairs /);
    };
    ($($method:ident $operator:tt)*) => {
        $(
            #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
            #[inline(always)]
            fn $method(a: $crate::scalar::Pair<f64>, b: $crate::scalar::Pair<f64>) -> $crate::scalar::Pair<f64> {
                (wide::f64x2::from(a) $operator wide::f64x2::from(b)).into()
            }
        )*

        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
        #[inline(always)]
        fn neg_pair(a: $crate::scalar::Pair<f64>) -> $crate::scalar::Pair<f64> {
            (-wide::f64x2::from(a)).into()
        }

        #[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
        #[inline(always)]
        fn mul_add_pairs(
            a: $crate::scalar::Pair<f64>,
            b: $crate::scalar::Pair<f64>,
            c: $crate::scalar::Pair<f64>,
        ) -> $crate::scalar::Pair<f64> {
            let [a, b, c] = [a, b, c].map(wide::f64x2::from);
            (if cfg!(feature = "fused") { a.mul_add(b, c) } else { a * b + c }).into()
        }
    };
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
impl From<Pair<f64>> for wide::f64x2 {
    #[inline(always)]
    fn from(pair: Pair<f64>) -> Self {
        Self::new([pair.first, pair.second])
    }
}

#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
impl From<wide::f64x2> for Pair<f64> {
    #[inline(always)]
    fn from(vector: wide::f64x2) -> Self {
        let [first, second] = vector.to_array();
        Self { first, second }
    }
}

pub(super) use {at_once, number_by_number};
