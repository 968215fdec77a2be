//! Reduction of angles far from 0 to ±π/4, with `core` alone and in the same number of instructions for each.
//!
//! The angle is an integer m times a power of two. Of the binary digits of 2/π, those that contribute multiples of four
//! quarter turns to the product are left out (Payne & Hanek 1983), and of the product those after 62 binary places: a far
//! angle is itself rounded at the 33rd or before. It needs few registers, and so next to no stack on a small processor.

use core::f32::consts as single;
use core::f64::consts as double;

/// The binary digits of 2/π, after 64 zeros: those of the largest angle, and a word more, by which a program that knows of a
/// sum of powers of two no more than its terms sees that none is missing.
pub const DIGITS: [u32; 38] = [
    0,
    0,
    0xa2f9_836e,
    0x4e44_1529,
    0xfc27_57d1,
    0xf534_ddc0,
    0xdb62_9599,
    0x3c43_9041,
    0xfe51_63ab,
    0xdebb_c561,
    0xb724_6e3a,
    0x424d_d2e0,
    0x0649_2eea,
    0x09d1_921c,
    0xfe1d_eb1c,
    0xb129_a73e,
    0xe882_35f5,
    0x2ebb_4484,
    0xe99c_7026,
    0xb45f_7e41,
    0x3991_d639,
    0x8353_39f4,
    0x9c84_5f8b,
    0xbdf9_283b,
    0x1ff8_97ff,
    0xde05_980f,
    0xef2f_118b,
    0x5a0a_6d1f,
    0x6d36_7ecf,
    0x27cb_09b7,
    0x4f46_3f66,
    0x9e5f_ea2d,
    0x7527_bac7,
    0xebe5_f17b,
    0x3d07_39f7,
    0x8a52_92ea,
    0x6bfb_5fb1,
    0x1f8d_5d08,
];

/// The same after 32 zeros, for single precision.
pub const DIGITS_SINGLE: [u32; 8] =
    [0, 0xa2f9_836e, 0x4e44_1529, 0xfc27_57d1, 0xf534_ddc0, 0xdb62_9599, 0x3c43_9041, 0xfe51_63ab];

/// 2³².
const WORD: f64 = 4_294_967_296.0;

/// The digits as bytes: words are read from a byte on, and the angle's integer is multiplied by what is left of the place,
/// less than 2⁸.
static BYTES: [u8; 152] = bytes(&DIGITS);
/// Those for single precision.
static BYTES_SINGLE: [u8; 32] = bytes(&DIGITS_SINGLE);

/// The bytes of words, that with the first digits first.
const fn bytes<const W: usize, const B: usize>(words: &[u32; W]) -> [u8; B] {
    let mut bytes = [0; B];
    let mut i = 0;
    while i < B {
        bytes[i] = words[i / 4].to_be_bytes()[i % 4];
        i += 1;
    }
    bytes
}

/// Words of 32 binary digits from a byte on.
#[inline]
fn words<const N: usize, const B: usize, const W: usize>(bytes: &[u8; N], from: u32) -> [u64; W] {
    let bytes = bytes.get(from as usize..).and_then(|bytes| bytes.first_chunk::<B>());
    let (all, _) = bytes.unwrap_or(&[0; B]).as_chunks();
    let mut words = [0; W];
    for (word, bytes) in words.iter_mut().zip(all) {
        *word = u64::from(u32::from_be_bytes(*bytes));
    }
    words
}

/// Quarter turns with 62 binary places: the nearest integer, and 32 places each of what is left of it, the first with its sign.
#[inline]
#[allow(clippy::cast_possible_truncation, reason = "words")]
fn nearest(turns: u64) -> (u32, i32, u32) {
    let (upper, lower) = ((turns >> 32) as u32, turns as u32);
    let quarters = upper.wrapping_add(1 << 29) >> 30;
    (quarters, upper.wrapping_sub(quarters << 30).cast_signed(), lower)
}

/// (remainder in rad, number of quarter turns modulo 4) of an angle of at least 2²⁰ rad; NaN for one that is infinite.
#[inline]
#[allow(clippy::cast_possible_truncation, reason = "words of 32 bits")]
pub(super) fn reduce_f64(angle: f64) -> (f64, u64) {
    let [lower, upper] = [angle.to_bits() as u32, (angle.to_bits() >> 32) as u32];
    // the angle is an integer times 2ᵉ with e = exponent - 1075
    let exponent = (upper >> 20) & 0x7ff;
    let integer = (u64::from(upper & ((1 << 20) - 1) | (1 << 20)) << 32) | u64::from(lower);
    // the first digit whose product with the angle is below 4: 62 + e with the leading zeros
    let first = exponent.saturating_sub(1013);
    let integer = integer << (first % 8);
    let [low, high] = [integer & 0xffff_ffff, integer >> 32];
    let [a, b, c, d] = words::<_, 16, 4>(&BYTES, first / 8);
    let turns = ((low * c) >> 32)
        .wrapping_add((high * d) >> 32)
        .wrapping_add(high * c)
        .wrapping_add(low * b)
        .wrapping_add((high * b) << 32)
        .wrapping_add((low * a) << 32);
    let (quarters, upper, lower) = nearest(turns);
    let size = (f64::from(upper) * WORD + f64::from(lower)) * (double::FRAC_PI_2 / 4_611_686_018_427_387_904.0);
    // NaN for an angle that is not finite
    (size + angle * 0.0, u64::from(quarters))
}

/// As [`reduce_f64`], of an angle of at least 2⁹ rad.
#[inline]
#[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "words; rounding to the scalar")]
pub(super) fn reduce_f32(angle: f32) -> (f32, u32) {
    // the angle is an integer times 2ᵉ with e = exponent - 150
    let exponent = (angle.to_bits() >> 23) & 0xff;
    let integer = (angle.to_bits() & ((1 << 23) - 1)) | (1 << 23);
    let first = exponent.saturating_sub(120);
    let m = u64::from(integer << (first % 8));
    let [a, b, c] = words::<_, 12, 3>(&BYTES_SINGLE, first / 8);
    let turns = ((m * c) >> 32).wrapping_add(m * b).wrapping_add((m * a) << 32);
    let (quarters, upper, lower) = nearest(turns);
    let size = (upper as f32 * WORD as f32 + lower as f32) * (single::FRAC_PI_2 / 4_611_686_018_427_387_904.0);
    (size + angle * 0.0, quarters)
}
