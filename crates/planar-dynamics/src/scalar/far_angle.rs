//! Reduction of angles far from 0 to ±π/4, with `core` alone and in the same number of instructions for each.
//!
//! The angle is an integer m times a power of two. Of the binary digits of 2/π, those that contribute multiples of four
//! quarter turns to the product are left out, and those after the next 192 (96 in single precision) are below rounding
//! (Payne & Hanek 1983). The rest is exact: integers modulo a power of two.

use core::f32::consts as single;
use core::f64::consts as double;

/// The binary digits of 2/π, after 64 zeros; more than the largest angle needs.
pub const DIGITS: [u64; 20] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
];

/// The same after 32 zeros, for single precision.
pub const DIGITS_SINGLE: [u32; 8] =
    [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab];

/// (remainder in rad, number of quarter turns modulo 4) of an angle of at least 2²⁰ rad; NaN for one that is not finite.
#[cold]
#[inline(never)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    reason = "modulo 2⁶⁴, then rounding to the scalar"
)]
pub(super) fn reduce_f64(angle: f64) -> (f64, u64) {
    // the angle is m 2ᵉ with e = exponent - 1075
    let exponent = (angle.to_bits() >> 52) & 0x7ff;
    if exponent == 0x7ff {
        return (f64::NAN, 0);
    }
    let m = (angle.to_bits() & ((1 << 52) - 1)) | (1 << 52);
    // the first digit whose product with the angle is below 4: 62 + e with the leading zeros
    let first = exponent.saturating_sub(1013);
    let digits = |i: u64| u128::from(DIGITS.get(i as usize).copied().unwrap_or(0));
    let window = |i: u64| {
        let at = first / 64 + i;
        ((digits(at) << 64 | digits(at + 1)) << (first % 64) >> 64) as u64
    };
    let product = |i: u64| u128::from(m) * u128::from(window(i));
    let lower = product(1) + (product(2) >> 64);
    let upper = (product(0) as u64).wrapping_add((lower >> 64) as u64);
    // quarter turns, with 126 binary places
    let turns = u128::from(upper) << 64 | u128::from(lower as u64);
    let quarters = turns.wrapping_add(1 << 125) >> 126;
    let rest = turns.wrapping_sub(quarters << 126) as i128;
    // 2⁻¹²⁶ quarter turns
    let x = rest as f64 * (double::FRAC_PI_2 / 85_070_591_730_234_615_865_843_651_857_942_052_864.0);
    let quarters = quarters as u64;
    if angle < 0.0 { (-x, quarters.wrapping_neg()) } else { (x, quarters) }
}

/// As [`reduce_f64`], of an angle of at least 2⁹ rad, with integers of 64 bits.
#[cold]
#[inline(never)]
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_possible_wrap,
    reason = "modulo 2³², then rounding to the scalar"
)]
pub(super) fn reduce_f32(angle: f32) -> (f32, u32) {
    // the angle is m 2ᵉ with e = exponent - 150
    let exponent = (angle.to_bits() >> 23) & 0xff;
    if exponent == 0xff {
        return (f32::NAN, 0);
    }
    let m = (angle.to_bits() & ((1 << 23) - 1)) | (1 << 23);
    let first = exponent.saturating_sub(120);
    let digits = |i: u32| u64::from(DIGITS_SINGLE.get(i as usize).copied().unwrap_or(0));
    let window = |i: u32| {
        let at = first / 32 + i;
        ((digits(at) << 32 | digits(at + 1)) << (first % 32) >> 32) as u32
    };
    let product = |i: u32| u64::from(m) * u64::from(window(i));
    let lower = product(1) + (product(2) >> 32);
    let upper = (product(0) as u32).wrapping_add((lower >> 32) as u32);
    // quarter turns, with 62 binary places
    let turns = u64::from(upper) << 32 | u64::from(lower as u32);
    let quarters = turns.wrapping_add(1 << 61) >> 62;
    let rest = turns.wrapping_sub(quarters << 62) as i64;
    let x = rest as f32 * (single::FRAC_PI_2 / 4_611_686_018_427_387_904.0);
    let quarters = quarters as u32;
    if angle < 0.0 { (-x, quarters.wrapping_neg()) } else { (x, quarters) }
}
