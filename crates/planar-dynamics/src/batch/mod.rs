//! Many instances of one robot at once, in the widest vectors of the processor that the program runs on (feature `batch`).
//!
//! The numbers are structures of arrays: each array is a row-major matrix with one row per number and one column per
//! instance, so that `joint_angles` of N instances are all angles of the first joint, then all of the second. N is any
//! number, that of the statuses. The instruction set is chosen when a function runs: AVX-512, AVX2 with FMA, or that of the
//! build.
//!
//! Without the feature `fused` the results have the bits of the model's functions for one state. With it they differ by
//! rounding where the processor fuses products with sums and the build does not.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::batch::{Batch, States, StatesAfter, Status};
//!
//! const N: usize = 3;
//! let states = States {
//!     base_poses: &[0.0; 3 * N],
//!     joint_angles: &[0.5; JOINTS * N],
//!     base_twists: &[0.0, 0.0, 0.0, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0], // all ω, then all vx, then all vy
//!     joint_rates: &[0.0; JOINTS * N],
//! };
//! let mut after = StatesAfter {
//!     base_poses: &mut [0.0; 3 * N],
//!     joint_angles: &mut [0.0; JOINTS * N],
//!     base_twists: &mut [0.0; 3 * N],
//!     joint_rates: &mut [0.0; JOINTS * N],
//! };
//! let (robot, mut statuses) = (Model::<f64>::default(), [Status::Done; N]);
//! Batch::new(&robot).runge_kutta_step(&states, &[0.0; JOINTS * N], 0.5, &mut after, &mut statuses)?;
//! // no torques act: in 0.5 s each robot drifts by half its velocity
//! assert_eq!(statuses, [Status::Done; N]);
//! assert!(after.base_poses[N..].iter().zip([0.05, 0.1, 0.15]).all(|(x, drift)| (x - drift).abs() < 1e-15));
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

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
        Checks, Lines, Number, Place, Rows, Statuses, put, put_matrix, take, take_matrix, where_finite, zeros,
        zeros_of_matrix,
    };
}
