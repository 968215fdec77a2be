//! The approach of a scenario: its trajectory, eqs. (6) and (7), followed by its tracking law, eq. (18).
//!
//! # Example
//! ```
//! use planar_capture::capture::approach::ApproachTracking;
//! use planar_capture::registry;
//! use planar_capture::scenario::{Scenario, Tracking};
//! use planar_capture::simulate::event::NoEvents;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! scenario.approach.tracking = Tracking::InverseDynamics;
//! let approach = ApproachTracking::new(&scenario, 1.0);
//! let phase = approach.track(&*robot, &[0.0; 3], &mut NoEvents, &mut || ())?;
//! let end = &phase.end().state;
//! assert!(end.joint_angles.iter().all(|angle| (angle + std::f64::consts::FRAC_PI_2).abs() < 1e-6));
//! assert!(end.joint_rates.iter().all(|rate| rate.abs() < 1e-6));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod collocation;
mod exact_end;
pub mod inverse_kinematics;
pub mod terminal_rates;

use crate::capture::approach::exact_end::{ApproachEnd, exact_end};
use crate::control::Control;
use crate::dynamics::AnyModel;
use crate::laws::{OwnLaws, TrackingLaw, TrackingTask};
use crate::owned::RobotState;
use crate::scenario::{self, Scenario};
use crate::simulate::actuators::drive;
use crate::simulate::event::Events;
use crate::simulate::inertial_frame::InertialFrame;
use crate::simulate::system::System;
use crate::simulate::{Phase, PhaseError, Timing};
use crate::trajectory::{AnyTrajectory, PointToPoint};

/// The approach of one scenario.
#[derive(Clone, Copy, Debug)]
pub struct ApproachTracking<'a> {
    scenario: &'a Scenario,
    timing: Timing,
    own: Option<OwnLaws<'a>>,
}

impl<'a> ApproachTracking<'a> {
    /// The approach that a scenario describes, sampled every `sample` seconds.
    #[must_use]
    pub fn new(scenario: &'a Scenario, sample: f64) -> Self {
        let scenario::Approach { duration, step, integration, trajectory_duration: kink, .. } = scenario.approach;
        let timing = Timing { duration, step, sample, integration, kink };
        Self { scenario, timing: timing.held(scenario.approach.actuation.steps_per_sample), own: None }
    }

    /// Tracked by another law than the scenario's, where there is one.
    #[must_use]
    pub(crate) fn with(self, own: Option<OwnLaws<'a>>) -> Self {
        Self { own, ..self }
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
        let own = self.own.and_then(|own| Some((own, own.laws.tracking?)));
        let (law, scenario): (&dyn TrackingLaw, _) = match own {
            Some((own, law)) => (law, own.scenario),
            None => (&self.scenario.approach.tracking, self.scenario),
        };
        let initial = if law.starts_on_trajectory() { self.start() } else { self.scenario.initial.clone() };
        let system =
            System { joint_limits: &self.scenario.joint_limits, reach: self.scenario.reach(), ..System::alone(model) };
        let mut drive = |law: &mut dyn Control<f64>| {
            drive(&system, law, &self.scenario.approach.actuation, &initial, &self.timing, events, tick)
        };
        let task = TrackingTask { scenario, model, trajectory: self.trajectory(rates), timing: self.timing };
        law.track(&task, &mut |law| match own {
            Some((OwnLaws { origin, .. }, _)) => drive(&mut InertialFrame { law, origin, velocity: [0.0; 2] }),
            None => drive(law),
        })
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

    fn trajectory<'r>(&'r self, final_rates: &'r [f64]) -> AnyTrajectory<'r, f64> {
        let motion = PointToPoint {
            initial_angles: &self.scenario.initial.joint_angles,
            final_angles: &self.scenario.approach.final_joint_angles,
            duration: self.scenario.approach.trajectory_time(),
        };
        self.scenario.approach.trajectory.trajectory(motion, &self.scenario.initial.joint_rates, final_rates)
    }
}
