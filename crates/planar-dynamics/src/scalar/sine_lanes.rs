//! Sine and cosine of SIMD lanes: those of [`sine`](super::sine), bit for bit without the feature `fused`.

#![allow(clippy::inline_always, reason = "lanes stay in registers")]

use super::sine::{Coefficients, DOUBLE};
use bytemuck::cast;
use wide::{f64x4, u64x4};

/// a · b + c, with one rounding where the feature `fused` and the processor allow it.
macro_rules! mul_add {
    ($a:expr, $b:expr, $c:expr) => {
        if cfg!(feature = "fused") { ($a).mul_add($b, $c) } else { $a * $b + $c }
    };
}
macro_rules! near {
    ($near:ident, $lanes:ident, $bits:ident, $float:ident, $sign:literal, $coefficients:expr, $degree:literal) => {
        /// (sine, cosine) of angles that are not far from 0, rad, and a mask of the lanes that have others.
        #[inline(always)]
        pub(super) fn $near(angle: $lanes) -> (($lanes, $lanes), $lanes) {
            const K: Coefficients<$float, $degree, $degree> = $coefficients;
            let splat = $lanes::splat;
            let horner = |z: $lanes, [first @ .., last]: [$float; $degree]| {
                let sum = |sum: $lanes, coefficient: &$float| mul_add!(z, sum, splat(*coefficient));
                first.iter().rev().fold(splat(last), sum)
            };
            let round = splat(K.round);
            let shifted = mul_add!(angle, splat(core::$float::consts::FRAC_2_PI), round);
            let quarters = shifted - round;
            let [a, b, c] = K.quarter_turn.map(splat);
            let x = mul_add!(-quarters, c, mul_add!(-quarters, b, mul_add!(-quarters, a, angle)));
            let z = x * x;
            let sine = mul_add!(x * z, horner(z, K.sine), x);
            let cosine = mul_add!(z, mul_add!(z, horner(z, K.cosine), splat(-0.5)), $lanes::ONE);
            // exchanged in odd quadrants
            let [sine, cosine, quadrant]: [$bits; 3] = cast([sine, cosine, shifted]);
            let [zero, one, two] = [0, 1, 2].map($bits::splat);
            let exchange = (sine ^ cosine) & (zero - (quadrant & one));
            let sign = |quadrant: $bits| (quadrant & two) << $sign;
            let sine: $lanes = cast(sine ^ exchange ^ sign(quadrant));
            let cosine: $lanes = cast(cosine ^ exchange ^ sign(quadrant + one));
            ((sine, cosine), angle.abs().simd_gt(splat(K.furthest)))
        }
    };
}

macro_rules! double {
    ($near:ident, $lanes:ident, $bits:ident) => {
        near!($near, $lanes, $bits, f64, 62, DOUBLE, 6);
    };
}

#[cfg(feature = "lanes")]
macro_rules! single {
    ($near:ident, $lanes:ident, $bits:ident) => {
        near!($near, $lanes, $bits, f32, 30, SINGLE, 3);
    };
}

double!(near_f64x4, f64x4, u64x4);

/// Of all angles.
#[cfg(feature = "lanes")]
pub(crate) mod all {
    use super::super::sine::{self, Coefficients, DOUBLE, SINGLE};
    use super::near_f64x4;
    use bytemuck::cast;
    use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8, u32x4, u32x8, u32x16, u64x2, u64x8};

    double!(near_f64x2, f64x2, u64x2);
    double!(near_f64x8, f64x8, u64x8);
    single!(near_f32x4, f32x4, u32x4);
    single!(near_f32x8, f32x8, u32x8);
    single!(near_f32x16, f32x16, u32x16);

    macro_rules! sin_cos {
        ($name:ident, $near:ident, $far:ident, $lanes:ident, $sines:ident) => {
            /// (sine, cosine) of the angles in the lanes, rad. `terms` are 0 where the angles are sums of finite ones: beyond
            /// the largest number, they are then that number.
            #[inline(always)]
            pub(crate) fn $name<const N: usize>(
                angles: [$lanes; N],
                terms: impl FnOnce() -> $lanes,
            ) -> [($lanes, $lanes); N] {
                let mut pairs = [($lanes::ZERO, $lanes::ONE); N];
                let mut some_are_far = $lanes::ZERO;
                // one test for all: between tests, the operations of one would wait for each other
                for (pair, angle) in pairs.iter_mut().zip(angles) {
                    let is_far;
                    (*pair, is_far) = $near(angle);
                    some_are_far |= is_far;
                }
                if some_are_far.any() { $far(angles, terms()) } else { pairs }
            }

            /// Lane by lane.
            #[cold]
            #[inline(never)]
            fn $far<const N: usize>(angles: [$lanes; N], terms: $lanes) -> [($lanes, $lanes); N] {
                angles.map(|angles| {
                    let mut pairs = [angles.to_array(), terms.to_array()];
                    let [sines, cosines] = &mut pairs;
                    for (sine, cosine) in sines.iter_mut().zip(cosines) {
                        let (angle, terms) = (*sine, *cosine);
                        (*sine, *cosine) = sine::$sines::any_sum(angle, terms).into_tuple();
                    }
                    pairs.map($lanes::from).into()
                })
            }
        };
    }

    sin_cos!(sin_cos_f64x2, near_f64x2, far_f64x2, f64x2, double);
    sin_cos!(sin_cos_f64x4, near_f64x4, far_f64x4, f64x4, double);
    sin_cos!(sin_cos_f64x8, near_f64x8, far_f64x8, f64x8, double);
    sin_cos!(sin_cos_f32x4, near_f32x4, far_f32x4, f32x4, single);
    sin_cos!(sin_cos_f32x8, near_f32x8, far_f32x8, f32x8, single);
    sin_cos!(sin_cos_f32x16, near_f32x16, far_f32x16, f32x16, single);
}
