//! A law that is given positions in the inertial frame, whatever origin a study is computed about.

use crate::control::{BaseTorque, Control};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::simulate::translation::translate;
use crate::state::State;

/// Another law, and the position [x, y] of the study's origin in the inertial frame, m.
pub(crate) struct InertialFrame<'l> {
    pub law: &'l mut dyn Control<f64>,
    pub origin: [f64; 2],
}

impl InertialFrame<'_> {
    fn state<'s>(&self, state: &State<'s, f64>) -> State<'s, f64> {
        let mut base_pose = state.base_pose;
        translate(&mut base_pose, self.origin);
        State { base_pose, ..*state }
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
        let state = self.state(state);
        self.law.joint_torques(time, model, &state, torques)
    }

    fn begin_step(&mut self, time: f64, model: &AnyModel<f64>, state: &State<'_, f64>) -> Result<(), Error> {
        let state = self.state(state);
        self.law.begin_step(time, model, &state)
    }

    fn held_steps(&self) -> Option<u32> {
        self.law.held_steps()
    }

    fn sample_beside(
        &mut self,
        time: f64,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        held: &mut [f64],
    ) -> Result<(), Error> {
        let state = self.state(state);
        self.law.sample_beside(time, model, &state, held)
    }

    fn has_memory(&self) -> bool {
        self.law.has_memory()
    }

    fn singularity_margin(&self) -> Option<f64> {
        self.law.singularity_margin()
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
