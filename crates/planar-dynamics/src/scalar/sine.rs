//! Sine and cosine together, with `core` alone: the same bits on every target, and inlined.
//!
//! The angle is reduced to ±π/4 by subtracting a multiple of π/2 in two parts (Cody & Waite 1980), or far from 0 in integers; two
//! polynomials follow. There is no branch but that for far angles, which are out of line altogether, so that nothing is prepared
//! for them.

use super::far_angle::{reduce_f32, reduce_f64};
use super::number::Scalar;

/// What reduction and polynomials of a scalar consist of.
#[derive(Debug)]
pub struct Coefficients<F, const S: usize, const C: usize> {
    /// π/2 in two parts. The product of the first with the quarter turns of the furthest angle is exact; that of the second, which is
    /// small, is rounded, by less than the angle is.
    pub quarter_turn: [F; 2],
    /// The largest angle that is reduced in line, rad.
    pub furthest: F,
    /// Adding it leaves the nearest integer in the last bits of the mantissa.
    pub round: F,
    /// (sin x / x − 1) / x² as a polynomial in x².
    pub sine: [F; S],
    /// (cos x − 1 + x²/2) / x⁴ as a polynomial in x².
    pub cosine: [F; C],
}

/// 33 bits and 53 up to 2²⁰, error below 2⁻⁶⁵; minimax on ±π/4, error below 2⁻⁵⁷; coefficients of Sun's FDLIBM (1993).
pub const DOUBLE: Coefficients<f64, 6, 6> = Coefficients {
    quarter_turn: [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11],
    furthest: 1_048_576.0 * 1.570_796_326_734_125_6,
    round: 6_755_399_441_055_744.0,
    sine: [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ],
    cosine: [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ],
};

/// 12 bits and 24 up to 2¹², error below 2⁻²⁹; minimax on ±π/4, error below 2⁻²⁶; coefficients of Moshier's Cephes (1992).
pub const SINGLE: Coefficients<f32, 3, 3> = Coefficients {
    quarter_turn: [1.570_800_8, -4.454_455e-6],
    furthest: 4096.0 * 1.570_800_8,
    round: 12_582_912.0,
    sine: [-1.666_665_5e-1, 8.332_161e-3, -1.951_529_6e-4],
    cosine: [4.166_664_6e-2, -1.388_731_6e-3, 2.443_315_7e-5],
};

/// Polynomials on ±π/4, and what the number of quarter turns makes of them.
#[inline]
fn turned_f64(x: f64, quadrant: u64) -> (f64, f64) {
    const K: Coefficients<f64, 6, 6> = DOUBLE;
    let z = x * x;
    let [s0, s1, s2, s3, s4, s5] = K.sine;
    let [c0, c1, c2, c3, c4, c5] = K.cosine;
    let sine = s0 + z * (s1 + z * (s2 + z * (s3 + z * (s4 + z * s5))));
    let cosine = c0 + z * (c1 + z * (c2 + z * (c3 + z * (c4 + z * c5))));
    let sine = x + x * z * sine;
    let cosine = 1.0 + z * (z * cosine - 0.5);
    // exchanged in odd quadrants; where words have 32 bits, one instruction selects what takes several by halves
    if cfg!(target_arch = "arm") {
        let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, -sine) };
        let (sine, cosine) = if quadrant & 2 == 0 { (sine, cosine) } else { (-sine, -cosine) };
        return (sine, cosine);
    }
    exchanged_f64(sine, cosine, quadrant)
}

/// Sine and cosine of a reduced angle, exchanged in odd quadrants, with their signs.
#[allow(clippy::inline_always, reason = "in vectors, what is not inlined has the instruction set of the build")]
#[inline(always)]
pub fn exchanged_f64(sine: f64, cosine: f64, quadrant: u64) -> (f64, f64) {
    const SIGN: u64 = 1 << 63;
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let exchange = (sine ^ cosine) & (quadrant & 1).wrapping_neg();
    // the second of its last bits where the sign of a number is
    let turned = quadrant << 62;
    let sine = sine ^ exchange ^ (turned & SIGN);
    let cosine = cosine ^ exchange ^ (turned.wrapping_add(1 << 62) & SIGN);
    (f64::from_bits(sine), f64::from_bits(cosine))
}

/// As [`turned_f64`]; with `f32` alone, a processor without double precision computes it in hardware.
#[inline]
fn turned_f32(x: f32, quadrant: u32) -> (f32, f32) {
    const K: Coefficients<f32, 3, 3> = SINGLE;
    let z = x * x;
    let [s0, s1, s2] = K.sine;
    let [c0, c1, c2] = K.cosine;
    let sine = x + x * z * (s0 + z * (s1 + z * s2));
    let cosine = 1.0 + z * (z * (c0 + z * (c1 + z * c2)) - 0.5);
    if cfg!(target_arch = "arm") {
        let (sine, cosine) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, -sine) };
        return if quadrant & 2 == 0 { (sine, cosine) } else { (-sine, -cosine) };
    }
    // exchanged in odd quadrants
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let exchange = (sine ^ cosine) & (quadrant & 1).wrapping_neg();
    let sign = |quadrant: u32| (quadrant & 2) << 30;
    let sine = sine ^ exchange ^ sign(quadrant);
    let cosine = cosine ^ exchange ^ sign(quadrant.wrapping_add(1));
    (f32::from_bits(sine), f32::from_bits(cosine))
}

/// Sines of a float, in a module of its own.
macro_rules! sines {
    ($module:ident, $float:ident, $bits:ident, $coefficients:ident, $turned:ident, $reduce_far:ident, $has_pairs:literal, $error:literal) => {
        pub mod $module {
            use super::{Scalar, $coefficients as K, $reduce_far as reduce_far, $turned as turned};

            /// Sine and cosine. By the convention of C, up to four numbers come back in registers; by that of Rust, words do.
            #[derive(Clone, Copy, Debug)]
            #[repr(C)]
            pub struct Single([$float; 2]);

            impl Single {
                /// (sine, cosine).
                #[inline]
                pub fn into_tuple(self) -> ($float, $float) {
                    self.0.into()
                }
            }

            /// Sines and cosines of two angles.
            #[derive(Clone, Copy, Debug)]
            #[repr(C)]
            pub struct Pair {
                first: [$float; 2],
                second: [$float; 2],
            }

            impl Pair {
                /// (sine, cosine) of each.
                #[inline]
                pub fn into_tuples(self) -> [($float, $float); 2] {
                    let Self { first: [a, b], second: [c, d] } = self;
                    [(a, b), (c, d)]
                }
            }

            /// (remainder, quarter turns) of an angle that is not far from 0.
            #[inline]
            fn reduce_near(angle: $float) -> ($float, $bits) {
                let shifted = angle * core::$float::consts::FRAC_2_PI + K.round;
                let quarters = shifted - K.round;
                let [a, b] = K.quarter_turn;
                ((angle - quarters * a) - quarters * b, shifted.to_bits())
            }

            /// Of an angle that is not far from 0.
            #[inline]
            fn near(angle: $float) -> ($float, $float) {
                let (x, quadrant) = reduce_near(angle);
                turned(x, quadrant)
            }

            /// Of an angle that may be far. It calls nothing: its frame is on top of that of a function that may be large.
            #[cold]
            #[inline(never)]
            pub extern "C" fn any(angle: $float) -> Single {
                let size = angle.abs();
                let (x, quadrant) = if size <= K.furthest { reduce_near(size) } else { reduce_far(size) };
                let (sine, cosine) = turned(x, quadrant);
                Single([if angle < 0.0 { -sine } else { sine }, cosine])
            }

            /// Of a sum of angles that may be far: of the largest number, where it is beyond that and its terms are finite.
            #[cold]
            #[inline(never)]
            pub extern "C" fn any_sum(sum: $float, terms: $float) -> Single {
                any(if terms == 0.0 { sum.saturated() } else { sum })
            }

            /// 0 for finite terms of sums, else NaN.
            #[inline]
            pub fn terms<const N: usize, const M: usize>(some: [$float; N], others: &[$float; M]) -> $float {
                let first = match some[..] {
                    [only] => only,
                    _ => some.iter().fold(0.0, |sum, angle| sum + angle * 0.0),
                };
                terms_with(first, others)
            }

            /// The same of one and others: out of line where registers are few.
            #[cfg_attr(target_arch = "arm", cold, inline(never))]
            #[cfg_attr(not(target_arch = "arm"), inline)]
            #[allow(improper_ctypes_definitions, reason = "Rust alone calls it")]
            extern "C" fn terms_with<const M: usize>(first: $float, others: &[$float; M]) -> $float {
                others.iter().fold(first * 0.0, |sum, angle| sum + angle * 0.0)
            }

            #[cfg_attr(target_arch = "arm", inline(never))]
            #[cfg_attr(not(target_arch = "arm"), inline)]
            extern "C" fn one(angle: $float) -> Single {
                if angle.abs() <= K.furthest { Single(near(angle).into()) } else { any(angle) }
            }

            #[doc = concat!("(sine, cosine) of an angle in rad with an error below ", $error, ". NaN for an angle that is not finite.")]
            #[inline]
            #[must_use]
            pub fn sin_cos(angle: $float) -> ($float, $float) {
                one(angle).0.into()
            }

            /// Of an angle; `any` is for one that may be far.
            #[inline]
            pub fn sin_cos_one(angle: $float, any: impl Fn($float) -> Single) -> Single {
                if angle.abs() <= K.furthest { near_one(angle) } else { any(angle) }
            }

            /// Of two angles: a call less, and one set of constants, where they are not inlined.
            #[inline]
            pub fn sin_cos_pair(first: $float, second: $float, any: impl Fn($float) -> Single) -> Pair {
                // here, so that far angles need neither the frame of near ones nor one of their own
                let is_near = first.abs() + second.abs() <= K.furthest;
                if !is_near {
                    Pair { first: any(first).0, second: any(second).0 }
                } else if $has_pairs || cfg!(not(target_arch = "arm")) {
                    near_pair(first, second)
                } else {
                    Pair { first: near_one(first).0, second: near_one(second).0 }
                }
            }

            /// Of angles that are not far.
            #[cfg_attr(target_arch = "arm", inline(never))]
            #[cfg_attr(not(target_arch = "arm"), inline)]
            extern "C" fn near_pair(first: $float, second: $float) -> Pair {
                Pair { first: near(first).into(), second: near(second).into() }
            }

            /// Of an angle that is not far: where 16 registers are all, one after the other needs no frame, and not more instructions.
            #[cfg_attr(target_arch = "arm", inline(never))]
            #[cfg_attr(not(target_arch = "arm"), inline)]
            extern "C" fn near_one(angle: $float) -> Single {
                Single(near(angle).into())
            }
        }
    };
}

sines!(double, f64, u64, DOUBLE, turned_f64, reduce_f64, false, "3·10⁻¹⁶");
sines!(single, f32, u32, SINGLE, turned_f32, reduce_f32, true, "1.5·10⁻⁷");
