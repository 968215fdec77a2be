//! Dual numbers.

use super::{Real, Scalar};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative along one direction: the derivative of whatever is computed with it, exact to rounding.
///
/// A model of dual numbers gives directional derivatives of all its functions, by any input and parameter. Each costs
/// about three evaluations; for matrices of derivatives there is generated code.
///
/// Square root and arctangent have no derivative at 0 and at the null vector: it is not finite there, unless the operands
/// do not change along the direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual<T = f64>(pub T, pub T);

impl<T: Real> Add for Dual<T> {
    type Output = Self;
    #[inline]
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}

impl<T: Real> Sub for Dual<T> {
    type Output = Self;
    #[inline]
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}

impl<T: Real> Mul for Dual<T> {
    type Output = Self;
    #[inline]
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0, self.1 * b.0 + self.0 * b.1)
    }
}

impl<T: Real> Div for Dual<T> {
    type Output = Self;
    #[inline]
    fn div(self, b: Self) -> Self {
        let quotient = self.0 / b.0;
        Self(quotient, (self.1 - quotient * b.1) / b.0)
    }
}

impl<T: Real> Neg for Dual<T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

/// a / b, and 0 for a = 0 whatever b is.
fn quotient<T: Real>(a: T, b: T) -> T {
    if a == T::ZERO { a } else { a / b }
}

impl<T: Real> Dual<T> {
    /// Sine and cosine of the angle, of which the values are known.
    #[inline]
    fn with_rates(self, (sin, cos): (T, T)) -> (Self, Self) {
        (Self(sin, cos * self.1), Self(cos, -(sin * self.1)))
    }
}

impl<T: Real> Scalar for Dual<T> {
    const ZERO: Self = Self(T::ZERO, T::ZERO);
    const ONE: Self = Self(T::ONE, T::ZERO);

    #[inline]
    fn constant(value: f64) -> Self {
        Self(T::constant(value), T::ZERO)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        self.with_rates(self.0.sin_cos())
    }

    fn sin_cos_of_sums<const N: usize, const K: usize, const M: usize>(
        sums: [Self; N],
        some: [Self; K],
        others: &[Self; M],
    ) -> [(Self, Self); N] {
        let values = T::sin_cos_of_sums(sums.map(|sum| sum.0), some.map(|angle| angle.0), &others.map(|angle| angle.0));
        let mut of_sums = sums.map(|sum| (sum, sum));
        for (of_sum, values) in of_sums.iter_mut().zip(values) {
            *of_sum = of_sum.0.with_rates(values);
        }
        of_sums
    }

    #[inline]
    fn saturated(self) -> Self {
        Self(self.0.saturated(), self.1)
    }

    #[inline]
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        Self(root, quotient(self.1, root + root))
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        let square = self.0 * self.0 + x.0 * x.0;
        let is_constant = self.1 == T::ZERO && x.1 == T::ZERO;
        let rate = if is_constant { T::ZERO } else { (x.0 * self.1 - self.0 * x.1) / square };
        Self(self.0.atan2(x.0), rate)
    }

    #[inline]
    fn minimum(self, other: Self) -> Self {
        let is_nan = self.0.partial_cmp(&self.0).is_none();
        if self.0 < other.0 || is_nan { self } else { other }
    }
}
