//! Joint torques during the approach.

use crate::check::length;
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::{Desired, Trajectory};

/// A law for the joint torques, continuous in time: it is asked at every stage of a step.
pub trait Control<T: Real> {
    /// Fills the torques (N m) for a robot in `state` at `time` (s).
    ///
    /// # Errors
    /// What the model says, and [`Error::Length`] where the law is for another number of joints.
    fn joint_torques(
        &mut self,
        time: T,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error>;
}

/// No torque: the paper's post-impact phase.
#[derive(Clone, Copy, Debug, Default)]
pub struct Free;

impl<T: Real> Control<T> for Free {
    fn joint_torques(&mut self, _: T, _: &dyn Model<T>, _: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        torques.fill(T::ZERO);
        Ok(())
    }
}

/// Eq. (18): `τ = K_p (θ_d − θ) + K_v (θ̇_d − θ̇)`, gains per joint.
#[derive(Clone, Copy, Debug)]
pub struct ProportionalDerivative<'a, T, R> {
    /// Desired angles and rates.
    pub trajectory: R,
    /// Diagonal of `K_p`, N m/rad.
    pub proportional_gain: &'a [T],
    /// Diagonal of `K_v`, N m s/rad.
    pub derivative_gain: &'a [T],
}

impl<T: Real, R: Trajectory<T>> Control<T> for ProportionalDerivative<'_, T, R> {
    fn joint_torques(
        &mut self,
        time: T,
        _: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error> {
        let expected = torques.len();
        length("proportional_gain", expected, self.proportional_gain.len())?;
        length("derivative_gain", expected, self.derivative_gain.len())?;
        let gains = self.proportional_gain.iter().zip(self.derivative_gain);
        let joints = state.joint_angles.iter().zip(state.joint_rates).zip(gains);
        for (joint, (torque, ((angle, rate), (kp, kv)))) in torques.iter_mut().zip(joints).enumerate() {
            let desired = desired(&self.trajectory, joint, time, expected)?;
            *torque = *kp * (desired.angle - *angle) + *kv * (desired.rate - *rate);
        }
        Ok(())
    }
}

/// Exact tracking by inverse dynamics: `τ = I θ̈_d + c` gives `θ̈ = θ̈_d`, whatever the base does.
///
/// For a robot that starts on the trajectory. The slices are working space: joints², joints, 3 arms × joints.
#[derive(Debug)]
pub struct ExactTracking<'a, T, R> {
    /// Desired accelerations.
    pub trajectory: R,
    /// joints².
    pub generalized_inertia: &'a mut [T],
    /// joints.
    pub generalized_bias: &'a mut [T],
    /// 3 arms × joints.
    pub generalized_jacobian: &'a mut [T],
}

impl<T: Real, R: Trajectory<T>> Control<T> for ExactTracking<'_, T, R> {
    fn joint_torques(
        &mut self,
        time: T,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error> {
        let joints = model.joints();
        length("joint_torques", joints, torques.len())?;
        model.reduced_dynamics(state, self.generalized_inertia, self.generalized_bias, self.generalized_jacobian)?;
        for (torque, bias) in torques.iter_mut().zip(self.generalized_bias.iter()) {
            *torque = *bias;
        }
        for (joint, column) in self.generalized_inertia.chunks_exact(joints.max(1)).enumerate() {
            // I is symmetric: its rows are its columns
            let acceleration = desired(&self.trajectory, joint, time, joints)?.acceleration;
            for (torque, entry) in torques.iter_mut().zip(column) {
                *torque += *entry * acceleration;
            }
        }
        Ok(())
    }
}

fn desired<T: Real>(
    trajectory: &impl Trajectory<T>,
    joint: usize,
    time: T,
    expected: usize,
) -> Result<Desired<T>, Error> {
    trajectory.joint(joint, time).ok_or(Error::Length { quantity: "trajectory", expected, found: joint })
}
