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

/// 32 binary digits of two words, behind the first `by` < 32.
#[inline]
fn digits_behind(by: u32, first: u32, second: u32) -> u32 {
    (first << by) | (second >> 1 >> (31 - by))
}

/// (remainder in rad, number of quarter turns modulo 4) of an angle of at least 2²⁰ rad; NaN for one that is not finite.
///
/// In words of 32 bits, one after the other: wider integers take a long stack frame on a small processor.
#[inline]
#[allow(clippy::cast_possible_truncation, reason = "words of 32 bits")]
pub(super) fn reduce_f64(angle: f64) -> (f64, u64) {
    let [lower, upper] = [angle.to_bits() as u32, (angle.to_bits() >> 32) as u32];
    // the angle is m 2ᵉ with e = exponent - 1075
    let exponent = (upper >> 20) & 0x7ff;
    if exponent == 0x7ff {
        return (f64::NAN, 0);
    }
    let m = [lower, upper & ((1 << 20) - 1) | (1 << 20)].map(u64::from);
    // the first digit whose product with the angle is below 4: 62 + e with the leading zeros
    let first = exponent.saturating_sub(1013);
    let word = |i: u32| DIGITS.get(i as usize / 2).map_or(0, |two| (two >> (32 * (1 - i % 2))) as u32);
    // quarter turns, with 126 binary places: the first four of the product's six words, from the last on
    let (mut turns, mut carry, mut before) = ([0; 4], 0, 0);
    for at in (first / 32..first / 32 + 6).rev() {
        let next = u64::from(digits_behind(first % 32, word(at), word(at + 1)));
        let sum = m[0] * next + carry;
        let digits = m[1] * before + (sum & 0xffff_ffff);
        (carry, before) = ((sum >> 32) + (digits >> 32), next);
        turns = [digits as u32, turns[0], turns[1], turns[2]];
    }
    let quarters = turns[0].wrapping_add(1 << 29) >> 30;
    turns[0] = turns[0].wrapping_sub(quarters << 30);
    let is_below = turns[0] >> 31 == 1;
    if is_below {
        let mut carry = true;
        for word in turns.iter_mut().rev() {
            (*word, carry) = (!*word).overflowing_add(u32::from(carry));
        }
    }
    // of the last of the first two words
    let mut unit = double::FRAC_PI_2 / 4_611_686_018_427_387_904.0;
    for _ in 0..2 {
        if turns[0] == 0 {
            turns = [turns[1], turns[2], turns[3], 0];
            unit *= 1.0 / 4_294_967_296.0;
        }
    }
    let zeros = turns[0].leading_zeros() % 32;
    let first = f64::from(digits_behind(zeros, turns[0], turns[1]));
    // the last bit says whether more follow, which is what rounding needs
    let follow = u32::from((turns[2] << zeros) | turns[3] != 0);
    let second = f64::from(digits_behind(zeros, turns[1], turns[2]) | follow);
    let size = (first * 4_294_967_296.0 + second) * (unit / f64::from(1_u32 << zeros));
    let (x, quarters) = (if is_below == (angle < 0.0) { size } else { -size }, u64::from(quarters));
    if angle < 0.0 { (x, quarters.wrapping_neg()) } else { (x, quarters) }
}

/// As [`reduce_f64`], of an angle of at least 2⁹ rad, with integers of 64 bits.
#[inline]
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "words; rounding to the scalar")]
pub(super) fn reduce_f32(angle: f32) -> (f32, u32) {
    // the angle is m 2ᵉ with e = exponent - 150
    let exponent = (angle.to_bits() >> 23) & 0xff;
    if exponent == 0xff {
        return (f32::NAN, 0);
    }
    let m = u64::from((angle.to_bits() & ((1 << 23) - 1)) | (1 << 23));
    let first = exponent.saturating_sub(120);
    let word = |i: u32| DIGITS_SINGLE.get(i as usize).copied().unwrap_or(0);
    let product = |i: u32| {
        let at = first / 32 + i;
        m * u64::from(digits_behind(first % 32, word(at), word(at + 1)))
    };
    // quarter turns, with 62 binary places
    let turns = (product(0) << 32).wrapping_add(product(1)).wrapping_add(product(2) >> 32);
    let quarters = (turns >> 32) as u32;
    let quarters = quarters.wrapping_add(1 << 29) >> 30;
    let rest = turns.wrapping_sub(u64::from(quarters) << 62).cast_signed();
    let is_below = rest < 0;
    let [upper, lower] = [rest.unsigned_abs() >> 32, rest.unsigned_abs()].map(|word| word as u32);
    // of the last of these words
    let (unit, [upper, lower]) = match upper {
        0 => (single::FRAC_PI_2 / 4_611_686_018_427_387_904.0, [lower, 0]),
        _ => (single::FRAC_PI_2 / 1_073_741_824.0, [upper, lower]),
    };
    let zeros = upper.leading_zeros() % 32;
    // the last bit says whether more follow, which is what rounding needs
    let follow = u32::from(lower << zeros != 0);
    let size = (digits_behind(zeros, upper, lower) | follow) as f32 * (unit / (1_u32 << zeros) as f32);
    let x = if is_below == (angle < 0.0) { size } else { -size };
    if angle < 0.0 { (x, quarters.wrapping_neg()) } else { (x, quarters) }
}
