//! What [`accelerated`](super::accelerated) does in a way of the target's own, with `core` alone: for other targets, and for
//! standalone modules.

use super::sine;

macro_rules! portable {
    ($float:ident, $bits:ident, $sines:ident, $of_each:ident, $sin_cos_all:ident, $sin_cos_of_sums:ident, $mul_add:ident,
     $sqrt:ident) => {
        /// (sine, cosine) of each angle, rad; `any` is for those that may be far.
        #[cfg_attr(target_arch = "arm", inline(always))]
        #[cfg_attr(not(target_arch = "arm"), inline)]
        fn $of_each<const N: usize>(
            angles: [$float; N],
            any: impl Fn($float) -> sine::$sines::Single + Copy,
        ) -> [($float, $float); N] {
            let mut results = [(0.0, 0.0); N];
            let ((pairs, last), (places, place)) = (angles.as_chunks(), results.as_chunks_mut());
            for ([first, second], place) in pairs.iter().zip(places) {
                *place = sine::$sines::sin_cos_pair(*first, *second, any).into_tuples();
            }
            for (angle, place) in last.iter().zip(place) {
                *place = sine::$sines::sin_cos_one(*angle, any).into_tuple();
            }
            results
        }

        /// (sine, cosine) of each angle, rad.
        #[cfg_attr(target_arch = "arm", inline(always))]
        #[cfg_attr(not(target_arch = "arm"), inline)]
        pub(super) fn $sin_cos_all<const N: usize>(angles: [$float; N]) -> [($float, $float); N] {
            $of_each(angles, |angle| sine::$sines::any(angle))
        }

        /// (sine, cosine) of sums, rad: `Scalar::sin_cos_of_sums`.
        #[cfg_attr(target_arch = "arm", inline(always))]
        #[cfg_attr(not(target_arch = "arm"), inline)]
        pub(super) fn $sin_cos_of_sums<const N: usize, const K: usize, const M: usize>(
            sums: [$float; N],
            some: [$float; K],
            others: &[$float; M],
        ) -> [($float, $float); N] {
            $of_each(sums, |sum| sine::$sines::any_sum(sum, sine::$sines::terms(some, others)))
        }

        /// a · b + c.
        #[inline]
        pub(super) fn $mul_add(a: $float, b: $float, c: $float) -> $float {
            a * b + c
        }

        /// Square root, digit by digit in integers: correctly rounded; NaN for a negative value.
        #[must_use]
        #[allow(clippy::cast_precision_loss, reason = "the digits of the root are those of the scalar")]
        pub fn $sqrt(value: $float) -> $float {
            const DIGITS: u32 = $float::MANTISSA_DIGITS;
            const IMPLICIT: $bits = 1 << (DIGITS - 1);
            const BIAS: $bits = ($float::MAX_EXP - 1).unsigned_abs() as $bits;
            // binary digits, in pairs, of an integer from 4ⁿ to 4ⁿ⁺¹ that has those of the scalar
            const PAIRS: u32 = (DIGITS + 2) / 2;

            if value == 0.0 || value == $float::INFINITY {
                return value;
            }
            if value.is_nan() || value < 0.0 {
                return $float::NAN;
            }
            if value < $float::MIN_POSITIVE {
                // a power of four makes it normal
                let power = |exponent: u32| $float::from_bits((BIAS + $bits::from(exponent)) << (DIGITS - 1));
                return $sqrt(value * power(2 * DIGITS)) / power(DIGITS);
            }
            // value = integer · 2ⁿ, with n even
            let exponent = value.to_bits() >> (DIGITS - 1);
            let is_odd = (exponent ^ BIAS) & 1;
            let integer = (value.to_bits() & (IMPLICIT - 1) | IMPLICIT) << (2 * PAIRS - 1 - DIGITS) << is_odd;
            let mut left = integer << ($bits::BITS - 2 * PAIRS);
            let (mut root, mut rest): ($bits, $bits) = (0, 0);
            for _ in 0..DIGITS {
                rest = rest << 2 | left >> ($bits::BITS - 2);
                left <<= 2;
                let trial = root << 2 | 1;
                root <<= 1;
                if rest >= trial {
                    rest -= trial;
                    root |= 1;
                }
            }
            // (root + ½)² = root² + root + ¼
            if rest > root {
                root += 1;
            }
            let half = exponent.wrapping_sub(is_odd).cast_signed().wrapping_sub(BIAS.cast_signed()) / 2;
            let bits = (root as $float / IMPLICIT as $float).to_bits();
            $float::from_bits(bits.wrapping_add(half.cast_unsigned() << (DIGITS - 1)))
        }
    };
}

portable!(f32, u32, single, of_each_f32, sin_cos_all_f32, sin_cos_of_sums_f32, mul_add_f32, sqrt_f32);
portable!(f64, u64, double, of_each_f64, sin_cos_all_f64, sin_cos_of_sums_f64, mul_add_f64, sqrt_f64);
