//! SIMD lanes as scalars: one robot per lane (feature `lanes`).
//!
//! `wide` selects the vector width at compile time: the cost of a lane depends on `-C target-cpu=…`.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::scalar::Scalar;
//! use wide::f64x4;
//!
//! // four robots with stretched arms, each base at another angle
//! let (yaw, zero) = (f64x4::new([0.0, 1.0, 2.0, 3.0]), f64x4::ZERO);
//! let poses = Model::<f64x4>::default().end_effector_poses(&[yaw, zero, zero], &[zero; JOINTS]);
//! // the end effector of the first arm is 0.5 m + 3 · 1 m from the base's COM, at the angle of the base
//! let [_, x, y] = poses[0];
//! let [distances, angles] = [Scalar::sqrt(x * x + y * y), Scalar::atan2(y, x)].map(|lanes| lanes.to_array());
//! assert!(distances.iter().all(|distance| (distance - 3.5).abs() < 1e-12));
//! assert!(angles.iter().zip([0.0, 1.0, 2.0, 3.0]).all(|(angle, yaw)| (angle - yaw).abs() < 1e-12));
//! ```

use crate::scalar::Scalar;
use crate::scalar::sine_lanes::all;
use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

macro_rules! lanes {
    ($lanes:ident, $float:ident, $sin_cos:ident) => {
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
                let [pair] = Self::sin_cos_all([self]);
                pair
            }

            #[inline]
            fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
                // one that is infinite is no sum of finite angles
                all::$sin_cos(angles, || Self::constant(f64::NAN))
            }

            #[inline]
            fn sin_cos_of_sums<const N: usize, const K: usize, const M: usize>(
                sums: [Self; N],
                some: [Self; K],
                others: &[Self; M],
            ) -> [(Self, Self); N] {
                let terms = || some.iter().chain(others).fold(Self::ZERO, |sum, angle| sum + *angle * Self::ZERO);
                all::$sin_cos(sums, terms)
            }

            #[inline]
            fn saturated(self) -> Self {
                // NaN is not larger than any number
                let largest = $lanes::splat($float::MAX);
                let below = self.simd_gt(largest).select(largest, self);
                below.simd_lt(-largest).select(-largest, below)
            }

            #[inline]
            fn mul_add(self, factor: Self, addend: Self) -> Self {
                if cfg!(feature = "fused") { $lanes::mul_add(self, factor, addend) } else { self * factor + addend }
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

lanes!(f64x2, f64, sin_cos_f64x2);
lanes!(f64x4, f64, sin_cos_f64x4);
lanes!(f64x8, f64, sin_cos_f64x8);
lanes!(f32x4, f32, sin_cos_f32x4);
lanes!(f32x8, f32, sin_cos_f32x8);
lanes!(f32x16, f32, sin_cos_f32x16);
