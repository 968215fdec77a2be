//! Control laws: joint torques, and the torque of a base actuator, from the state.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::control::{Control, ProportionalDerivative};
//! use planar_dynamics::state::State;
//! use planar_dynamics::trajectory::ConstantSetpoint;
//!
//! let mut law = ProportionalDerivative {
//!     trajectory: ConstantSetpoint { angles: &[1.0; JOINTS] },
//!     proportional_gain: &[10.0; JOINTS],
//!     derivative_gain: &[2.0; JOINTS],
//! };
//! let (joint_angles, joint_rates) = (&[0.5; JOINTS], &[0.25; JOINTS]);
//! let state = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let mut torques = [0.0; JOINTS];
//! law.joint_torques(0.0, &Model::<f64>::default(), &state, &mut torques)?;
//! // 10 N m/rad · (1 − 0.5) rad − 2 N m s/rad · 0.25 rad/s
//! assert_eq!(torques, [4.5; JOINTS]);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

mod computed_torque;
mod estimated_state;
mod inverse_dynamics;
mod proportional_derivative;
mod resolved_motion_rate;
mod sampled_control;
mod stabilisation;
mod torque_limiter;

pub use computed_torque::ComputedTorque;
pub use estimated_state::{EstimatedState, Estimator};
pub use inverse_dynamics::InverseDynamics;
pub use proportional_derivative::ProportionalDerivative;
pub use resolved_motion_rate::{EndEffectorWorkspace, ResolvedMotionRate};
pub use sampled_control::SampledControl;
pub use stabilisation::Stabilisation;
pub use torque_limiter::TorqueLimiter;

use crate::dynamics::{AnyModel, Model};
use crate::error::Error;
use crate::linear::{add_scaled, copy, matrix_rows};
use crate::scalar::Real;
use crate::state::State;
use crate::trajectory::{DesiredJoint, Trajectory};

/// A law for the joint torques. It is evaluated at every stage of a step, and so acts continuously in time, unless it is a
/// [`SampledControl`].
pub trait Control<T: Real, M: Model<T> + ?Sized = AnyModel<T>> {
    /// Fills the torques (N m) for a robot in `state` at `time` (s).
    ///
    /// # Errors
    /// Those of the model, and [`Error::Length`] for a law of another number of joints.
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error>;

    /// Called once at the start of every step, before its torques are evaluated: a sampled law takes its sample here, a
    /// continuous law does nothing.
    ///
    /// # Errors
    /// As [`Control::joint_torques`].
    fn begin_step(&mut self, _time: T, _model: &M, _state: &State<'_, T>) -> Result<(), Error> {
        Ok(())
    }

    /// Whether the torques depend on the state: fast feedback limits the steps of an explicit integrator, which may take other
    /// formulas then.
    fn has_feedback(&self) -> bool {
        true
    }

    /// For how many steps from now the torques are constant, valid after [`Control::begin_step`]; `None` for a continuous
    /// law. An adaptive integrator restarts where they change.
    fn held_steps(&self) -> Option<u32> {
        None
    }

    /// Whether the torques, with the base torque, are the same from [`Control::begin_step`] to the end of the step, whatever time and
    /// state are: then an integrator may ask for them once.
    fn is_constant(&self) -> bool {
        self.held_steps().is_some()
    }

    /// Takes the sample of the step that [`Control::begin_step`] will begin, for another solution of the same motion: where
    /// that step takes one, the torques in `state` are written to `held`. A continuous law does nothing.
    ///
    /// # Errors
    /// As [`Control::joint_torques`].
    fn sample_beside(&mut self, _time: T, _model: &M, _state: &State<'_, T>, _held: &mut [T]) -> Result<(), Error> {
        Ok(())
    }

    /// Whether the torques depend on earlier calls too, as those of a law with an estimator, a delay or noise do. Such a law
    /// has to be sampled: it is called once per sample, and not for another solution of the same motion, which has its
    /// torques.
    fn has_memory(&self) -> bool {
        false
    }

    /// The ratio of the smallest to the largest singular value of a matrix that the law inverted for its last torques;
    /// `None` before these, and for a law that inverts none.
    fn singularity_margin(&self) -> Option<T> {
        None
    }

    /// Whether a limit within the law acted on its last torques. Their derivatives jump in time where it begins or ceases to
    /// act, and steps across lose their order.
    fn is_limited(&self) -> bool {
        false
    }

    /// Exchanges the torques that are held with those of the other solution.
    fn exchange_held(&mut self, _held: &mut [T]) {}

    /// The base torque that belongs to the last joint torques; `None` without such an actuator.
    fn base_torque(&self) -> Option<BaseTorque<T>> {
        None
    }

    /// Which joints the last torques saturated; empty for a law without limits.
    fn saturated(&self) -> &[bool] {
        &[]
    }
}

/// An external moment on the base, from thrusters or magnetic torquers.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BaseTorque<T> {
    /// N m.
    pub torque: T,
    /// Whether the command exceeded the limit.
    pub saturated: bool,
}

impl<T: Real, M: Model<T> + ?Sized, C: Control<T, M> + ?Sized> Control<T, M> for &mut C {
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        (**self).joint_torques(time, model, state, torques)
    }

    fn begin_step(&mut self, time: T, model: &M, state: &State<'_, T>) -> Result<(), Error> {
        (**self).begin_step(time, model, state)
    }

    fn has_feedback(&self) -> bool {
        (**self).has_feedback()
    }

    fn held_steps(&self) -> Option<u32> {
        (**self).held_steps()
    }

    fn is_constant(&self) -> bool {
        (**self).is_constant()
    }

    fn sample_beside(&mut self, time: T, model: &M, state: &State<'_, T>, held: &mut [T]) -> Result<(), Error> {
        (**self).sample_beside(time, model, state, held)
    }

    fn has_memory(&self) -> bool {
        (**self).has_memory()
    }

    fn singularity_margin(&self) -> Option<T> {
        (**self).singularity_margin()
    }

    fn is_limited(&self) -> bool {
        (**self).is_limited()
    }

    fn exchange_held(&mut self, held: &mut [T]) {
        (**self).exchange_held(held);
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

impl<T: Real, M: Model<T> + ?Sized> Control<T, M> for ZeroTorque {
    fn joint_torques(&mut self, _: T, _: &M, _: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        torques.fill(T::ZERO);
        Ok(())
    }

    fn has_feedback(&self) -> bool {
        false
    }

    fn is_constant(&self) -> bool {
        true
    }
}

/// [`Trajectory::each_joint`], or [`Error::Length`] for a trajectory of fewer joints.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as the law that calls it")]
fn follow<T: Real, J>(
    trajectory: &impl Trajectory<T>,
    time: T,
    joints: impl ExactSizeIterator<Item = J>,
    follow: impl FnMut(J, DesiredJoint<T>),
) -> Result<(), Error> {
    let expected = joints.len();
    trajectory.each_joint(time, joints, follow).ok_or_else(|| missing(trajectory, time, expected))
}

#[cold]
fn missing<T: Real>(trajectory: &impl Trajectory<T>, time: T, expected: usize) -> Error {
    let found = (0..expected).find(|joint| trajectory.joint(*joint, time).is_none()).unwrap_or(expected);
    Error::Length { quantity: "trajectory", expected, found }
}

/// Eq. (2): `τ = I θ̈ + c`, the torques for joint accelerations, which are taken one after the other.
fn inverse_dynamics<'a, T: Real>(
    generalized_inertia: &'a [T],
    generalized_bias: &[T],
    torques: &'a mut [T],
) -> impl FnMut(T) + 'a {
    copy(generalized_bias, torques);
    // I is symmetric: its rows are its columns
    let mut columns = matrix_rows(generalized_inertia, torques.len());
    move |acceleration| {
        if let Some(column) = columns.next() {
            add_scaled(torques, acceleration, column);
        }
    }
}
