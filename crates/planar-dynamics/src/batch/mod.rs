//! Many instances of one robot at once, in the widest vectors of the processor that the program runs on (feature `batch`).
//!
//! The numbers are structures of arrays: each array is a row-major matrix with one row per number and one column per
//! instance, so that `joint_angles` of N instances are all angles of the first joint, then all of the second. N is any
//! number, that of the statuses. The instruction set is chosen when a function runs: AVX-512, AVX2 with FMA, or that of the
//! build.
//!
//! Without the feature `fused` the results have the bits of the model's functions for one state. With it they differ by
//! rounding where the processor fuses products with sums and the build does not.

#![allow(clippy::inline_always, reason = "what is not inlined has the instruction set of the build")]

mod arrays;
mod block;
mod dispatch;
mod functions;
mod implement;
mod model;

pub use crate::status::Status;
pub use arrays::{Accelerations, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Targets};
pub use dispatch::{AsBuilt, Avx2, Detected, Instructions};
pub use functions::Batch;
pub use model::BatchModel;

/// For generated code alone.
#[doc(hidden)]
pub mod generated {
    pub use super::block::{
        Checks, Number, Place, Rows, Statuses, put, put_matrix, take, where_finite, zeros, zeros_of_matrix,
    };
}
