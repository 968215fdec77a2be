//! The differential equation of a controlled robot, with what its actuators do beside it: in full coordinates, in
//! [`Reduced`] ones and in [`Canonical`] variables.

mod canonical_variables;
mod reduced_coordinates;

pub use canonical_variables::Canonical;
pub use reduced_coordinates::Reduced;

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{copy, dot};
use crate::scalar::Real;
use crate::state::{CoordinatesMut, Forces, State, StateVector, StateVectorMut, split, split_mut};
use crate::validate::length;

/// d/dt of `[base_pose, joint_angles, base_twist, joint_rates, joint_work, base_work, base_impulse]` under a control
/// law: its joint torques and, where it has one, its base torque; no other forces. The last three are an
/// [`ActuatorWork`](crate::state::ActuatorWork).
///
/// Free bodies beside the robot, see [`vector_length`](crate::state::vector_length), keep their twists.
/// `torques` (joints) is left with the torques at this time.
///
/// # Errors
/// [`Error::Length`], [`Error::StateVector`] unless `x` and `rate` are vectors of the robot and bodies beside it, and
/// what model and law say.
pub fn derivative<T: Real>(
    model: &dyn Model<T>,
    control: &mut dyn Control<T>,
    time: T,
    x: &[T],
    rate: &mut [T],
    torques: &mut [T],
) -> Result<(), Error> {
    let joints = model.joints();
    length("state vector", x.len(), rate.len())?;
    let state = State::from_vector(x, joints)?;
    control.joint_torques(time, model, &state, torques)?;
    let StateVector { rates: twists, .. } = split(x)?;
    let StateVectorMut { positions: velocities, rates: accelerations, work } = split_mut(rate)?;
    copy(twists, velocities);
    let accelerations = CoordinatesMut::new(accelerations, joints)?;
    accelerations.bodies.as_flattened_mut().fill(T::ZERO);
    let base_torque = control.base_torque().map(|base| base.torque);
    let base_wrench = base_torque.map(|torque| [torque, T::ZERO, T::ZERO]);
    let forces = Forces { base_wrench, ..Forces::torques(torques) };
    *accelerations.base = model.forward_dynamics(&state, &forces, accelerations.joints)?;
    let [omega, ..] = state.base_twist;
    let base_torque = base_torque.unwrap_or(T::ZERO);
    *work = [dot(torques, state.joint_rates), base_torque * omega, base_torque];
    Ok(())
}
