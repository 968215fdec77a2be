//! What generated code needs of a number.

mod float;
mod number;
mod real;
mod sine;

pub use number::Scalar;
pub use real::Real;
pub use sine::{sin_cos_f32, sin_cos_f64};
