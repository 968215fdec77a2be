//! Sine and cosine together, with `core` alone: the same bits on every target, and inlined.
//!
//! The angle is reduced to ±π/4 by subtracting a multiple of π/2 in three parts (Cody & Waite 1980), whose products with
//! the multiple are exact; two polynomials follow, without a branch that depends on the quadrant.

use core::f32::consts as single;
use core::f64::consts as double;

/// (sine, cosine) of an angle in rad with an error below 2·10⁻¹⁶ up to 1.6·10⁶ rad, and beyond that at most that of
/// rounding the angle. NaN for an angle that is not finite.
#[inline]
#[must_use]
pub fn sin_cos_f64(angle: f64) -> (f64, f64) {
    // π/2 = A + B + C, the first two with 33 bits: exact when multiplied by up to 2²⁰
    const A: f64 = 1.570_796_326_734_125_6;
    const B: f64 = 6.077_100_506_303_966e-11;
    const C: f64 = 2.022_266_248_795_950_6e-21;
    const FURTHEST: f64 = 1_048_576.0 * A;
    // adding it leaves the nearest integer in the last bits of the mantissa
    const ROUND: f64 = 6_755_399_441_055_744.0;
    let angle = if angle.abs() > FURTHEST { angle % double::TAU } else { angle };
    let shifted = angle * double::FRAC_2_PI + ROUND;
    let quarters = shifted - ROUND;
    let x = ((angle - quarters * A) - quarters * B) - quarters * C;
    let z = x * x;
    // minimax on ±π/4, error below 2⁻⁵⁷; coefficients of Sun's FDLIBM (1993)
    let sine = -1.666_666_666_666_663_2e-1
        + z * (8.333_333_333_322_49e-3
            + z * (-1.984_126_982_985_795e-4
                + z * (2.755_731_370_707_006_8e-6 + z * (-2.505_076_025_340_686_3e-8 + z * 1.589_690_995_211_55e-10))));
    let cosine = 4.166_666_666_666_66e-2
        + z * (-1.388_888_888_887_411e-3
            + z * (2.480_158_728_947_673e-5
                + z * (-2.755_731_435_139_066_3e-7
                    + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11))));
    let sine = x + x * z * sine;
    let half = 0.5 * z;
    let head = 1.0 - half;
    let cosine = head + (((1.0 - head) - half) + z * z * cosine);
    let quadrant = shifted.to_bits();
    let (a, b) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let sign = |value: f64, quadrant: u64| f64::from_bits(value.to_bits() ^ ((quadrant & 2) << 62));
    (sign(a, quadrant), sign(b, quadrant.wrapping_add(1)))
}

/// (sine, cosine) of an angle in rad with an error below 1·10⁻⁷ up to 6·10³ rad, and beyond that at most that of
/// rounding the angle. NaN for an angle that is not finite. It uses `f32` only: a processor without double precision
/// computes it in hardware.
#[inline]
#[must_use]
pub fn sin_cos_f32(angle: f32) -> (f32, f32) {
    // π/2 = A + B + C, the first two exact when multiplied by up to 2¹²
    const A: f32 = 1.570_312_5;
    const B: f32 = 4.837_513e-4;
    const C: f32 = 7.549_79e-8;
    const FURTHEST: f32 = 4096.0 * A;
    const ROUND: f32 = 12_582_912.0;
    let angle = if angle.abs() > FURTHEST { angle % single::TAU } else { angle };
    let shifted = angle * single::FRAC_2_PI + ROUND;
    let quarters = shifted - ROUND;
    let x = ((angle - quarters * A) - quarters * B) - quarters * C;
    let z = x * x;
    // minimax on ±π/4, error below 2⁻²⁶; coefficients of Moshier's Cephes (1992)
    let sine = -1.666_665_5e-1 + z * (8.332_161e-3 + z * -1.951_529_6e-4);
    let cosine = 4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5);
    let sine = x + x * z * sine;
    let cosine = 1.0 - 0.5 * z + z * z * cosine;
    let quadrant = shifted.to_bits();
    let (a, b) = if quadrant & 1 == 0 { (sine, cosine) } else { (cosine, sine) };
    let sign = |value: f32, quadrant: u32| f32::from_bits(value.to_bits() ^ ((quadrant & 2) << 30));
    (sign(a, quadrant), sign(b, quadrant.wrapping_add(1)))
}
