//! Records a phase while it runs: samples, conservation errors, saturation, limit violations.

use crate::control::Control;
use crate::error::Error;
use crate::owned::RobotState;
use crate::scalar::{Real, Scalar};
use crate::simulate::conservation::{AccumulatedInput, ConservationAudit};
use crate::simulate::event_location::time_tolerance;
use crate::simulate::limits::LimitViolations;
use crate::simulate::path::{PathInterval, PathRecorder, path_state};
use crate::simulate::sample_list::SampleList;
use crate::simulate::stepper::PathErrors;
use crate::simulate::stored_samples::StoredSamples;
use crate::simulate::system::System;
use crate::simulate::{Phase, Sample, Saturation};
use crate::state::{ActuatorWork, State};

/// The record so far.
pub(crate) struct Recorder<'a> {
    system: &'a System<'a>,
    audit: ConservationAudit<'a>,
    torques: Vec<f64>,
    end_effector_poses: Vec<[f64; 3]>,
    end_effector_twists: Vec<[f64; 3]>,
    samples: SampleList,
    saturation: Saturation,
    /// Which joints are saturated, since when, s.
    saturated: Vec<bool>,
    base_saturated: bool,
    since: f64,
    constraint_errors: [f64; 2],
    /// The smallest of the states that were accepted.
    singularity_margin: Option<f64>,
    limit_violations: LimitViolations,
    /// Time and integrated vector of the last state of the path; where there are no limits, it has none.
    last: Option<(f64, Vec<f64>)>,
    path: PathRecorder,
}

impl<'a> Recorder<'a> {
    /// For a phase of so many samples that starts at `x`, in the frame that is integrated in.
    pub(crate) fn new(system: &'a System<'a>, x: &[f64], samples: usize) -> Result<Self, Error> {
        let start = State::from_vector(x, system.model.joints())?;
        Ok(Self {
            system,
            audit: ConservationAudit::new(system.model, &start, &system.bodies_at(x)?)?,
            torques: vec![0.0; system.model.joints()],
            end_effector_poses: vec![[0.0; 3]; system.model.arms()],
            end_effector_twists: vec![[0.0; 3]; system.model.arms()],
            samples: SampleList::expecting(samples),
            saturation: Saturation::default(),
            saturated: Vec::new(),
            base_saturated: false,
            since: 0.0,
            constraint_errors: [0.0; 2],
            singularity_margin: None,
            limit_violations: LimitViolations::default(),
            last: None,
            path: PathRecorder::new(3 + system.model.joints() + 3 * system.bodies.len(), samples),
        })
    }

    /// Audits an instant, in the frame that is integrated in.
    pub(crate) fn audit(&mut self, time: f64, x: &[f64]) -> Result<(), Error> {
        let work = ActuatorWork::from_vector(x)?;
        let input = AccumulatedInput { time, work: work.total(), impulse: [work.base_impulse, 0.0, 0.0] };
        let errors = self.system.constraint_errors(x)?;
        self.constraint_errors = std::array::from_fn(|i| Real::maximum(errors[i], self.constraint_errors[i]));
        self.audit.record_vector(x, &input)
    }

    /// Notes which actuators the law's torques saturate at an instant, and keeps a sample if `sampled`.
    pub(crate) fn record(
        &mut self,
        control: &mut dyn Control<f64>,
        time: f64,
        x: &[f64],
        sampled: bool,
    ) -> Result<(), Error> {
        let (model, limits) = (self.system.model, self.system.joint_limits);
        let is_followed = is_followed(control);
        if !sampled && !is_followed && limits.is_empty() {
            return Ok(());
        }
        let state = State::from_vector(x, model.joints())?;
        self.limit_violations.record(limits, time, &state);
        if sampled || is_followed {
            self.law_at(control, time, &state)?;
        }
        if !sampled {
            return Ok(());
        }
        let bodies = self.system.bodies_at(x)?;
        let momentum = self.audit.momentum(&state, &bodies)?;
        model.end_effector_poses(&state.base_pose, state.joint_angles, &mut self.end_effector_poses)?;
        model.end_effector_twists(&state, &mut self.end_effector_twists)?;
        self.samples.push(Sample {
            time,
            state: RobotState::from_view(&state),
            joint_torques: self.torques.clone(),
            end_effector_poses: self.end_effector_poses.clone(),
            end_effector_twists: self.end_effector_twists.clone(),
            momentum,
            work: ActuatorWork::from_vector(x)?,
            base_torque: control.base_torque().map(|base| base.torque),
            bodies,
        });
        Ok(())
    }

    /// Samples the instant of an event. A sample that is earlier than this by less than twice the accuracy of event
    /// times is the same instant, and is not kept beside it, but for the first of the phase, which may be after an impact.
    pub(crate) fn record_event(&mut self, control: &mut dyn Control<f64>, time: f64, x: &[f64]) -> Result<(), Error> {
        self.samples.discard_from(time - 2.0 * time_tolerance(time));
        self.record(control, time, x, true)
    }

    /// Adds a state to the path, and looks for joints beyond their limits since the one before it.
    pub(crate) fn record_path(&mut self, time: f64, x: &[f64]) -> Result<(), Error> {
        self.path.record(time, path_state(x));
        let limits = self.system.joint_limits;
        if limits.is_empty() {
            return Ok(());
        }
        let Some((before, start)) = &mut self.last else {
            self.last = Some((time, x.to_vec()));
            return Ok(());
        };
        let interval = PathInterval::between([*before, time], start, x)?;
        self.limit_violations.record_between(limits, &interval);
        *before = time;
        start.copy_from_slice(x);
        Ok(())
    }

    /// The law determines saturation and the singularity margin together with its torques.
    fn law_at(&mut self, control: &mut dyn Control<f64>, time: f64, state: &State<'_, f64>) -> Result<(), Error> {
        control.joint_torques(time, self.system.model, state, &mut self.torques)?;
        self.saturated.clear();
        self.saturated.extend_from_slice(control.saturated());
        self.base_saturated = control.base_torque().is_some_and(|base| base.saturated);
        self.since = time;
        if let Some(margin) = control.singularity_margin() {
            let least = self.singularity_margin.map_or(margin, |least| Scalar::minimum(least, margin));
            self.singularity_margin = Some(least);
        }
        Ok(())
    }

    /// Looks within a step, whose length may be long beside the motion, which actuators are saturated, and how near the pose
    /// is to a singular one.
    pub(crate) fn follow(&mut self, control: &mut dyn Control<f64>, time: f64, x: &[f64]) -> Result<(), Error> {
        if !is_followed(control) {
            return Ok(());
        }
        self.add_saturation(time);
        self.law_at(control, time, &State::from_vector(x, self.system.model.joints())?)
    }

    /// Adds the time until then, s, to the saturation of the actuators that are saturated.
    pub(crate) fn add_saturation(&mut self, until: f64) {
        let step = until - self.since;
        self.saturation.joints.resize(self.saturated.len(), 0.0);
        for (time, saturated) in self.saturation.joints.iter_mut().zip(&self.saturated) {
            *time += if *saturated { step } else { 0.0 };
        }
        self.saturation.base += if self.base_saturated { step } else { 0.0 };
    }

    /// Takes a state within a step into account in the scales of the audit, in the frame that is integrated in.
    pub(crate) fn scale(&mut self, x: &[f64]) -> Result<(), Error> {
        let state = State::from_vector(x, self.system.model.joints())?;
        self.audit.scale(&state, &self.system.bodies_at(x)?)
    }

    /// The phase.
    pub(crate) fn end(self, duration: f64, event: Option<(usize, f64)>, (path_error, end_error): PathErrors) -> Phase {
        let Self {
            system,
            samples,
            audit,
            saturation,
            constraint_errors,
            singularity_margin,
            limit_violations,
            path,
            ..
        } = self;
        let (samples, file) = samples.end();
        let stored = file.map(|file| StoredSamples::new(file, samples.len()));
        Phase {
            duration,
            event,
            samples,
            stored: stored.into_iter().collect(),
            drift: audit.drift(),
            path_error,
            end_error,
            saturation,
            constraint_errors,
            singularity_margin,
            limit_violations: (!system.joint_limits.is_empty()).then_some(limit_violations),
            path: path.end(),
        }
    }
}

/// Whether a law has limits of torques, or inverts a matrix.
fn is_followed(control: &dyn Control<f64>) -> bool {
    !control.saturated().is_empty() || control.base_torque().is_some() || control.singularity_margin().is_some()
}
