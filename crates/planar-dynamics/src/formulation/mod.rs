//! The differential equation of a controlled robot and its actuators' work: in full coordinates, in
//! [`ReducedCoordinates`] and in [`CanonicalVariables`]; and that of a robot with [`PrescribedJoints`].
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::control::ZeroTorque;
//! use planar_dynamics::dynamics::MomentumAndEnergy;
//! use planar_dynamics::integrate::RungeKutta4;
//! use planar_dynamics::state::{State, vector_length};
//!
//! const LENGTH: usize = vector_length(JOINTS);
//! let (robot, mut torques) = (Model::<f64>::default(), [0.0; JOINTS]);
//! let (joint_angles, joint_rates) = (&[0.5; JOINTS], &[0.2; JOINTS]);
//! let start = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let (mut x, mut workspace) = ([0.0; LENGTH], [0.0; 3 * LENGTH]);
//! start.write(&mut x)?;
//! let mut integrator = RungeKutta4::new(&mut workspace)?;
//! for step in 0..100 {
//!     integrator.robot_step(&robot, &mut ZeroTorque, 0.01 * f64::from(step), 0.01, &mut x, &mut torques)?;
//! }
//! // without torques the kinetic energy stays as it was
//! let energy = |state: &State<'_, f64>| MomentumAndEnergy::momentum(&robot, state).map(|all| all.kinetic_energy);
//! assert!((energy(&State::from_vector(&x, JOINTS)?)? / energy(&start)? - 1.0).abs() < 1e-9);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

mod canonical_variables;
mod prescribed_joints;
mod reduced_coordinates;

pub use canonical_variables::CanonicalVariables;
pub use prescribed_joints::PrescribedJoints;
pub use reduced_coordinates::ReducedCoordinates;

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{copy, power};
use crate::read_again::read_again;
use crate::scalar::Real;
use crate::state::{Forces, State, StateVector, coordinates_mut, split, split_mut};
use crate::validate::length;

/// d/dt of an integrated vector, see [`vector_length`](crate::state::vector_length), under the joint and base torques of a
/// control law; no other forces. Free bodies keep their twists.
///
/// `torques` (joints) holds the torques at this time afterwards.
///
/// # Errors
/// [`Error::Length`], [`Error::StateVector`] unless `x` and `rate` are vectors of the robot and free bodies, and those of
/// the model and the law.
#[inline]
pub fn derivative<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    control: &mut (impl Control<T, M> + ?Sized),
    time: T,
    x: &[T],
    rate: &mut [T],
    torques: &mut [T],
) -> Result<(), Error> {
    length("state vector", x.len(), rate.len())?;
    let StateVector { positions: velocities, rates, work } = split_mut(rate)?;
    *work = accelerations(model, control, time, x, rates, torques)?;
    copy(split(x)?.rates, velocities);
    Ok(())
}

/// The part of [`derivative`] that the equations of motion give: accelerations, and power and base torque of the actuators.
#[cfg_attr(target_arch = "arm", inline)]
#[cfg_attr(not(target_arch = "arm"), inline(always))]
#[allow(clippy::inline_always, reason = "a call would pass all numbers through memory")]
pub(crate) fn accelerations<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    control: &mut (impl Control<T, M> + ?Sized),
    time: T,
    x: &[T],
    rates: &mut [T],
    torques: &mut [T],
) -> Result<[T; 3], Error> {
    // by every stage of a loop
    let model = read_again(model);
    let joints = model.joints();
    let state = State::from_vector(x, joints)?;
    control.joint_torques(time, model, &state, torques)?;
    let accelerations = coordinates_mut(rates, joints)?;
    accelerations.bodies.as_flattened_mut().fill(T::ZERO);
    let base_torque = control.base_torque().map(|base| base.torque);
    let base_wrench = base_torque.map(|torque| [torque, T::ZERO, T::ZERO]);
    let forces = Forces { base_wrench, ..Forces::torques(torques) };
    *accelerations.base = model.forward_dynamics(&state, &forces, accelerations.joints)?;
    let [omega, ..] = state.base_twist;
    let of_base = base_torque.map_or([T::ZERO; 2], |torque| [torque * omega, torque]);
    Ok([power(torques, state.joint_rates), of_base[0], of_base[1]])
}
