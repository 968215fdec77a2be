//! The trait of scalars that are a single real number.

use super::Scalar;
use core::fmt::{Debug, Display};
use core::ops::{AddAssign, DivAssign, MulAssign, SubAssign};

/// A [`Scalar`] that is a single real number, which can be compared and reported: `f32`, `f64`.
pub trait Real:
    Scalar + PartialOrd + AddAssign + SubAssign + MulAssign + DivAssign + Debug + Display + Default + 'static
{
    /// Rounding unit: the distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The value as `f64`, for reports.
    fn to_f64(self) -> f64;

    /// The nearest value to an integer.
    #[must_use]
    fn from_word(word: u32) -> Self {
        Self::constant(f64::from(word))
    }

    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool;

    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The larger of two values; NaN where either is, so that it shows in the largest of many.
    #[must_use]
    fn maximum(self, other: Self) -> Self {
        let is_nan = self.partial_cmp(&self).is_none();
        if self > other || is_nan { self } else { other }
    }

    /// The value, or where its magnitude exceeds `limit`, `limit` with the value's sign.
    #[must_use]
    fn limit_magnitude(self, limit: Self) -> Self {
        match self.abs() > limit {
            true if self < Self::ZERO => -limit,
            true => limit,
            false => self,
        }
    }

    /// 1 over the value.
    #[must_use]
    fn recip(self) -> Self {
        Self::ONE / self
    }
}

macro_rules! float {
    ($float:ident) => {
        impl Real for $float {
            const EPSILON: Self = $float::EPSILON;

            #[inline]
            #[allow(clippy::cast_lossless, reason = "f64 to f64 in one of the two")]
            fn to_f64(self) -> f64 {
                self as f64
            }

            /// In one instruction, where doubles would take many.
            #[inline]
            #[allow(clippy::cast_lossless, clippy::cast_precision_loss, reason = "rounding to the scalar")]
            fn from_word(word: u32) -> Self {
                word as $float
            }

            #[inline]
            fn is_finite(self) -> bool {
                $float::is_finite(self)
            }

            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
        }
    };
}

float!(f32);
float!(f64);
