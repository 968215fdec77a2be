//! Numbers that are one real number.

use super::Scalar;
use super::sine;
use core::fmt::{Debug, Display};
use core::ops::{AddAssign, DivAssign, MulAssign, SubAssign};

/// A [`Scalar`] that is one real number, so that it can be compared and reported: `f32`, `f64`.
pub trait Real:
    Scalar + PartialOrd + AddAssign + SubAssign + MulAssign + DivAssign + Debug + Display + Default + 'static
{
    /// Rounding unit: the distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The value as `f64`, for reports.
    fn to_f64(self) -> f64;

    /// Neither NaN nor infinite.
    fn is_finite(self) -> bool;

    /// Absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// 1 over the value.
    #[must_use]
    fn recip(self) -> Self {
        Self::ONE / self
    }
}

macro_rules! float {
    ($float:ident, $sin_cos:ident, $sqrt:ident, $atan2:ident) => {
        impl Scalar for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline]
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_lossless,
                reason = "rounding to the scalar is what is asked for"
            )]
            fn constant(value: f64) -> Self {
                value as $float
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                sine::$sin_cos(self)
            }

            #[inline]
            fn sqrt(self) -> Self {
                libm::$sqrt(self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                libm::$atan2(self, x)
            }

            #[inline]
            fn minimum(self, other: Self) -> Self {
                if other < self { other } else { self }
            }
        }

        impl Real for $float {
            const EPSILON: Self = $float::EPSILON;

            #[inline]
            #[allow(clippy::cast_lossless, reason = "f64 to f64 in one of the two")]
            fn to_f64(self) -> f64 {
                self as f64
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

float!(f32, sin_cos_f32, sqrtf, atan2f);
float!(f64, sin_cos_f64, sqrt, atan2);
