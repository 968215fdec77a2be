//! SIMD lanes as scalars: one robot per lane (feature `lanes`).
//!
//! `wide` selects the vector width at compile time: the cost of a lane depends on `-C target-cpu=…`.

use crate::scalar::Scalar;
use wide::{f32x8, f64x4, f64x8};

macro_rules! lanes {
    ($lanes:ident, $float:ident) => {
        impl Scalar for $lanes {
            const ZERO: Self = $lanes::ZERO;
            const ONE: Self = $lanes::ONE;

            #[inline]
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_lossless,
                reason = "rounding to the lane is what is asked for"
            )]
            fn constant(value: f64) -> Self {
                $lanes::splat(value as $float)
            }

            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                $lanes::sin_cos(self)
            }

            #[inline]
            fn sqrt(self) -> Self {
                $lanes::sqrt(self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                $lanes::atan2(self, x)
            }

            #[inline]
            fn minimum(self, other: Self) -> Self {
                (self.simd_lt(other) | self.is_nan()).select(self, other)
            }
        }
    };
}

lanes!(f64x4, f64);
lanes!(f64x8, f64);
lanes!(f32x8, f32);
