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
        T::mul_add_both(self.into(), factor.into(), addend.into()).into()
    }
}

impl<T> From<Pair<T>> for [T; 2] {
    #[inline(always)]
    fn from(pair: Pair<T>) -> Self {
        [pair.first, pair.second]
    }
}

impl<T> From<[T; 2]> for Pair<T> {
    #[inline(always)]
    fn from([first, second]: [T; 2]) -> Self {
        Self { first, second }
    }
}

impl<T: Scalar> Neg for Pair<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        T::neg_both(self.into()).into()
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $both:ident) => {
        impl<T: Scalar> $trait for Pair<T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                T::$both(self.into(), other.into()).into()
            }
        }
    };
}

operator!(Add, add, add_both);
operator!(Sub, sub, sub_both);
operator!(Mul, mul, mul_both);
operator!(Div, div, div_both);

#[cfg(test)]
mod tests {
    use super::{Pair, Scalar};
    use crate::scalar::{Dual, Real};

    /// Operations on pairs have the bits of those on their numbers, in vectors or not.
    #[test]
    fn operations_have_the_bits_of_each_number() {
        fn compare<T: Scalar>(numbers: &[T], bits: impl Fn(T) -> [u64; 2]) {
            let size = numbers.len();
            let at = |i: usize| numbers[i % size];
            for i in 0..size * size {
                let one = [at(i), at(i / size), at(i + i / size + 1)];
                let other = [at(i + 3), at(i / size + 5), at(2 * i + 1)];
                let [a, b, c] = [0, 1, 2].map(|place| Pair::new(one[place], other[place]));
                let of_each = |operation: fn([T; 3]) -> T| [operation(one), operation(other)];
                for (found, expected) in [
                    (a + b, of_each(|[a, b, _]| a + b)),
                    (a - b, of_each(|[a, b, _]| a - b)),
                    (a * b, of_each(|[a, b, _]| a * b)),
                    (a / b, of_each(|[a, b, _]| a / b)),
                    (-a, of_each(|[a, ..]| -a)),
                    (a.mul_add(b, c), of_each(|[a, b, c]| a.mul_add(b, c))),
                    (Pair::both(a.first), [a.first; 2]),
                ] {
                    assert_eq!([found.first, found.second].map(&bits), expected.map(&bits));
                }
            }
        }

        /// One NaN is as good as another.
        fn of<T: Real>(number: T) -> u64 {
            let number = number.to_f64();
            if number.is_nan() { u64::MAX } else { number.to_bits() }
        }

        let special = [0.0, -0.0, 1.0, -3.5, 0.1, f64::INFINITY, f64::NAN, f64::MAX, 5e-324, 1e-160, -7.3e150];
        compare(&special, |number| [of(number), 0]);
        #[allow(clippy::cast_possible_truncation, reason = "infinite and zero in f32, too")]
        compare(&special.map(|number| number as f32), |number| [of(number), 0]);
        let dual = special.map(|number| Dual(number, 0.5 - number));
        compare(&dual, |Dual(value, rate)| [of(value), of(rate)]);
    }
}
