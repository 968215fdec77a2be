//! The differential equation of a controlled robot, with the work of its joint torques beside it.

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::{Forces, State, vector_length};

/// d/dt of `[base_pose, joint_angles, base_twist, joint_rates, work]` under a control law; no other forces.
///
/// `torques` (joints) is left with the torques at this time.
///
/// # Errors
/// [`Error::Length`] unless `x` and `rate` have [`vector_length`] entries, and what model and law say.
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
    if rate.len() != expected || x.len() != expected {
        return Err(wrong(x.len().min(rate.len())));
    }
    let state = State::from_vector(x, joints).ok_or(wrong(x.len()))?;
    control.joint_torques(time, model, &state, torques)?;
    let (velocities, accelerations) = rate.split_at_mut(3 + joints);
    for (place, value) in velocities.iter_mut().zip(state.base_twist.iter().chain(state.joint_rates)) {
        *place = *value;
    }
    let (base, rest) = accelerations.split_at_mut(3);
    let (joint_accelerations, work) = rest.split_at_mut(joints);
    base.copy_from_slice(&model.forward_dynamics(&state, &Forces::torques(torques), joint_accelerations)?);
    let power = torques.iter().zip(state.joint_rates).fold(T::ZERO, |sum, (t, r)| sum + *t * *r);
    work.fill(power);
    Ok(())
}
