//! `f32` and `f64` as scalars, with `core` alone.
//!
//! Arctangents are those of parameters, once per model: they are accurate rather than fast.

use super::accelerated::{mul_add_f32, mul_add_f64, sin_cos_all_f32, sin_cos_all_f64, sqrt_f64};
use super::number::Scalar;
use super::sine::{sin_cos_f32, sin_cos_f64};

/// Angle of the vector (x, y) by three steps that add the tangent of the remaining angle; each leaves its cube.
fn atan2(y: f64, x: f64) -> f64 {
    let size = x.abs().max(y.abs());
    if size == 0.0 {
        return 0.0;
    }
    if !size.is_finite() {
        return f64::NAN;
    }
    let (x, y) = (x / size, y / size);
    let half = if y < 0.0 { -core::f64::consts::PI } else { core::f64::consts::PI };
    // within 0.1 rad: linear between multiples of 45°
    let quarter = 0.5 * half;
    let mut angle = match (x.abs() < y.abs(), x < 0.0) {
        (true, _) => quarter - x * half / 4.0,
        (false, false) => y * core::f64::consts::FRAC_PI_4,
        (false, true) => half - y * core::f64::consts::FRAC_PI_4,
    };
    for _ in 0..3 {
        let (s, c) = sin_cos_f64(angle);
        angle += (y * c - x * s) / (x * c + y * s);
    }
    angle
}

macro_rules! scalar {
    ($float:ident, $sin_cos:ident, $sin_cos_all:ident, $mul_add:ident) => {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_lossless,
            clippy::unnecessary_cast,
            reason = "rounding to the scalar, which is f64 in one of the two"
        )]
        impl Scalar for $float {
            const ZERO: Self = 0.0;
            const ONE: Self = 1.0;

            #[inline]
            fn constant(value: f64) -> Self {
                value as $float
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $sin_cos(self)
            }

            #[allow(clippy::inline_always, reason = "a call would pass all angles through memory")]
            #[inline(always)]
            fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
                $sin_cos_all(angles)
            }

            #[inline]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                $mul_add(self, factor, addend)
            }

            #[inline]
            fn sqrt(self) -> Self {
                sqrt_f64(self as f64) as $float
            }

            fn atan2(self, x: Self) -> Self {
                atan2(self as f64, x as f64) as $float
            }

            #[inline]
            fn minimum(self, other: Self) -> Self {
                if self < other || self.is_nan() { self } else { other }
            }
        }
    };
}

scalar!(f32, sin_cos_f32, sin_cos_all_f32, mul_add_f32);
scalar!(f64, sin_cos_f64, sin_cos_all_f64, mul_add_f64);
