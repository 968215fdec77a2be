//! What generated code needs of a number.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number that generated code computes with: `f32`, `f64`, SIMD lanes, dual numbers.
///
/// Straight-line code needs no comparison but [`Scalar::minimum`], so lanes do.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// 0, in every lane.
    const ZERO: Self;
    /// 1, in every lane.
    const ONE: Self;

    /// The nearest value to `value`, in every lane.
    fn constant(value: f64) -> Self;

    /// (sine, cosine) of an angle in rad.
    fn sin_cos(self) -> (Self, Self);

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// The angle of the vector (`x`, `self`), in rad, −π to π; 0 for the null vector.
    #[must_use]
    fn atan2(self, x: Self) -> Self;

    /// The smaller of two values. Which of them where one is NaN is open.
    #[must_use]
    fn minimum(self, other: Self) -> Self;
}

/// A [`Scalar`] that is one real number, so that it can be compared and reported: `f32`, `f64`.
pub trait Real: Scalar + nalgebra::RealField + Copy {
    /// Rounding unit: the distance from 1 to the next larger number.
    const EPSILON: Self;

    /// The value as `f64`, for reports.
    fn to_f64(self) -> f64;
}

macro_rules! float {
    ($float:ident, $sincos:ident, $sqrt:ident, $atan2:ident) => {
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
                #[cfg(feature = "std")]
                return $float::sin_cos(self);
                #[cfg(not(feature = "std"))]
                libm::$sincos(self)
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
        }
    };
}

float!(f32, sincosf, sqrtf, atan2f);
float!(f64, sincos, sqrt, atan2);
