//! Joint trajectories of the approach, from the initial angles to the final ones, and paths of the end effectors.
//!
//! Outside 0 ≤ t ≤ duration a trajectory stays at the nearer end.

mod constant_setpoint;
mod cycloidal;
mod end_effector_path;
mod kind;
mod quartic;
mod quintic;

pub use constant_setpoint::ConstantSetpoint;
pub use cycloidal::Cycloidal;
pub use end_effector_path::{DesiredEndEffector, EndEffectorPath};
pub use kind::{AnyTrajectory, JointTrajectory, Properties, TrajectoryKind};
pub use quartic::{Quartic, QuarticAsPrinted};
pub use quintic::{Quintic, quintic};

use crate::scalar::Real;

/// What one joint should do at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Desired<T> {
    /// rad.
    pub angle: T,
    /// rad/s.
    pub rate: T,
    /// rad/s².
    pub acceleration: T,
}

/// Desired motion of every joint.
pub trait Trajectory<T> {
    /// What `joint` should do at `time` (s); `None` for a joint that the trajectory does not have.
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>>;
}

/// Ends of a joint motion, in slices of one value per joint.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a, T> {
    /// Angles at time 0, rad.
    pub initial_angles: &'a [T],
    /// Angles at the end, rad.
    pub final_angles: &'a [T],
    /// s, positive.
    pub duration: T,
}

impl<T: Real> Ends<'_, T> {
    /// Initial and final angle of a joint.
    fn angles(&self, joint: usize) -> Option<[T; 2]> {
        Some([*self.initial_angles.get(joint)?, *self.final_angles.get(joint)?])
    }
}

/// τ = t/T, in 0..=1.
fn part<T: Real>(time: T, duration: T) -> T {
    let tau = time / duration;
    let tau = if tau > T::ONE { T::ONE } else { tau };
    if tau < T::ZERO { T::ZERO } else { tau }
}
