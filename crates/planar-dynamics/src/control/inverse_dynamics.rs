//! Joint torques by inverse dynamics without feedback.

use super::{Control, follow, inverse_dynamics};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::validate::length;

/// Exact tracking by inverse dynamics: `τ = I θ̈_d + c` gives `θ̈ = θ̈_d`, for any motion of the base.
///
/// For a robot that starts on the trajectory. The slices are working space.
#[derive(Debug)]
pub struct InverseDynamics<'a, T, R> {
    /// Desired accelerations.
    pub trajectory: R,
    /// joints².
    pub generalized_inertia: &'a mut [T],
    /// joints.
    pub generalized_bias: &'a mut [T],
    /// 3 arms × joints.
    pub generalized_jacobian: &'a mut [T],
}

impl<T: Real, M: Model<T> + ?Sized, R: Trajectory<T>> Control<T, M> for InverseDynamics<'_, T, R> {
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let joints = model.joints();
        length("joint_torques", joints, torques.len())?;
        model.reduced_dynamics(state, self.generalized_inertia, self.generalized_bias, self.generalized_jacobian)?;
        let mut add = inverse_dynamics(self.generalized_inertia, self.generalized_bias, torques);
        follow(&self.trajectory, time, 0..joints, |_, desired| add(desired.acceleration))
    }
}
