//! Scalars: the traits of the numbers that the core and generated code compute with, and their implementations.

mod accelerated;
mod far_angle;
mod float;
mod number;
mod portable;
mod real;
mod sine;
#[cfg(any(target_arch = "x86_64", target_arch = "aarch64"))]
mod sine_batch;
#[cfg(any(feature = "lanes", target_arch = "x86_64", target_arch = "aarch64"))]
pub(crate) mod sine_lanes;

pub use number::Scalar;
pub use real::Real;
pub use sine::{sin_cos_f32, sin_cos_f64};
