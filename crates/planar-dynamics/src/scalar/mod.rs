//! Scalars: the traits of the numbers that the core and generated code compute with, and their implementations.

mod float;
mod number;
mod real;
mod sine;

pub use number::Scalar;
pub use real::Real;
pub use sine::{sin_cos_f32, sin_cos_f64};
