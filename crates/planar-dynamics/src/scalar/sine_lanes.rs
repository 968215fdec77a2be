//! Sine and cosine of SIMD lanes: those of [`sine`](super::sine), bit for bit without the feature `fused`.

#![allow(clippy::inline_always, reason = "lanes stay in registers")]

use super::sine::{Coefficients, DOUBLE};
use bytemuck::cast;
use core::hint::black_box;
use wide::{f64x4, u64x4};

/// a · b + c, with one rounding where the feature `fused` and the processor allow it.
macro_rules! mul_add {
    ($a:expr, $b:expr, $c:expr) => {
        if cfg!(feature = "fused") { ($a).mul_add($b, $c) } else { $a * $b + $c }
    };
}

macro_rules! near {
    ($Near:ident, $near:ident, $lanes:ident, $bits:ident, $float:ident, $count:literal, $turn:literal, $coefficients:expr, $degree:literal) => {
        /// Angles that are not far from 0 on their way to sine and cosine.
        #[derive(Clone, Copy)]
        pub(super) struct $Near {
            /// What is left of an angle, rad, and its square.
            x: $lanes,
            z: $lanes,
            /// The number of quarter turns in the last bits.
            shifted: $lanes,
            /// The polynomials so far, by Horner's rule.
            sine: $lanes,
            cosine: $lanes,
        }

        impl $Near {
            const K: Coefficients<$float, $degree, $degree> = $coefficients;
            /// The coefficients of both polynomials from the last but one on.
            pub(super) const TERMS: [[$lanes; 2]; $degree - 1] = {
                let mut terms = [[$lanes::ZERO; 2]; $degree - 1];
                let mut i = 0;
                while i < $degree - 1 {
                    let pair = [Self::K.sine[$degree - 2 - i], Self::K.cosine[$degree - 2 - i]];
                    terms[i] = [$lanes::new([pair[0]; $count]), $lanes::new([pair[1]; $count])];
                    i += 1;
                }
                terms
            };

            /// Reduces angles, rad, and says by a mask which are far.
            #[inline(always)]
            pub(super) fn new(angle: $lanes) -> (Self, $lanes) {
                let splat = $lanes::splat;
                let round = splat(Self::K.round);
                let shifted = mul_add!(angle, splat(core::$float::consts::FRAC_2_PI), round);
                let quarters = shifted - round;
                // an array of both vectors would be in memory
                let [a, b] = Self::K.quarter_turn;
                let x = mul_add!(-quarters, splat(b), mul_add!(-quarters, splat(a), angle));
                let ([.., sine], [.., cosine]) = (Self::K.sine, Self::K.cosine);
                let near = Self { x, z: x * x, shifted, sine: splat(sine), cosine: splat(cosine) };
                (near, angle.abs().simd_gt(splat(Self::K.furthest)))
            }

            /// The next terms of the polynomials.
            #[inline(always)]
            pub(super) fn add(&mut self, [sine, cosine]: [$lanes; 2]) {
                self.sine = mul_add!(self.z, self.sine, sine);
                self.cosine = mul_add!(self.z, self.cosine, cosine);
            }

            /// The coefficients of both polynomials from the second to last but one on, for so many vectors at once.
            ///
            /// On a processor whose registers have 16 bytes, operations on 64 are four chains that can fill each other's waiting
            /// times. The compiler puts one after the other, further apart than some processors look ahead. It does not where it may
            /// not unroll the loop over the coefficients: there it is not told how many there are.
            #[inline(always)]
            pub(super) fn next_terms<const VECTORS: usize>() -> &'static [[$lanes; 2]] {
                const REST: &[[$lanes; 2]] = $Near::TERMS.split_at(1).1;
                let is_few = cfg!(target_feature = "avx") || VECTORS * size_of::<$lanes>() < 64;
                if is_few { REST } else { black_box(REST) }
            }

            /// (sine, cosine) after all terms.
            #[inline(always)]
            pub(super) fn pair(self) -> ($lanes, $lanes) {
                let Self { x, z, shifted, sine, cosine } = self;
                let sine = mul_add!(x * z, sine, x);
                let cosine = mul_add!(z, mul_add!(z, cosine, $lanes::splat(-0.5)), $lanes::ONE);
                // exchanged in odd quadrants
                let [sine, cosine, quadrant]: [$bits; 3] = cast([sine, cosine, shifted]);
                let [zero, one, turn, sign] = [0, 1, 1 << $turn, 2 << $turn].map($bits::splat);
                let exchange = (sine ^ cosine) & (zero - (quadrant & one));
                // the second of its last bits where the sign of a number is
                let turned = quadrant << $turn;
                let (sine_sign, cosine_sign) = (turned & sign, (turned + turn) & sign);
                // signs are those of floats: lanes of integers that are taken apart would go through memory
                let [sine, sine_sign]: [$lanes; 2] = [cast(sine ^ exchange), cast(sine_sign)];
                let [cosine, cosine_sign]: [$lanes; 2] = [cast(cosine ^ exchange), cast(cosine_sign)];
                (sine ^ sine_sign, cosine ^ cosine_sign)
            }
        }

        /// (sine, cosine) of angles that are not far from 0, rad, and a mask of the lanes that have others.
        #[inline(always)]
        pub(super) fn $near(angle: $lanes) -> (($lanes, $lanes), $lanes) {
            let (mut near, is_far) = $Near::new(angle);
            near.add($Near::TERMS[0]);
            for terms in $Near::next_terms::<1>() {
                near.add(*terms);
            }
            (near.pair(), is_far)
        }
    };
}

macro_rules! double {
    ($Near:ident, $near:ident, $lanes:ident, $bits:ident, $count:literal) => {
        near!($Near, $near, $lanes, $bits, f64, $count, 62, DOUBLE, 6);
    };
}

#[cfg(feature = "lanes")]
macro_rules! single {
    ($Near:ident, $near:ident, $lanes:ident, $bits:ident, $count:literal) => {
        near!($Near, $near, $lanes, $bits, f32, $count, 30, SINGLE, 3);
    };
}

double!(NearF64x4, near_f64x4, f64x4, u64x4, 4);

/// Of all angles.
#[cfg(feature = "lanes")]
pub(crate) mod all {
    use super::super::sine::{self, Coefficients, DOUBLE, SINGLE};
    use super::near_f64x4;
    use bytemuck::cast;
    use core::hint::black_box;
    use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8, u32x4, u32x8, u32x16, u64x2, u64x8};

    double!(NearF64x2, near_f64x2, f64x2, u64x2, 2);
    double!(NearF64x8, near_f64x8, f64x8, u64x8, 8);
    single!(NearF32x4, near_f32x4, f32x4, u32x4, 4);
    single!(NearF32x8, near_f32x8, f32x8, u32x8, 8);
    single!(NearF32x16, near_f32x16, f32x16, u32x16, 16);

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
