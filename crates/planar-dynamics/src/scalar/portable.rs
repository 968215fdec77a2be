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
