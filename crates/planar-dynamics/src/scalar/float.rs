//! `f32` and `f64` as scalars, with `core` alone.
//!
//! Square roots and arctangents are those of parameters, once per model: they are accurate rather than fast.

use super::accelerated::{mul_add_f32, mul_add_f64, sin_cos_all_f32, sin_cos_all_f64};
use super::number::Scalar;
use super::sine::{sin_cos_f32, sin_cos_f64};

/// Square root by Newton's iteration, correctly rounded except near a tie; NaN for a negative value.
fn sqrt(value: f64) -> f64 {
    if value == 0.0 || value == f64::INFINITY {
        return value;
    }
    if value.is_nan() || value < 0.0 {
        return f64::NAN;
    }
    if value < f64::MIN_POSITIVE {
        // 2¹⁰⁸ makes it normal
        return sqrt(value * 324_518_553_658_426_726_783_156_020_576_256.0) / 18_014_398_509_481_984.0;
    }
    // value = part · 2²ᵏ with 1 ≤ part < 4; half is k in the place of an exponent
    let half = (((value.to_bits() >> 52) + 1) >> 1).wrapping_sub(512) << 52;
    let part = f64::from_bits(value.to_bits().wrapping_sub(half << 1));
    let mut root = f64::from_bits((part.to_bits() >> 1) + (1023 << 51));
    for _ in 0..4 {
        root = 0.5 * (root + part / root);
    }
    // the residual part − root², without rounding: the square of the root's upper half is exact
    let upper = f64::from_bits(root.to_bits() & !0x7ff_ffff);
    let lower = root - upper;
    let missing = ((part - upper * upper) - 2.0 * upper * lower) - lower * lower;
    // below 2 because the part is below 4: the root of the largest part is near a tie
    let root = (root + missing / (2.0 * root)).min(2.0 - f64::EPSILON);
    f64::from_bits(root.to_bits().wrapping_add(half))
}

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

            fn sqrt(self) -> Self {
                sqrt(self as f64) as $float
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
