//! Joint torques of the approach and after the impact, and the torque of a base actuator.

mod computed_torque;
mod inverse_dynamics;
mod proportional_derivative;
mod resolved_motion_rate;
mod sampled_control;
mod stabilisation;
mod torque_limiter;

pub use computed_torque::ComputedTorque;
pub use inverse_dynamics::InverseDynamics;
pub use proportional_derivative::ProportionalDerivative;
pub use resolved_motion_rate::{EndEffectorWorkspace, ResolvedMotionRate};
pub use sampled_control::Sampled;
pub use stabilisation::Stabilise;
pub use torque_limiter::Limited;

use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::{Desired, Trajectory};

/// A law for the joint torques. It is asked at every stage of a step, so that it acts continuously in time, unless it
/// is [`Sampled`].
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

    /// Called once at the start of every step, before the torques of the step are asked for: where a sampled law looks
    /// at the robot. A continuous law has nothing to do.
    ///
    /// # Errors
    /// As [`Control::joint_torques`].
    fn begin_step(&mut self, _time: T, _model: &dyn Model<T>, _state: &State<'_, T>) -> Result<(), Error> {
        Ok(())
    }

    /// For how many steps from now on the torques are held, asked after [`Control::begin_step`]; `None` for a law that
    /// acts continuously. An integrator with steps of its own starts anew where they change.
    fn held_steps(&self) -> Option<u32> {
        None
    }

    /// The torque on the base that goes with the joint torques last asked for; `None` where there is no such actuator.
    fn base_torque(&self) -> Option<BaseTorque<T>> {
        None
    }

    /// Which joints were at their limits in the torques last asked for; empty for a law without limits.
    fn saturated(&self) -> &[bool] {
        &[]
    }
}

/// A moment on the base from outside the robot: thrusters, magnetic torquers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BaseTorque<T> {
    /// N m.
    pub torque: T,
    /// Whether more was wanted than there is.
    pub saturated: bool,
}

impl<T: Real, C: Control<T> + ?Sized> Control<T> for &mut C {
    fn joint_torques(
        &mut self,
        time: T,
        model: &dyn Model<T>,
        state: &State<'_, T>,
        torques: &mut [T],
    ) -> Result<(), Error> {
        (**self).joint_torques(time, model, state, torques)
    }

    fn begin_step(&mut self, time: T, model: &dyn Model<T>, state: &State<'_, T>) -> Result<(), Error> {
        (**self).begin_step(time, model, state)
    }

    fn held_steps(&self) -> Option<u32> {
        (**self).held_steps()
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        (**self).base_torque()
    }

    fn saturated(&self) -> &[bool] {
        (**self).saturated()
    }
}

/// No torque: the paper's post-impact phase.
#[derive(Clone, Copy, Debug, Default)]
pub struct ZeroTorque;

impl<T: Real> Control<T> for ZeroTorque {
    fn joint_torques(&mut self, _: T, _: &dyn Model<T>, _: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        torques.fill(T::ZERO);
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

/// Eq. (2): `τ = I θ̈ + c`, the torques that give the joints these accelerations, whatever the base does.
fn inverse_dynamics<T: Real>(
    generalized_inertia: &[T],
    generalized_bias: &[T],
    torques: &mut [T],
    mut acceleration: impl FnMut(usize) -> Result<T, Error>,
) -> Result<(), Error> {
    for (torque, bias) in torques.iter_mut().zip(generalized_bias) {
        *torque = *bias;
    }
    for (joint, column) in generalized_inertia.chunks_exact(torques.len().max(1)).enumerate() {
        // I is symmetric: its rows are its columns
        let acceleration = acceleration(joint)?;
        for (torque, entry) in torques.iter_mut().zip(column) {
            *torque += *entry * acceleration;
        }
    }
    Ok(())
}
