//! What [`accelerated`](super::accelerated) does in a way of the target's own, with `core` alone: for other targets, and for
//! standalone modules.

use super::sine::{sin_cos_f32, sin_cos_f64};

macro_rules! portable {
    ($float:ident, $sin_cos:ident, $sin_cos_all:ident, $mul_add:ident) => {
        /// (sine, cosine) of each angle, rad.
        #[inline]
        pub(super) fn $sin_cos_all<const N: usize>(angles: [$float; N]) -> [($float, $float); N] {
            angles.map($sin_cos)
        }

        /// a · b + c.
        #[inline]
        pub(super) fn $mul_add(a: $float, b: $float, c: $float) -> $float {
            a * b + c
        }
    };
}

portable!(f32, sin_cos_f32, sin_cos_all_f32, mul_add_f32);
portable!(f64, sin_cos_f64, sin_cos_all_f64, mul_add_f64);

/// Square root by Newton's iteration, correctly rounded; NaN for a negative value.
#[must_use]
pub fn sqrt_f64(value: f64) -> f64 {
    const IMPLICIT: u64 = 1 << 52;

    if value == 0.0 || value == f64::INFINITY {
        return value;
    }
    if value.is_nan() || value < 0.0 {
        return f64::NAN;
    }
    if value < f64::MIN_POSITIVE {
        // 2¹⁰⁸ makes it normal
        return sqrt_f64(value * 324_518_553_658_426_726_783_156_020_576_256.0) / 18_014_398_509_481_984.0;
    }
    // value = part · 2²ᵏ with 1 ≤ part < 4; half is k in the place of an exponent
    let half = (((value.to_bits() >> 52) + 1) >> 1).wrapping_sub(512) << 52;
    let part = value.to_bits().wrapping_sub(half << 1);
    let mut root = f64::from_bits((part >> 1) + (1023 << 51));
    for _ in 0..4 {
        root = 0.5 * (root + f64::from_bits(part) / root);
    }
    // the nearest integer to the root of an integer of 106 bits: (r ± ½)² = r² ± r + ¼
    let mantissa = |bits: u64| u128::from(bits & (IMPLICIT - 1) | IMPLICIT);
    let shift = if part >> 52 == 1023 { 52 } else { 53 };
    let (square, mut digits) = (mantissa(part) << shift, mantissa(root.min(2.0 - f64::EPSILON).to_bits()));
    if square > digits * digits + digits {
        digits += 1;
    } else if square + digits <= digits * digits {
        digits -= 1;
    }
    #[allow(clippy::cast_possible_truncation, reason = "53 bits")]
    let digits = digits as u64;
    f64::from_bits((digits & (IMPLICIT - 1) | 1023 << 52).wrapping_add(half))
}
