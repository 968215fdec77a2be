//! `f32` and `f64` as scalars, with `core` alone.
//!
//! Arctangents are those of parameters, once per model: they are accurate rather than fast.

use super::accelerated::{
    mul_add_f32, mul_add_f64, sin_cos_all_f32, sin_cos_all_f64, sin_cos_of_sums_f32, sin_cos_of_sums_f64, sqrt_f32,
    sqrt_f64,
};
use super::number::Scalar;
use super::sine;

macro_rules! scalar {
    ($float:ident, $sines:ident, $sin_cos_all:ident, $sin_cos_of_sums:ident, $mul_add:ident, $sqrt:ident, $atan2:ident) => {
        /// Angle of the vector (x, y) by three steps that add the tangent of the remaining angle; each leaves its cube.
        fn $atan2(y: $float, x: $float) -> $float {
            use core::$float::consts::{FRAC_PI_4, PI};

            let size = x.abs().max(y.abs());
            if size == 0.0 {
                return 0.0;
            }
            if !size.is_finite() {
                return $float::NAN;
            }
            let (x, y) = (x / size, y / size);
            let half = if y < 0.0 { -PI } else { PI };
            // within 0.1 rad: linear between multiples of 45°
            let mut angle = match (x.abs() < y.abs(), x < 0.0) {
                (true, _) => 0.5 * half - x * half / 4.0,
                (false, false) => y * FRAC_PI_4,
                (false, true) => half - y * FRAC_PI_4,
            };
            for _ in 0..3 {
                let (s, c) = sine::$sines::sin_cos(angle);
                angle += (y * c - x * s) / (x * c + y * s);
            }
            angle
        }

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
                sine::$sines::sin_cos(self)
            }

            #[allow(clippy::inline_always, reason = "a call would pass all angles through memory")]
            #[inline(always)]
            fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
                $sin_cos_all(angles)
            }

            #[allow(clippy::inline_always, reason = "a call would pass all angles through memory")]
            #[inline(always)]
            fn sin_cos_of_sums<const N: usize, const K: usize, const M: usize>(
                sums: [Self; N],
                some: [Self; K],
                others: &[Self; M],
            ) -> [(Self, Self); N] {
                $sin_cos_of_sums(sums, some, others)
            }

            #[inline]
            fn saturated(self) -> Self {
                match self {
                    $float::INFINITY => $float::MAX,
                    $float::NEG_INFINITY => $float::MIN,
                    _ => self,
                }
            }

            #[inline]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                $mul_add(self, factor, addend)
            }

            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            fn atan2(self, x: Self) -> Self {
                $atan2(self, x)
            }

            #[inline]
            fn minimum(self, other: Self) -> Self {
                if self < other || self.is_nan() { self } else { other }
            }

            super::both::at_once!($float);
        }
    };
}

scalar!(f32, single, sin_cos_all_f32, sin_cos_of_sums_f32, mul_add_f32, sqrt_f32, atan2_f32);
scalar!(f64, double, sin_cos_all_f64, sin_cos_of_sums_f64, mul_add_f64, sqrt_f64, atan2_f64);
