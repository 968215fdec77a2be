//! Joint torques of another law, saturated at the actuators' limits.

use super::{BaseTorque, Control};
use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::validate::length;

/// The joint torques of another law, each limited to `|τ| ≤ limit`; its base torque is unchanged.
#[derive(Debug)]
pub struct TorqueLimiter<'a, T, C> {
    /// The law whose torques are limited.
    pub law: C,
    /// One per joint, N m, 0 or more.
    pub torque_limits: &'a [T],
    /// One per joint: whether the last torque exceeded its limit.
    pub saturated: &'a mut [bool],
}

impl<T: Real, M: Model<T> + ?Sized, C: Control<T, M>> Control<T, M> for TorqueLimiter<'_, T, C> {
    #[inline]
    fn joint_torques(&mut self, time: T, model: &M, state: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        length("torque_limits", torques.len(), self.torque_limits.len())?;
        length("saturated", torques.len(), self.saturated.len())?;
        self.law.joint_torques(time, model, state, torques)?;
        let limits = self.torque_limits.iter().zip(self.saturated.iter_mut());
        for (torque, (limit, saturated)) in torques.iter_mut().zip(limits) {
            *saturated = torque.abs() > *limit;
            *torque = torque.limit_magnitude(*limit);
        }
        Ok(())
    }

    fn begin_step(&mut self, time: T, model: &M, state: &State<'_, T>) -> Result<(), Error> {
        self.law.begin_step(time, model, state)
    }

    fn held_steps(&self) -> Option<u32> {
        self.law.held_steps()
    }

    fn is_constant(&self) -> bool {
        self.law.is_constant()
    }

    fn sample_beside(&mut self, time: T, model: &M, state: &State<'_, T>, held: &mut [T]) -> Result<(), Error> {
        self.law.sample_beside(time, model, state, held)
    }

    fn has_memory(&self) -> bool {
        self.law.has_memory()
    }

    fn singularity_margin(&self) -> Option<T> {
        self.law.singularity_margin()
    }

    fn is_limited(&self) -> bool {
        self.law.is_limited()
    }

    fn exchange_held(&mut self, held: &mut [T]) {
        self.law.exchange_held(held);
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        self.law.base_torque()
    }

    fn saturated(&self) -> &[bool] {
        self.saturated
    }
}
