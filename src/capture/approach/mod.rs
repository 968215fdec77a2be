//! The approach of a scenario: its trajectory, eqs. (6) and (7), followed by its tracking law, eq. (18).

mod collocation;
pub mod end_effector_paths;
pub mod exact_end;
pub mod inverse_kinematics;
pub mod terminal_rates;

use crate::capture::approach::end_effector_paths::EndEffectorFeedback;
use crate::capture::approach::exact_end::{ApproachEnd, exact_end};
use crate::control::{ComputedTorque, Control, InverseDynamics, ProportionalDerivative};
use crate::dynamics::AnyModel;
use crate::owned::RobotState;
use crate::scenario::{self, Scenario, Tracking};
use crate::simulate::actuators::drive;
use crate::simulate::event::Events;
use crate::simulate::system::System;
use crate::simulate::{Phase, PhaseError, Timing, simulate};
use crate::trajectory::{AnyTrajectory, PointToPoint};

/// The approach of one scenario.
#[derive(Clone, Copy, Debug)]
pub struct ApproachTracking<'a> {
    scenario: &'a Scenario,
    timing: Timing,
}

impl<'a> ApproachTracking<'a> {
    /// The approach that a scenario describes, sampled every `sample` seconds.
    #[must_use]
    pub fn new(scenario: &'a Scenario, sample: f64) -> Self {
        let scenario::Approach { duration, step, integration, .. } = scenario.approach;
        Self { scenario, timing: Timing { duration, step, sample, integration } }
    }

    /// Number of steps.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.timing.steps()
    }

    /// Simulates it under the scenario's tracking law, with the trajectory's final rates (rad/s; a cycloidal trajectory
    /// has none), up to the first of the events.
    ///
    /// # Errors
    /// When and why it stopped.
    pub fn track(
        &self,
        model: &AnyModel<f64>,
        rates: &[f64],
        events: &mut dyn Events,
        tick: &mut dyn FnMut(),
    ) -> Result<Phase, PhaseError> {
        let trajectory = self.trajectory(rates);
        let joints = model.joints();
        let initial = &self.scenario.initial;
        let actuation = &self.scenario.approach.actuation;
        let mut drive = |law: &mut dyn Control<f64>| {
            drive(&self.system(model), law, actuation, initial, &self.timing, events, tick)
        };
        match &self.scenario.approach.tracking {
            Tracking::InverseDynamics => self.by_inverse_dynamics(model, rates, events, tick),
            Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => {
                drive(&mut ProportionalDerivative { trajectory, proportional_gain, derivative_gain })
            }
            Tracking::ComputedTorque { proportional_gain, derivative_gain } => drive(&mut ComputedTorque {
                trajectory,
                proportional_gain,
                derivative_gain,
                generalized_inertia: &mut vec![0.0; joints * joints],
                generalized_bias: &mut vec![0.0; joints],
                generalized_jacobian: &mut vec![0.0; 3 * model.arms() * joints],
            }),
            Tracking::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold } => {
                let mut end_effectors = EndEffectorFeedback::new(model, self.scenario)?;
                let mut law = end_effectors.law([*pose_gain, *rate_gain], *singularity_threshold);
                let phase = drive(&mut law)?;
                Ok(Phase { singularity_margin: law.singularity_margin, ..phase })
            }
        }
    }

    /// Its end when it is tracked exactly, for a design: whatever the scenario's law and integrator are.
    ///
    /// # Errors
    /// When and why it has none.
    pub(crate) fn exact_end(&self, model: &AnyModel<f64>, rates: &[f64]) -> Result<ApproachEnd, PhaseError> {
        let approach = &self.scenario.approach;
        let mut knots = vec![approach.trajectory_time().min(approach.duration), approach.duration];
        knots.dedup();
        exact_end(model, self.trajectory(rates), &self.start(), &knots)
    }

    /// Where an exactly tracked approach begins: the joints have the trajectory's initial rates.
    fn start(&self) -> RobotState {
        let mut initial = self.scenario.initial.clone();
        if self.scenario.approach.trajectory.properties().starts_at_rest {
            initial.joint_rates.fill(0.0);
        }
        initial
    }

    /// Simulates it with torques from inverse dynamics.
    fn by_inverse_dynamics(
        &self,
        model: &AnyModel<f64>,
        rates: &[f64],
        events: &mut dyn Events,
        tick: &mut dyn FnMut(),
    ) -> Result<Phase, PhaseError> {
        let joints = model.joints();
        let mut law = InverseDynamics {
            trajectory: self.trajectory(rates),
            generalized_inertia: &mut vec![0.0; joints * joints],
            generalized_bias: &mut vec![0.0; joints],
            generalized_jacobian: &mut vec![0.0; 3 * model.arms() * joints],
        };
        simulate(&self.system(model), &mut law, &self.start(), &self.timing, events, tick)
    }

    fn system<'s>(&'s self, model: &'s AnyModel<f64>) -> System<'s> {
        System { joint_limits: &self.scenario.joint_limits, reach: self.scenario.reach(), ..System::alone(model) }
    }

    fn trajectory<'r>(&'r self, final_rates: &'r [f64]) -> AnyTrajectory<'r, f64> {
        let motion = PointToPoint {
            initial_angles: &self.scenario.initial.joint_angles,
            final_angles: &self.scenario.approach.final_joint_angles,
            duration: self.scenario.approach.trajectory_time(),
        };
        self.scenario.approach.trajectory.trajectory(motion, &self.scenario.initial.joint_rates, final_rates)
    }
}
