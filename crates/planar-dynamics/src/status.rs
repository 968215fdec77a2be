//! What became of one instance of a batch.
//!
//! # Example
//! ```
//! # #[cfg(feature = "batch")]
//! # {
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::batch::{Accelerations, Batch, States};
//! use planar_dynamics::status::Status;
//!
//! // two instances, one with an angle that is not a number
//! let (three, mut joint_angles) = ([0.0; 3 * 2], [0.5; JOINTS * 2]);
//! joint_angles[1] = f64::NAN;
//! let zero = [0.0; JOINTS * 2];
//! let states = States { base_poses: &three, joint_angles: &joint_angles, base_twists: &three, joint_rates: &zero };
//! let mut results = Accelerations { base: &mut [7.0; 3 * 2], joints: &mut [7.0; JOINTS * 2] };
//! let mut statuses = [Status::default(); 2];
//! let robot = Model::<f64>::default();
//! Batch::new(&robot).forward_dynamics(&states, &zero, &mut results, &mut statuses).expect("two columns each");
//! assert_eq!(statuses, [Status::Done, Status::NotFinite]);
//! // a robot at rest without forces stays at rest; nothing is written for the other
//! assert_eq!(results.base[..2], [0.0, 7.0]);
//! # }
//! ```

/// What became of one instance of a batch; its results are written where it is `Done`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(u8)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Status {
    /// Computed.
    #[default]
    Done = 0,
    /// A pivot at or below 8 roundings: [`Error::Singular`](crate::error::Error::Singular) of the model's trait.
    Singular = 1,
    /// A number that is NaN or infinite, given or computed: [`Error::NotFinite`](crate::error::Error::NotFinite).
    NotFinite = 2,
}
