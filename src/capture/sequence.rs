//! The capture sequence of one case: impacts, and the motion between them.

use crate::capture::approach::ApproachTracking;
use crate::capture::assembly::{Assembly, Attachment};
use crate::capture::clearance::{ClearanceError, ClearanceTracker};
use crate::capture::contact_at_time::{ImpactContact, contact_at_time};
use crate::capture::contact_detection::{ContactDetection, signed_distance};
use crate::capture::contact_pair::ContactPair;
use crate::capture::heavy_target::HeavyTarget;
use crate::capture::impact::{ImpactSolution, solve_impact};
use crate::capture::post_capture::wheels;
use crate::capture::proximity::part_pair::SHORTEST;
use crate::capture::residual_motion::ResidualMotion;
use crate::capture::target_motion::TargetMotion;
use crate::capture::{CaptureResult, CaseResult, LaterImpact, ModelFactory, Observer, PATH_BOUND, StudyError};
use crate::contact::ContactLaw;
use crate::control::Control;
use crate::error::Error;
use crate::laws::{OwnLaws, PostCaptureLaw, PostCaptureTask};
use crate::owned::RobotState;
use crate::scenario::{Case, Detection, OnOverlap, PostImpact, Scenario, Target};
use crate::simulate::actuators::drive;
use crate::simulate::event::{EndTime, Events};
use crate::simulate::inertial_frame::InertialFrame;
use crate::simulate::system::{Body, System};
use crate::simulate::{Phase, PhaseError, Sample, Timing};

/// Largest number of impacts in one case.
const MAX_IMPACTS: usize = 1000;

/// Other end effectors at most this far from their targets touch them at the same impact, m.
const SIMULTANEOUS_DISTANCE: f64 = 1e-9;

/// One case of a scenario, and how it is simulated.
#[derive(Clone, Copy)]
pub(crate) struct CaptureSequence<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) case: &'a Case,
    /// Final joint rates of the trajectory, rad/s.
    pub(crate) rates: &'a [f64],
    pub(crate) make: ModelFactory<'a>,
    /// Time between samples, s.
    pub(crate) sample: f64,
    /// In place of the scenario's laws.
    pub(crate) own: Option<OwnLaws<'a>>,
}

impl<'a> CaptureSequence<'a> {
    /// Runs the case with contacts where the end effectors are when the approach ends. Until then the targets move with
    /// their twists, traced back from there.
    pub(crate) fn contact_at_time(
        self,
        approach: &Phase,
        observer: &mut dyn Observer,
    ) -> Result<CaseResult, StudyError> {
        let end = approach.end();
        let (targets, contacts) = contact_at_time(self.scenario, self.case, &end.end_effector_poses);
        let start = targets_after(&targets, -approach.duration);
        let mut clearance = ClearanceTracker::new(self.scenario, &[]);
        clearance
            .add_phase(&approach.path, 0.0, TargetMotion::Free(&start), &[])
            .map_err(|error| self.clearance_error(error, ("approach", approach)))?;
        if let Some(overlap) = self.stop(&clearance) {
            return self.stopped_approach(&start, overlap, observer);
        }
        let capture = match &self.scenario.post_impact {
            Some(after) => {
                let before = (&end.state, &approach.end_error);
                let first = FirstImpact { before, time: approach.duration, targets: &targets, contacts: &contacts };
                Some(self.after_impact(after, first, &mut clearance, observer)?)
            }
            None => None,
        };
        let stopped = self.stop(&clearance).map(|(_, time)| time);
        let name = self.case.name.clone();
        let clearance = clearance.result();
        Ok(CaseResult { name, approach: None, targets, closest: Vec::new(), clearance, stopped, capture })
    }

    /// Runs the case with contact detection: the targets move freely from the start, and the approach ends when an end
    /// effector reaches its target.
    pub(crate) fn contact_by_detection(self, observer: &mut dyn Observer) -> Result<CaseResult, StudyError> {
        let start = self.targets_at_start();
        let pairs = self.pairs(&[]);
        self.check_apart(&start, &pairs)?;
        let mut contact_detection = ContactDetection::new(self.scenario, TargetMotion::Free(&start), pairs.clone());
        let phase = self.track(&mut contact_detection, observer)?;
        let mut clearance = ClearanceTracker::new(self.scenario, &pairs);
        clearance
            .add_phase(&phase.path, 0.0, TargetMotion::Free(&start), &[])
            .map_err(|error| self.clearance_error(error, ("approach", &phase)))?;
        clearance.add_evaluations(contact_detection.evaluations());
        if let Some(overlap) = self.stop(&clearance) {
            return self.stopped_approach(&start, overlap, observer);
        }
        let targets = targets_after(&start, phase.duration);
        let capture = match (phase.event, &self.scenario.post_impact) {
            (Some((event, _)), Some(after)) => {
                let contacts = self.contacts_made(&pairs, event, &targets, &phase.end().end_effector_poses);
                let before = (&phase.end().state, &phase.end_error);
                let first = FirstImpact { before, time: phase.duration, targets: &targets, contacts: &contacts };
                Some(self.after_impact(after, first, &mut clearance, observer)?)
            }
            _ => None,
        };
        let mut closest = clearance.closest();
        if let Some(captured) = &capture {
            let touched = captured.later_impacts.iter().map(|later| &later.impact).chain([&captured.impact]);
            let touched: Vec<_> = touched.flat_map(|impact| &impact.contacts).map(|result| result.contact).collect();
            closest.retain(|pair| !touched.iter().any(|t| t.arm == pair.arm && t.target == pair.target));
        }
        let stopped = self.stop(&clearance).map(|(_, time)| time);
        let name = self.case.name.clone();
        let clearance = clearance.result();
        Ok(CaseResult { name, approach: Some(phase), targets, closest, clearance, stopped, capture })
    }

    /// The approach of this case, up to the first of the events.
    fn track(self, events: &mut dyn Events, observer: &mut dyn Observer) -> Result<Phase, StudyError> {
        let approach = ApproachTracking::new(self.scenario, self.sample).with(self.own);
        observer.begin(&format!("approach of {}", self.case.name), approach.steps());
        let model = (self.make)();
        approach.track(&*model, self.rates, events, &mut || observer.step()).map_err(StudyError::Approach)
    }

    /// The pair whose overlap ends the case, and when, s since the start of the approach.
    fn stop(self, clearance: &ClearanceTracker) -> Option<(usize, f64)> {
        let stops = self.scenario.clearance.on_overlap == OnOverlap::Stop;
        clearance.first_given_overlap().filter(|_| stops)
    }

    /// The result of a case that an overlap ends in the approach; the targets move freely from `start`.
    fn stopped_approach(
        self,
        start: &[Body],
        overlap: (usize, f64),
        observer: &mut dyn Observer,
    ) -> Result<CaseResult, StudyError> {
        let phase = self.track(&mut EndTime(overlap.1), observer)?;
        // a case that ends where it begins has no path: its distances are those of the shortest one
        let shortest = (overlap.1 <= 0.0).then(|| self.track(&mut EndTime(SHORTEST), observer)).transpose()?;
        let mut clearance = ClearanceTracker::new(self.scenario, &[]);
        clearance
            .add_phase(&shortest.as_ref().unwrap_or(&phase).path, 0.0, TargetMotion::Free(start), &[])
            .map_err(|error| self.clearance_error(error, ("approach", &phase)))?;
        clearance.end_at(overlap);
        Ok(CaseResult {
            name: self.case.name.clone(),
            targets: targets_after(start, phase.duration),
            approach: Some(phase),
            clearance: clearance.result(),
            stopped: Some(overlap.1),
            ..CaseResult::default()
        })
    }

    /// An impact, the motion after it, and with contact detection (`detected`) the impacts that interrupt this motion.
    fn after_impact(
        self,
        after: &'a PostImpact,
        FirstImpact { before: (before, error), time: first, targets, contacts }: FirstImpact<'_>,
        clearance: &mut ClearanceTracker,
        observer: &mut dyn Observer,
    ) -> Result<CaptureResult, StudyError> {
        observer.begin(&self.case.name, self.timing(after, after.duration).steps());
        let detected = self.scenario.contact.detection == Detection::Event;
        let free = Assembly::new((self.make)(), before, targets, &[]).map_err(|source| self.impact_error(source))?;
        let mut moving = SequenceState {
            sequence: self,
            after,
            first,
            state: before.clone(),
            error: error.clone(),
            targets: targets.to_vec(),
            attachments: Vec::new(),
            assembly: free,
            angles: before.joint_angles.clone(),
        };
        let impact = moving.apply_impact(contacts)?;
        let mut open = if detected { self.pairs(&moving.attachments) } else { Vec::new() };
        let (mut post_impact, mut target_paths) = moving.integrate_to_contact(&open, 0.0, clearance, observer)?;
        let mut later_impacts = Vec::new();
        while let Some((event, _)) = post_impact.event {
            let time = post_impact.duration;
            if later_impacts.len() == MAX_IMPACTS {
                let impacts = later_impacts.len() + 1;
                let target = self.scenario.targets[open[event].target].name.clone();
                return Err(StudyError::Chatter { case: self.case.name.clone(), impacts, target, time });
            }
            let contacts = self.contacts_made(&open, event, &moving.targets, &post_impact.end().end_effector_poses);
            later_impacts.push(LaterImpact { time, impact: moving.apply_impact(&contacts)? });
            if time >= after.duration {
                break;
            }
            open = self.pairs(&moving.attachments);
            let (next, path) = moving.integrate_to_contact(&open, time, clearance, observer)?;
            post_impact = post_impact.then(next);
            target_paths.extend(path);
        }
        let (law, _) = self.post_capture_law(after);
        let residual_motion = if law.acts() { Some(moving.residual_motion(law, &post_impact)?) } else { None };
        let penetration = clearance.penetration();
        let heavy_target = HeavyTarget::of(self.scenario, &moving.assembly, &moving.targets, after.integration);
        Ok(CaptureResult {
            impact,
            post_impact,
            targets: target_paths,
            later_impacts,
            penetration,
            heavy_target,
            residual_motion,
        })
    }

    /// The law of the motion after the impact, and one's own laws if it is one of these.
    fn post_capture_law(self, after: &'a PostImpact) -> (&'a dyn PostCaptureLaw, Option<OwnLaws<'a>>) {
        match self.own.and_then(|own| Some((own.laws.post_capture?, own))) {
            Some((law, own)) => (law, Some(own)),
            None => (&after.control, None),
        }
    }

    fn clearance_error(self, error: ClearanceError, (table, phase): (&'static str, &Phase)) -> StudyError {
        let case = self.case.name.clone();
        match error {
            ClearanceError::Exhausted(what) if phase.path_error > PATH_BOUND => {
                StudyError::RoughPath { case, table, time: what.time, path_error: phase.path_error }
            }
            ClearanceError::Exhausted(what) => StudyError::ClearanceExhausted { case, what },
            ClearanceError::Path(error) => StudyError::PathFile { case, reason: error.to_string() },
        }
    }

    fn impact_error(self, source: Error) -> StudyError {
        StudyError::Impact { case: self.case.name.clone(), source }
    }

    fn post_impact_error(self, time: f64, source: Error) -> StudyError {
        StudyError::PostImpact { case: self.case.name.clone(), source: PhaseError { time, source } }
    }

    fn timing(self, after: &PostImpact, duration: f64) -> Timing {
        let PostImpact { step, integration, ref actuation, .. } = *after;
        let whole = Timing { duration: after.duration, step, sample: self.sample, integration, kink: None };
        Timing { duration, ..whole.held(actuation.steps_per_sample) }
    }

    fn targets_at_start(self) -> Vec<Body> {
        let pairs = self.scenario.targets.iter().zip(&self.case.target_twists);
        let body = |(target, twist): (&Target, &[f64; 3])| {
            let [x, y] = target.position.expect("contact detection needs initial positions");
            Body { mass: target.mass, inertia: target.inertia, pose: [target.yaw, x, y], twist: *twist }
        };
        pairs.map(body).collect()
    }

    /// The planned contacts that have not been made yet.
    fn pairs(self, attachments: &[Attachment]) -> Vec<ContactPair> {
        let mut pairs = Vec::new();
        for (i, (target, kinds)) in self.scenario.targets.iter().zip(&self.case.kinds).enumerate() {
            for (k, (contact, kind)) in target.contacts.iter().zip(kinds).enumerate() {
                let held = attachments.iter().any(|attachment| attachment.arm == contact.arm);
                if kind.is_some() && !held {
                    pairs.push(ContactPair { target: i, contact: k, arm: contact.arm });
                }
            }
        }
        pairs
    }

    /// The contacts at one instant: the one detected, and those made at the same time.
    fn contacts_made(
        self,
        pairs: &[ContactPair],
        event: usize,
        targets: &[Body],
        end_effectors: &[[f64; 3]],
    ) -> Vec<ImpactContact> {
        let mut contacts = Vec::new();
        for (i, pair) in pairs.iter().enumerate() {
            let ContactPair { target, contact, arm } = *pair;
            let (body, end_effector) = (&targets[target], &end_effectors[arm]);
            let (distance, normal) = signed_distance(self.scenario, target, body, end_effector);
            let kind =
                self.case.kinds[target][contact].filter(|_| i == event || distance.abs() <= SIMULTANEOUS_DISTANCE);
            if let Some(kind) = kind {
                let law = ContactLaw::new(kind, || normal, self.case.restitutions[target]);
                let offset = [end_effector[1] - body.pose[1], end_effector[2] - body.pose[2]];
                contacts.push(ImpactContact { target, arm, law, offset, miss: distance.abs() });
            }
        }
        contacts
    }

    fn check_apart(self, targets: &[Body], pairs: &[ContactPair]) -> Result<(), StudyError> {
        let initial = &self.scenario.initial;
        let mut end_effectors = vec![[0.0; 3]; self.scenario.layout.arms.len()];
        (self.make)()
            .end_effector_poses(&initial.base_pose, &initial.joint_angles, &mut end_effectors)
            .map_err(|source| StudyError::Approach(PhaseError { time: 0.0, source }))?;
        for pair in pairs {
            let (body, end_effector) = (&targets[pair.target], &end_effectors[pair.arm]);
            let (distance, _) = signed_distance(self.scenario, pair.target, body, end_effector);
            if distance <= 0.0 {
                let arm = self.scenario.layout.arms[pair.arm].name.clone();
                let target = self.scenario.targets[pair.target].name.clone();
                return Err(StudyError::Inside { case: self.case.name.clone(), arm, target, depth: -distance });
            }
        }
        Ok(())
    }
}

/// The state before the first impact of a case.
struct FirstImpact<'a> {
    /// Also its estimated error.
    before: (&'a RobotState, &'a [Vec<f64>; 2]),
    /// Since the start of the approach, s.
    time: f64,
    targets: &'a [Body],
    contacts: &'a [ImpactContact],
}

/// Freely moving targets `time` s later.
fn targets_after(targets: &[Body], time: f64) -> Vec<Body> {
    targets.iter().map(|target| target.after(time)).collect()
}

/// Robot and targets between the impacts of a case.
struct SequenceState<'a> {
    sequence: CaptureSequence<'a>,
    after: &'a PostImpact,
    /// Time of the first impact, s.
    first: f64,
    state: RobotState,
    /// The estimated errors of its positions and rates.
    error: [Vec<f64>; 2],
    targets: Vec<Body>,
    attachments: Vec<Attachment>,
    assembly: Assembly,
    /// Joint angles at the first impact, rad.
    angles: Vec<f64>,
}

impl SequenceState<'_> {
    /// Solves the impact, sets the velocities after it, and adds lasting contacts to the assembly.
    fn apply_impact(&mut self, contacts: &[ImpactContact]) -> Result<ImpactSolution, StudyError> {
        let sequence = self.sequence;
        let impact = solve_impact(&self.assembly, &self.state, &self.targets, contacts)
            .map_err(|source| sequence.impact_error(source))?;
        self.state.base_twist = impact.exact.base_twist_after;
        self.state.joint_rates.clone_from(&impact.exact.joint_rates_after);
        for (target, twist) in self.targets.iter_mut().zip(&impact.target_twists) {
            target.twist = *twist;
        }
        self.attachments.extend(holds(contacts));
        self.assembly = Assembly::new((sequence.make)(), &self.state, &self.targets, &self.attachments)
            .map_err(|source| sequence.impact_error(source))?;
        Ok(impact)
    }

    /// Simulates from `time` s after the first impact to the next contact of the pairs or the end; returns the phase
    /// and the targets at its samples.
    fn integrate_to_contact(
        &mut self,
        pairs: &[ContactPair],
        time: f64,
        clearance: &mut ClearanceTracker,
        observer: &mut dyn Observer,
    ) -> Result<(Phase, Vec<Vec<Body>>), StudyError> {
        let sequence = self.sequence;
        let Self { after, first, state, error, targets, attachments, assembly, .. } = self;
        let motion = TargetMotion::Assembled(assembly, targets);
        let mut detection = ContactDetection::new(sequence.scenario, motion, pairs.to_vec());
        let wheels = wheels(&sequence.scenario.layout, attachments);
        let timing = sequence.timing(after, after.duration - time);
        let Scenario { joint_limits, .. } = sequence.scenario;
        let (reach, start_error) = (sequence.scenario.reach(), [&error[0][..], &error[1]]);
        let system = System { joint_limits, reach, start_error, ..assembly.system() };
        let (law, own) = sequence.post_capture_law(after);
        let task = PostCaptureTask {
            scenario: own.map_or(sequence.scenario, |own| own.scenario),
            model: system.model,
            wheels: &wheels,
            angles: &self.angles,
            since_impact: time,
            timing,
        };
        let mut simulate = |events: &mut dyn Events| {
            let mut drive = |law: &mut dyn Control<f64>| {
                drive(&system, law, &after.actuation, state, &timing, events, &mut || observer.step())
            };
            let phase = law.control(&task, &mut |law| match own {
                Some(OwnLaws { origin, .. }) => drive(&mut InertialFrame { law, origin, velocity: [0.0; 2] }),
                None => drive(law),
            });
            phase.map_err(|stopped| sequence.post_impact_error(time + stopped.time, stopped.source))
        };
        let mut phase = simulate(&mut detection)?;
        clearance.add_evaluations(detection.evaluations());
        let begin = *first + time;
        let before = clearance.clone();
        clearance
            .add_phase(&phase.path, begin, motion, attachments)
            .map_err(|error| sequence.clearance_error(error, ("post_impact", &phase)))?;
        if let Some(overlap) = sequence.stop(clearance) {
            phase = Phase { event: None, ..simulate(&mut EndTime(overlap.1 - begin))? };
            *clearance = before;
            clearance
                .add_phase(&phase.path, begin, motion, attachments)
                .map_err(|error| sequence.clearance_error(error, ("post_impact", &phase)))?;
            clearance.end_at(overlap);
        }
        let at =
            |now: &Sample| assembly.targets(targets, &now.end_effector_poses, &now.end_effector_twists, &now.bodies);
        let path: Vec<Vec<Body>> = phase.samples.iter().map(at).collect();
        let phase = phase.with_targets(&at);
        state.clone_from(&phase.end().state);
        error.clone_from(&phase.end_error);
        targets.clone_from(path.last().expect("a phase has samples"));
        Ok((phase, path))
    }

    /// The residual motion at the end of a phase.
    fn residual_motion(&self, law: &dyn PostCaptureLaw, phase: &Phase) -> Result<ResidualMotion, StudyError> {
        let wheels = wheels(&self.sequence.scenario.layout, &self.attachments);
        let beside = self.assembly.pinned(&phase.end().bodies);
        ResidualMotion::of(&*self.assembly.model, &beside, law.name(), &self.state, &wheels)
            .map_err(|source| self.sequence.post_impact_error(phase.duration, source))
    }
}

/// The contacts that last.
fn holds(contacts: &[ImpactContact]) -> impl Iterator<Item = Attachment> {
    let held = contacts.iter().filter(|contact| contact.law.kind().holds());
    held.map(|contact| Attachment { target: contact.target, arm: contact.arm, kind: contact.law.kind() })
}
