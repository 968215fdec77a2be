//! Control by an estimate of the state.

use super::{BaseTorque, Control};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;

/// What a control law knows of the state: a sensor with noise or a delay, a filter, an observer.
pub trait Estimator<T: Real, M: Model<T> + ?Sized> {
    /// The estimate at `time` (s) of a robot in `state`. It is called once per sample, with times that increase.
    ///
    /// # Errors
    /// Those of the model, and [`Error::Length`] for a robot of another number of joints.
    fn estimate(&mut self, time: T, model: &M, state: &State<'_, T>) -> Result<State<'_, T>, Error>;

    /// The joint torques (N m) that the law answers with, which a model-based estimator predicts by.
    fn apply(&mut self, _torques: &[T]) {}
}

/// A law that is given the estimate of an estimator instead of the state. It [has memory](Control::has_memory); estimators
/// are chained by a law that is such a law itself.
#[derive(Clone, Copy, Debug)]
pub struct EstimatedState<E, C> {
    /// Of the state.
    pub estimator: E,
    /// What is given the estimate.
    pub law: C,
}

impl<T: Real, M: Model<T> + ?Sized, E: Estimator<T, M>, C: Control<T, M>> Control<T, M> for EstimatedState<E, C> {
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        let estimate = self.estimator.estimate(time, model, state)?;
        self.law.joint_torques(time, model, &estimate, torques)?;
        self.estimator.apply(torques);
        Ok(())
    }

    fn has_memory(&self) -> bool {
        true
    }

    fn singularity_margin(&self) -> Option<T> {
        self.law.singularity_margin()
    }

    fn is_limited(&self) -> bool {
        self.law.is_limited()
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        self.law.base_torque()
    }

    fn saturated(&self) -> &[bool] {
        self.law.saturated()
    }
}
