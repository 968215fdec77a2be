//! What a target may do in a way of its own: several sines at once, and with the feature `fused` products with sums.

pub(super) use super::portable::sin_cos_all_f32;
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub(super) use super::portable::sin_cos_all_f64;
#[cfg(not(feature = "fused"))]
pub(super) use super::portable::{mul_add_f32, mul_add_f64};
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
pub(super) use super::sine_batch::sin_cos_all_f64;

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
