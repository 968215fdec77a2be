//! What a target may do in a way of its own: several sines at once, square roots, and with the feature `fused` products with sums.

#[cfg(not(feature = "fused"))]
pub(super) use super::portable::{mul_add_f32, mul_add_f64};
pub(super) use super::portable::{sin_cos_all_f32, sin_cos_of_sums_f32};
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(super) use super::portable::{sin_cos_all_f64, sin_cos_of_sums_f64, sqrt_f32, sqrt_f64};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(super) use super::sine_batch::{sin_cos_all_f64, sin_cos_of_sums_f64};

/// The processor's square root, correctly rounded; `core` has it for vectors alone.
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
#[inline]
pub(super) fn sqrt_f32(value: f32) -> f32 {
    let [root, ..] = wide::f32x4::splat(value).sqrt().to_array();
    root
}

/// As [`sqrt_f32`].
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
#[inline]
pub(super) fn sqrt_f64(value: f64) -> f64 {
    let [root, _] = wide::f64x2::splat(value).sqrt().to_array();
    root
}

#[cfg(feature = "fused")]
macro_rules! fused {
    ($float:ident, $mul_add:ident) => {
        /// a · b + c, with one rounding where the processor has the instruction.
        #[inline]
        pub(super) fn $mul_add(a: $float, b: $float, c: $float) -> $float {
            if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
                std::primitive::$float::mul_add(a, b, c)
            } else {
                super::portable::$mul_add(a, b, c)
            }
        }
    };
}

#[cfg(feature = "fused")]
fused!(f32, mul_add_f32);
#[cfg(feature = "fused")]
fused!(f64, mul_add_f64);
