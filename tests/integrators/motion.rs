//! The two motions: the paper's approach under PD control, and free tumbling.

use crate::Problem;
use planar_capture::capture::approach::ApproachTracking;
use planar_capture::capture::approach::terminal_rates::terminal_rates;
use planar_capture::control::{BaseTorque, Control, ProportionalDerivative, ZeroTorque};
use planar_capture::dynamics::AnyModel;
use planar_capture::error::Error;
use planar_capture::owned::{CloneModel, RobotState};
use planar_capture::registry;
use planar_capture::scenario::{FinalRates, Scenario, Tracking};
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::Integration;
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Phase, PhaseError, Timing, simulate};
use planar_capture::state::State;
use planar_capture::trajectory::{PointToPoint, Quartic};
use std::f64::consts::PI;
use std::path::Path;

const SCENARIO: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/scenarios/raina_shah_2017.toml");

/// Model and scenario of the motions.
pub struct Problems {
    pub model: Box<dyn CloneModel>,
    scenario: Scenario,
    rates: Vec<f64>,
}

/// Counts the evaluations of a law.
struct Counted<'a> {
    law: &'a mut dyn Control<f64>,
    calls: u64,
}

impl Control<f64> for Counted<'_> {
    fn joint_torques(
        &mut self,
        time: f64,
        model: &AnyModel<f64>,
        state: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        self.calls += 1;
        self.law.joint_torques(time, model, state, torques)
    }

    fn has_feedback(&self) -> bool {
        self.law.has_feedback()
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        self.law.base_torque()
    }
}

impl Problems {
    /// The paper's study.
    pub fn new() -> Result<Self, Problem> {
        let scenario = Scenario::read(Path::new(SCENARIO), registry::SHIPPED)?;
        let model = registry::generated(&scenario.layout)?;
        let FinalRates::EndEffectorTwists(wanted) = &scenario.approach.end else {
            return Err("no wanted twists".into());
        };
        let terminal_rates = terminal_rates(&*model, &ApproachTracking::new(&scenario, 1.0), wanted, &mut || ())?;
        Ok(Self { rates: terminal_rates.joint_rates, model, scenario })
    }

    /// The paper's approach, and its number of evaluations.
    pub fn approach(&self, (integration, step): (Integration, f64)) -> Result<(Phase, u64), PhaseError> {
        let approach = &self.scenario.approach;
        let motion = PointToPoint {
            initial_angles: &self.scenario.initial.joint_angles,
            final_angles: &approach.final_joint_angles,
            duration: approach.duration,
        };
        let trajectory = Quartic { motion, final_rates: &self.rates };
        let Tracking::ProportionalDerivative { proportional_gain, derivative_gain } = &approach.tracking else {
            unreachable!("the paper's approach is under PD control")
        };
        let mut law = ProportionalDerivative { trajectory, proportional_gain, derivative_gain };
        let start = RobotState::from_view(&self.scenario.initial.view());
        let timing = Timing { duration: approach.duration, step, sample: approach.duration, integration, kink: None };
        self.run(&mut law, &start, &timing)
    }

    /// s.
    pub fn approach_duration(&self) -> f64 {
        self.scenario.approach.duration
    }

    /// Free motion of the same robot.
    pub fn free(
        &self,
        start: &RobotState,
        duration: f64,
        sample: f64,
        (integration, step): (Integration, f64),
    ) -> Result<(Phase, u64), PhaseError> {
        let timing = Timing { duration, step, sample, integration, kink: None };
        self.run(&mut ZeroTorque, start, &timing)
    }

    /// Rotation with extended, oscillating arms.
    pub fn turning() -> RobotState {
        RobotState {
            base_pose: [0.0; 3],
            joint_angles: vec![0.15, -0.1, 0.1, PI + 0.1, 0.15, -0.15],
            base_twist: [0.5, 0.02, -0.01],
            joint_rates: vec![0.0; 6],
        }
    }

    /// Tumbling with rates of up to 0.9 rad/s.
    pub fn tumbling() -> RobotState {
        RobotState {
            base_pose: [0.3, 1.0, -2.0],
            joint_angles: vec![0.7, -1.5, 1.0, 2.4, 1.5, -1.0],
            base_twist: [0.2, 0.05, -0.03],
            joint_rates: vec![0.5, -0.8, 0.6, -0.4, 0.9, 0.7],
        }
    }

    fn run(&self, law: &mut dyn Control<f64>, start: &RobotState, timing: &Timing) -> Result<(Phase, u64), PhaseError> {
        let mut law = Counted { law, calls: 0 };
        let phase = simulate(&System::alone(&*self.model), &mut law, start, timing, &mut NoEvents, &mut || ())?;
        let samples = phase.samples.len() as u64; // the law is evaluated for each of them too
        Ok((phase, law.calls - samples))
    }
}

/// Every position and rate at the end of a phase.
pub fn end(phase: &Phase) -> Vec<f64> {
    let state = &phase.end().state;
    [&state.base_pose[..], &state.joint_angles, &state.base_twist, &state.joint_rates].concat()
}
