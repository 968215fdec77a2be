//! A law that is given positions and velocities in the inertial frame, whatever origin and frame a study is computed in.

use crate::control::{BaseTorque, Control};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::simulate::translation::translate;
use crate::state::State;

/// Another law, and where the origin is in the inertial frame.
pub(crate) struct InertialFrame<'l> {
    pub law: &'l mut dyn Control<f64>,
    /// [x, y] at the start of a phase, m.
    pub origin: [f64; 2],
    /// m/s.
    pub velocity: [f64; 2],
}

impl InertialFrame<'_> {
    /// The law for states about the origin: itself where that is the inertial one.
    #[allow(clippy::float_cmp, reason = "numbers that are copied")]
    pub(crate) fn as_given(&mut self) -> &mut dyn Control<f64> {
        if self.origin == [0.0; 2] && self.velocity == [0.0; 2] { &mut *self.law } else { self }
    }

    fn state<'s>(&self, time: f64, state: &State<'s, f64>) -> State<'s, f64> {
        let mut moved = *state;
        translate(&mut moved.base_pose, [0, 1].map(|i: usize| self.origin[i] + time * self.velocity[i]));
        translate(&mut moved.base_twist, self.velocity);
        moved
    }
}

impl Control<f64> for InertialFrame<'_> {
    fn joint_torques(
        &mut self,
        time: f64,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        let state = self.state(time, state);
        self.law.joint_torques(time, model, &state, torques)
    }

    fn begin_step(&mut self, time: f64, model: &AnyModel<f64>, state: &State<'_, f64>) -> Result<(), Error> {
        let state = self.state(time, state);
        self.law.begin_step(time, model, &state)
    }

    fn has_feedback(&self) -> bool {
        self.law.has_feedback()
    }

    fn held_steps(&self) -> Option<u32> {
        self.law.held_steps()
    }

    fn is_constant(&self) -> bool {
        self.law.is_constant()
    }

    fn sample_beside(
        &mut self,
        time: f64,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        held: &mut [f64],
    ) -> Result<(), Error> {
        let state = self.state(time, state);
        self.law.sample_beside(time, model, &state, held)
    }

    fn has_memory(&self) -> bool {
        self.law.has_memory()
    }

    fn singularity_margin(&self) -> Option<f64> {
        self.law.singularity_margin()
    }

    fn is_limited(&self) -> bool {
        self.law.is_limited()
    }

    fn exchange_held(&mut self, held: &mut [f64]) {
        self.law.exchange_held(held);
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        self.law.base_torque()
    }

    fn saturated(&self) -> &[bool] {
        self.law.saturated()
    }
}
