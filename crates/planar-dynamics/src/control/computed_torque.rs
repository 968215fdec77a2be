//! Joint torques by inverse dynamics with feedback.

use super::{Control, follow, inverse_dynamics};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::Trajectory;
use crate::validate::length;

/// Computed torque in the reduced equations: `τ = I (θ̈_d + K_v (θ̇_d − θ̇) + K_p (θ_d − θ)) + c`.
///
/// I and c are evaluated at the measured state, including the robot's momentum, so that the error of every joint obeys
/// `ë + K_v ė + K_p e = 0` independently of the base. The slices `generalized_…` are working space.
#[derive(Debug)]
pub struct ComputedTorque<'a, T, R> {
    /// Desired angles, rates and accelerations.
    pub trajectory: R,
    /// Diagonal of `K_p`, 1/s².
    pub proportional_gain: &'a [T],
    /// Diagonal of `K_v`, 1/s.
    pub derivative_gain: &'a [T],
    /// joints².
    pub generalized_inertia: &'a mut [T],
    /// joints.
    pub generalized_bias: &'a mut [T],
    /// 3 arms × joints.
    pub generalized_jacobian: &'a mut [T],
}

impl<T: Real, M: Model<T> + ?Sized, R: Trajectory<T>> Control<T, M> for ComputedTorque<'_, T, R> {
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let joints = model.joints();
        length("joint_torques", joints, torques.len())?;
        length("proportional_gain", joints, self.proportional_gain.len())?;
        length("derivative_gain", joints, self.derivative_gain.len())?;
        model.reduced_dynamics(state, self.generalized_inertia, self.generalized_bias, self.generalized_jacobian)?;
        let gains = self.proportional_gain.iter().zip(self.derivative_gain);
        let measured = state.joint_angles.iter().zip(state.joint_rates);
        let mut add = inverse_dynamics(self.generalized_inertia, self.generalized_bias, torques);
        follow(&self.trajectory, time, gains.zip(measured), |((kp, kv), (angle, rate)), desired| {
            add(desired.acceleration + (*kp * (desired.angle - *angle) + *kv * (desired.rate - *rate)));
        })
    }
}
