//! The differential equation of a controlled robot, with what its actuators do beside it: in full coordinates, in [`Reduced`] ones and in [`Canonical`] variables.

mod canonical;
mod reduced;

pub use canonical::Canonical;
pub use reduced::Reduced;

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Forces, State, halves, vector_length};

/// d/dt of `[base_pose, joint_angles, base_twist, joint_rates, joint_work, base_work, base_impulse]` under a control law:
/// its joint torques and, where it has one, its base torque; no other forces. The last three are an
/// [`ActuatorWork`](crate::state::ActuatorWork).
///
/// Free bodies beside the robot, see [`vector_length`], keep their twists.
/// `torques` (joints) is left with the torques at this time.
///
/// # Errors
/// [`Error::Length`] unless `x` and `rate` have [`vector_length`] entries, or more by 6 for each free body, and what model
/// and law say.
pub fn derivative<T: Real>(
    model: &dyn Model<T>,
    control: &mut dyn Control<T>,
    time: T,
    x: &[T],
    rate: &mut [T],
    torques: &mut [T],
) -> Result<(), Error> {
    let joints = model.joints();
    let expected = vector_length(joints);
    let wrong = |found| Error::Length { quantity: "state vector", expected, found };
    if rate.len() != x.len() || x.len() < expected || !(x.len() - expected).is_multiple_of(6) {
        return Err(wrong(x.len().min(rate.len())));
    }
    let state = State::from_vector(x, joints).ok_or(wrong(x.len()))?;
    control.joint_torques(time, model, &state, torques)?;
    let (_, twists) = halves(x).ok_or(wrong(x.len()))?;
    let (velocities, accelerations) = rate.split_at_mut(twists.len());
    velocities.copy_from_slice(twists);
    let (accelerations, work) = accelerations.split_at_mut(twists.len());
    let (base, rest) = accelerations.split_at_mut(3);
    let (joint_accelerations, of_bodies) = rest.split_at_mut(joints);
    of_bodies.fill(T::ZERO);
    let base_torque = control.base_torque().map(|base| base.torque);
    let base_wrench = base_torque.map(|torque| [torque, T::ZERO, T::ZERO]);
    let forces = Forces { base_wrench, ..Forces::torques(torques) };
    base.copy_from_slice(&model.forward_dynamics(&state, &forces, joint_accelerations)?);
    let joint_power = torques.iter().zip(state.joint_rates).fold(T::ZERO, |sum, (t, r)| sum + *t * *r);
    let [omega, ..] = state.base_twist;
    let base_torque = base_torque.unwrap_or(T::ZERO);
    for (place, value) in work.iter_mut().zip([joint_power, base_torque * omega, base_torque]) {
        *place = value;
    }
    Ok(())
}
