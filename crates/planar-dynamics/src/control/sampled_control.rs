//! Sampled-data control: the torques of another law at a fixed rate, with a zero-order hold.

use super::{BaseTorque, Control};
use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::copy;
use crate::scalar::Real;
use crate::state::State;
use crate::validate::length;

/// Another law, evaluated at the start of every n-th step; its torques are constant in between (zero-order hold).
///
/// Steps are counted, so that rounding of the time cannot shift a sample.
#[derive(Debug)]
pub struct SampledControl<'a, T, C> {
    law: C,
    steps_per_sample: u32,
    steps_left: u32,
    held: &'a mut [T],
}

impl<'a, T: Real, C> SampledControl<'a, T, C> {
    /// `held` (joints) stores the torques; they are zero until the first step begins. No step per sample counts as one.
    pub fn new(law: C, steps_per_sample: u32, held: &'a mut [T]) -> Self {
        held.fill(T::ZERO);
        Self { law, steps_per_sample: steps_per_sample.max(1), steps_left: 0, held }
    }
}

impl<T: Real, M: Model<T> + ?Sized, C: Control<T, M>> Control<T, M> for SampledControl<'_, T, C> {
    fn joint_torques(&mut self, _: T, _: &M, _: &State<'_, T>, torques: &mut [T]) -> Result<(), Error> {
        length("joint_torques", self.held.len(), torques.len())?;
        copy(self.held, torques);
        Ok(())
    }

    fn begin_step(&mut self, time: T, model: &M, state: &State<'_, T>) -> Result<(), Error> {
        self.law.begin_step(time, model, state)?;
        if self.steps_left == 0 {
            self.law.joint_torques(time, model, state, self.held)?;
            self.steps_left = self.steps_per_sample;
        }
        self.steps_left = self.steps_left.saturating_sub(1);
        Ok(())
    }

    fn held_steps(&self) -> Option<u32> {
        Some(self.steps_left.saturating_add(1))
    }

    fn sample_beside(&mut self, time: T, model: &M, state: &State<'_, T>, held: &mut [T]) -> Result<(), Error> {
        if self.steps_left == 0 && !self.law.has_memory() {
            self.law.joint_torques(time, model, state, held)
        } else {
            Ok(())
        }
    }

    fn singularity_margin(&self) -> Option<T> {
        self.law.singularity_margin()
    }

    fn is_limited(&self) -> bool {
        self.law.is_limited()
    }

    fn exchange_held(&mut self, held: &mut [T]) {
        if self.law.has_memory() {
            return;
        }
        for (own, other) in self.held.iter_mut().zip(held) {
            core::mem::swap(own, other);
        }
    }

    fn base_torque(&self) -> Option<BaseTorque<T>> {
        self.law.base_torque()
    }

    fn saturated(&self) -> &[bool] {
        self.law.saturated()
    }
}
