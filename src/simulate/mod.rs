//! Simulation of one phase of motion: integrates eq. (1), or (2) with (17), under a control law up to the phase's end
//! or an event, and checks the conservation laws at every step.
//!
//! # Example
//! ```
//! use planar_capture::control::ZeroTorque;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::{Timing, event::NoEvents, simulate, system::System};
//!
//! let robot = Model::<f64>::default();
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0, 0.1, 0.0], joint_rates };
//! let timing = Timing { duration: 10.0, step: 0.1, sample: 1.0, ..Timing::default() };
//! let phase = simulate(&System::alone(&robot), &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || ())?;
//! // 10 s at 0.1 m/s, with a sample at the start and after every second
//! assert!((phase.end().state.base_pose[1] - 1.0).abs() < 1e-9);
//! assert_eq!(phase.samples.len(), 11);
//! assert!(phase.drift.momentum_drift < 1e-12);
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

pub mod actuators;
pub(crate) mod bodies;
mod body_tree;
pub mod conservation;
mod continued_motion;
mod equation;
pub mod event;
mod event_location;
pub(crate) mod inertial_frame;
mod knots;
pub mod limits;
mod moving_frame;
pub mod path;
mod recorder;
pub(crate) mod root;
mod sample_file;
pub mod sample_list;
pub mod stepper;
pub mod stored_samples;
mod subdivision;
pub mod system;
pub(crate) mod translation;

use crate::control::Control;
use crate::dynamics::Momentum;
use crate::error::Error;
use crate::owned::RobotState;
use crate::scalar::{Real, Scalar};
use crate::simulate::conservation::ConservationErrors;
use crate::simulate::event::Events;
use crate::simulate::event_location::EventLocator;
use crate::simulate::limits::LimitViolations;
use crate::simulate::path::Path;
use crate::simulate::recorder::Recorder;
use crate::simulate::stepper::Stepper;
use crate::simulate::stepper::{Integration, Properties};
use crate::simulate::stored_samples::StoredSamples;
use crate::simulate::subdivision::Subdivision;
use crate::simulate::system::{Body, System};
use crate::state::ActuatorWork;

/// A phase of fewer steps has its fastest motion between them: the audit looks there for its scales.
const FEW_STEPS: u64 = 64;

/// State, torques, end effectors, momentum and bodies at one instant.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Sample {
    /// Since the start of the phase, s.
    pub time: f64,
    /// Of the robot.
    pub state: RobotState,
    /// N m.
    pub joint_torques: Vec<f64>,
    /// [yaw, x, y] of each end effector; rad, m.
    pub end_effector_poses: Vec<[f64; 3]>,
    /// [ω, vx, vy] of each end effector; rad/s, m/s.
    pub end_effector_twists: Vec<[f64; 3]>,
    /// Of the robot and the bodies beside it together.
    pub momentum: Momentum<f64>,
    /// Since the start of the phase.
    pub work: ActuatorWork<f64>,
    /// On the base, N m; `None` where there is no such actuator.
    pub base_torque: Option<f64>,
    /// The bodies beside the robot, in the system's order.
    pub bodies: Vec<Body>,
}

/// Largest distance of a time from a whole number of steps, in steps: rounding of decimal fractions.
pub(crate) const ROUNDING: f64 = 1e-6;

/// Duration, steps and samples of one phase.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// s.
    pub duration: f64,
    /// Longest step, s; the phase is divided into equal steps, but where torques are held for steps: these are of this length,
    /// and the last one of what is left. An adaptive integrator has other steps: for it this is
    /// the interval of audits, events and samples.
    pub step: f64,
    /// Time between samples, s, at least one step; the last instant is always sampled.
    pub sample: f64,
    /// By which integrator, in which coordinates.
    pub integration: Integration,
    /// A time at which derivatives of the torques jump, s: the end of a trajectory that is held from then on. A step across it
    /// would lose its order, and is divided there; adaptive steps need not be, nor those under torques that are held.
    pub kink: Option<f64>,
}

impl Timing {
    /// Number of steps.
    #[must_use]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 1e8 steps are read")]
    pub fn steps(&self) -> u64 {
        (self.duration / self.step - 1e-9).ceil().max(1.0) as u64
    }

    /// When a step begins, s. A law that holds its torques does so for the same time throughout: where its steps do not
    /// fill the phase, the last one is shorter.
    #[allow(clippy::cast_precision_loss, reason = "at most 1e8 steps are read")]
    fn time_of(&self, step: u64, is_held: bool) -> f64 {
        let steps = self.steps() as f64;
        let is_filled = (steps * self.step - self.duration).abs() <= ROUNDING * self.step;
        match step as f64 {
            step if is_filled || !is_held => self.duration * (step / steps),
            step => Scalar::minimum(step * self.step, self.duration),
        }
    }

    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "at most 1e8 steps are read"
    )]
    fn stride(&self) -> u64 {
        let step = self.duration / self.steps() as f64;
        (self.sample / step).round().max(1.0) as u64
    }
}

/// The result of one phase.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Phase {
    /// s; up to the event where one ended the phase.
    pub duration: f64,
    /// Index and time (s) of the event that ended it; `None` where the time was over.
    pub event: Option<(usize, f64)>,
    /// The first instant, one per sampling interval, and the last; at least one. None is within 2e-13 of its time, or s below one
    /// second, before an event that ends the phase, but for the first. Of a long phase every second, fourth …
    /// of these: [`Phase::all_samples`] has all.
    pub samples: Vec<Sample>,
    /// Those that have more samples than these, in order.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub stored: Vec<StoredSamples>,
    /// The largest of all steps.
    pub drift: ConservationErrors,
    /// The largest error of a yaw, joint angle (rad) or coordinate (m) by the integration of this phase and by the error at
    /// its start, estimated by steps of another length.
    pub path_error: f64,
    /// The estimated errors of the robot's positions (rad, m) and rates at the end.
    pub end_error: [Vec<f64>; 2],
    /// Of the actuators.
    pub saturation: Saturation,
    /// Largest error of a constraint, of a yaw (rad) or a coordinate (m), and of its rate.
    pub constraint_errors: [f64; 2],
    /// Smallest ratio of the smallest to the largest singular value of the generalized Jacobian at the ends of steps, for a
    /// law that inverts it.
    pub singularity_margin: Option<f64>,
    /// Joints beyond their limits; `None` where there are no limits.
    pub limit_violations: Option<LimitViolations>,
    /// Positions and rates of the integrated vector; empty for a motion with impacts and in the results of a study.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub path: Path,
}

/// How long actuators were at their limits, by their torques at the start of each step.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Saturation {
    /// One per joint, s; empty where the law has no limits.
    pub joints: Vec<f64>,
    /// s; 0 without a base torque.
    pub base: f64,
}

impl Phase {
    /// The last sample.
    ///
    /// # Panics
    /// Where there are no samples, which [`simulate()`] never returns.
    #[must_use]
    pub fn end(&self) -> &Sample {
        self.samples.last().expect("a phase has samples")
    }

    /// This phase and the `next` one from its end on as one phase without a path, with times and work from the start of
    /// this one.
    #[must_use]
    pub fn then(mut self, next: Self) -> Self {
        let work = self.end().work;
        let (count, time) = (self.samples.len(), self.duration);
        self.stored.extend(next.stored.into_iter().map(|stored| stored.after(count, time, &work)));
        self.samples.extend(next.samples.into_iter().map(|sample| Sample {
            time: self.duration + sample.time,
            work: work.plus(&sample.work),
            ..sample
        }));
        let joints = self.saturation.joints.iter_mut().zip(next.saturation.joints);
        joints.for_each(|(sum, part)| *sum += part);
        self.saturation.base += next.saturation.base;
        Self {
            event: next.event.map(|(event, time)| (event, self.duration + time)),
            duration: self.duration + next.duration,
            drift: self.drift.worse(&next.drift),
            path_error: Real::maximum(self.path_error, next.path_error),
            end_error: next.end_error,
            constraint_errors: std::array::from_fn(|i| {
                Real::maximum(self.constraint_errors[i], next.constraint_errors[i])
            }),
            singularity_margin: match [self.singularity_margin, next.singularity_margin] {
                [Some(before), Some(after)] => Some(Scalar::minimum(before, after)),
                [before, after] => before.or(after),
            },
            limit_violations: match (self.limit_violations, next.limit_violations) {
                (Some(before), Some(after)) => Some(before.then(after, self.duration)),
                (before, after) => before.or(after),
            },
            path: Path::default(),
            ..self
        }
    }
}

/// Time and reason of a phase that stopped.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("at t = {time:?} s: {source}{}", self.hint())]
pub struct PhaseError {
    /// s, since the start of the phase.
    pub time: f64,
    /// The reason.
    pub source: Error,
}

impl PhaseError {
    /// Whether it was refused, rather than broken down.
    #[must_use]
    pub fn is_misuse(&self) -> bool {
        matches!(self.source, Error::UnsupportedBodies { .. } | Error::ContinuousMemory)
    }

    fn hint(&self) -> &'static str {
        match self.source {
            Error::UnsupportedBodies { .. } => ", expected `coordinates = \"full\"`",
            Error::ContinuousMemory => "",
            Error::Tolerance { .. } => " (a larger one may help)",
            Error::Steps { .. } => " (smaller gains of a control, a shorter step, or a fixed integrator, may help)",
            _ => " (a shorter step, or smaller gains of a control, may help)",
        }
    }
}

/// Simulates one phase up to its duration or the first event; `tick` is called once per step.
///
/// # Errors
/// Time and reason of a singular matrix or a number that is not finite in model or law, and of an adaptive integrator
/// that does not reach its tolerance.
pub fn simulate(
    system: &System<'_>,
    control: &mut dyn Control<f64>,
    initial: &RobotState,
    timing: &Timing,
    events: &mut dyn Events,
    tick: &mut dyn FnMut(),
) -> Result<Phase, PhaseError> {
    let at = |time| move |source| PhaseError { time, source };
    let mut x = system.vector(&initial.view()).map_err(at(0.0))?;
    let mut stepper = Stepper::new(system, control, timing, &x).map_err(at(0.0))?;
    let ends_at_start = events.end_at_start();
    let mut locator = EventLocator::new(system, events);
    let (steps, stride) = (timing.steps(), timing.stride());
    let samples = usize::try_from(steps / stride).unwrap_or(usize::MAX).saturating_add(2);
    let mut recorder = Recorder::new(system, stepper.moving(&x), samples).map_err(at(0.0))?;
    let is_held = stepper.control().held_steps().is_some();
    let time_of = |step: u64| timing.time_of(step, is_held);
    let Properties { path_divisions: divisions, is_adaptive, .. } = timing.integration.integrator.properties();
    let mut subdivision = Subdivision::new(system, divisions, (0.0, &x));
    recorder.record_path(0.0, &x).map_err(at(0.0))?;
    if ends_at_start {
        stepper.begin_step(0.0, &x).map_err(at(0.0))?;
        recorder.audit(0.0, stepper.moving(&x)).map_err(at(0.0))?;
        recorder.record(stepper.control(), 0.0, &x, true).map_err(at(0.0))?;
        return Ok(recorder.end(0.0, Some((0, 0.0)), stepper.path_errors(0.0)));
    }
    let mut next = time_of(0);
    for i in 0..steps {
        let span @ [time, end] = [next, time_of(i + 1)];
        next = end;
        stepper.begin_step(time, &x).map_err(at(time))?;
        recorder.audit(time, stepper.moving(&x)).map_err(at(time))?;
        recorder.record(stepper.control(), time, &x, i % stride == 0).map_err(at(time))?;
        let mut from = time;
        while from < end {
            locator.begin([from, end], &x, &mut stepper).map_err(at(from))?;
            let part @ [_, to] = [from, stepper.advance(span, from, &mut x).map_err(at(from))?];
            let fourth_derivative = stepper.fourth_derivative();
            let mut within = |t: f64, into: &mut Vec<f64>| stepper.within([from, t], into);
            subdivision.divide(part, &x, fourth_derivative, &mut within).map_err(at(from))?;
            let event = locator.find(part, &x, &subdivision, &mut stepper).map_err(at(from))?;
            let until = event.map_or(to, |(_, when)| when);
            for (knot, x) in subdivision.ends().filter(|(knot, _)| *knot < until) {
                recorder.record_path(knot, x).map_err(at(knot))?;
                if is_adaptive {
                    recorder.follow(stepper.control(), knot, x).map_err(at(knot))?;
                    if steps < FEW_STEPS {
                        recorder.scale(&stepper.moved(knot, x).map_err(at(knot))?).map_err(at(knot))?;
                    }
                }
            }
            if let Some((_, when)) = event {
                stepper.end_at([from, when], &mut x).map_err(at(when))?;
            }
            recorder.record_path(until, &x).map_err(at(until))?;
            if let Some((_, when)) = event {
                recorder.add_saturation(when);
                recorder.audit(when, stepper.moving(&x)).map_err(at(when))?;
                recorder.record_event(stepper.control(), when, &x).map_err(at(when))?;
                return Ok(recorder.end(when, event, stepper.path_errors(when)));
            }
            from = to;
            if from < end {
                recorder.follow(stepper.control(), from, &x).map_err(at(from))?;
            }
        }
        recorder.add_saturation(end);
        tick();
    }
    recorder.audit(timing.duration, stepper.moving(&x)).map_err(at(timing.duration))?;
    recorder.record(stepper.control(), timing.duration, &x, true).map_err(at(timing.duration))?;
    Ok(recorder.end(timing.duration, None, stepper.path_errors(timing.duration)))
}

#[cfg(test)]
mod tests;
