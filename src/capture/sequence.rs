//! The course of one case: impacts, and the motion between them.

use crate::capture::approach::Approach;
use crate::capture::assembly::{Assembly, Attachment};
use crate::capture::contact_at_time::{ImpactContact, contact_at_time, contact_law};
use crate::capture::contact_detection::{ContactDetection, ContactPair, TargetMotion, signed_distance};
use crate::capture::impact::{ImpactSolution, solve_impact};
use crate::capture::post_capture::{PostCaptureLaw, run_post_capture, wheels};
use crate::capture::residual_motion::ResidualMotion;
use crate::capture::{CaptureResult, CaseResult, ClosestApproach, FurtherImpact, ModelFactory, Observer, StudyError};
use crate::error::Error;
use crate::owned::RobotState;
use crate::scenario::{Case, PostCaptureControl, PostImpact, Scenario, Target};
use crate::simulate::system::{Body, System};
use crate::simulate::{Phase, PhaseError, Sample, Timing};

/// The most impacts of one case.
const MOST_IMPACTS: usize = 1000;

/// End effectors no farther than this from their targets touch them when another does, m.
const TOGETHER: f64 = 1e-9;

/// What a case is run from.
#[derive(Clone, Copy)]
pub(crate) struct CaptureSequence<'a> {
    pub(crate) scenario: &'a Scenario,
    pub(crate) case: &'a Case,
    pub(crate) after: &'a PostImpact,
    pub(crate) make: ModelFactory<'a>,
    /// Time between samples, s.
    pub(crate) sample: f64,
}

impl CaptureSequence<'_> {
    /// Contacts are where the end effectors are when the approach ends.
    pub(crate) fn contact_at_time(
        self,
        end: &RobotState,
        end_effectors: &[[f64; 3]],
        observer: &mut dyn Observer,
    ) -> Result<CaseResult, StudyError> {
        let (targets, touching) = contact_at_time(self.scenario, self.case, end_effectors);
        let capture = self.after_impact(end, &targets, &touching, false, observer)?;
        let name = self.case.name.clone();
        Ok(CaseResult { name, approach: None, targets, closest: Vec::new(), capture: Some(capture) })
    }

    /// The targets fly freely from the start on, and the approach ends where an end effector reaches its target;
    /// `rates` are the approach's end rates, rad/s.
    pub(crate) fn contact_by_detection(
        self,
        rates: &[f64],
        observer: &mut dyn Observer,
    ) -> Result<CaseResult, StudyError> {
        let start = self.targets_at_start();
        let pairs = self.pairs(&[]);
        self.check_apart(&start, &pairs)?;
        let approach = Approach::new(self.scenario, self.sample);
        observer.begin(&format!("approach of {}", self.case.name), approach.steps());
        let mut contact_detection = ContactDetection::new(self.scenario, TargetMotion::Free(&start), pairs.clone());
        let model = (self.make)();
        let phase = approach
            .track_until(&*model, rates, &mut contact_detection, &mut || observer.step())
            .map_err(StudyError::Approach)?;
        let flown = |time: f64| start.iter().map(|target| target.after(time)).collect::<Vec<_>>();
        let targets = flown(phase.duration);
        let mut closest = self.closest(&pairs, &phase, 0.0, |i| flown(phase.samples.get(i).map_or(0.0, |s| s.time)));
        let capture = match (phase.event, phase.end()) {
            (Some((event, _)), Some(end)) => {
                let touching = self.touching(&pairs, event, &targets, &end.end_effector_poses);
                Some(self.after_impact(&end.state, &targets, &touching, true, observer)?)
            }
            _ => None,
        };
        if let Some(captured) = &capture {
            let later = self.closest(&pairs, &captured.post_impact, phase.duration, |i| {
                captured.targets.get(i).cloned().unwrap_or_default()
            });
            for (nearest, later) in closest.iter_mut().zip(later) {
                *nearest = if later.distance < nearest.distance { later } else { *nearest };
            }
            let touched = captured.further.iter().map(|further| &further.impact).chain([&captured.impact]);
            let touched: Vec<_> = touched.flat_map(|impact| &impact.contacts).map(|contact| contact.touching).collect();
            closest.retain(|pair| !touched.iter().any(|t| t.arm == pair.arm && t.target == pair.target));
        }
        let name = self.case.name.clone();
        Ok(CaseResult { name, approach: Some(phase), targets, closest, capture })
    }

    /// An impact, the motion after it, and the impacts that interrupt that: of end effectors and targets that
    /// `detected` asks for.
    fn after_impact(
        self,
        before: &RobotState,
        targets: &[Body],
        touching: &[ImpactContact],
        detected: bool,
        observer: &mut dyn Observer,
    ) -> Result<CaptureResult, StudyError> {
        observer.begin(&self.case.name, self.timing(self.after.duration).steps());
        let free = Assembly::new((self.make)(), before, targets, &[]).map_err(|source| self.unsolved(source))?;
        let mut moving = SequenceState {
            course: self,
            state: before.clone(),
            targets: targets.to_vec(),
            attachments: Vec::new(),
            assembly: free,
            angles: before.joint_angles.clone(),
        };
        let impact = moving.apply_impact(touching)?;
        let mut open = if detected { self.pairs(&moving.attachments) } else { Vec::new() };
        let (mut post_impact, mut flown) = moving.integrate_to_contact(&open, 0.0, observer)?;
        let mut further = Vec::new();
        let mut penetration = self.penetration(&open, &post_impact, &flown);
        while let (Some((event, _)), Some(end)) = (post_impact.event, post_impact.end()) {
            let time = post_impact.duration;
            if further.len() == MOST_IMPACTS {
                return Err(StudyError::Chatter { case: self.case.name.clone(), impacts: further.len() + 1, time });
            }
            let touching = self.touching(&open, event, &moving.targets, &end.end_effector_poses);
            further.push(FurtherImpact { time, impact: moving.apply_impact(&touching)? });
            if time >= self.after.duration {
                break;
            }
            open = self.pairs(&moving.attachments);
            let (next, along) = moving.integrate_to_contact(&open, time, observer)?;
            penetration = penetration.max(self.penetration(&open, &next, &along));
            post_impact = post_impact.then(next);
            flown.extend(along);
        }
        let remainder = match &self.after.control {
            PostCaptureControl::None => None,
            control => Some(moving.remainder(control, &post_impact)?),
        };
        Ok(CaptureResult { impact, post_impact, targets: flown, further, penetration, remainder })
    }

    fn unsolved(self, source: Error) -> StudyError {
        StudyError::Impact { case: self.case.name.clone(), source }
    }

    fn stopped(self, time: f64, source: Error) -> StudyError {
        StudyError::PostImpact { case: self.case.name.clone(), source: PhaseError { time, source } }
    }

    /// By how much an end effector is inside its target at most, in the samples of a phase, m.
    fn penetration(self, pairs: &[ContactPair], phase: &Phase, targets: &[Vec<Body>]) -> f64 {
        let closest = self.closest(pairs, phase, 0.0, |i| targets.get(i).cloned().unwrap_or_default());
        closest.iter().fold(0.0, |most, pair| most.max(-pair.distance))
    }

    fn timing(self, duration: f64) -> Timing {
        Timing { duration, step: self.after.step, sample: self.sample, integration: self.after.integration }
    }

    fn targets_at_start(self) -> Vec<Body> {
        let pairs = self.scenario.targets.iter().zip(&self.case.target_twists);
        let body = |(target, twist): (&Target, &[f64; 3])| {
            let [x, y] = target.position.unwrap_or_default();
            Body { mass: target.mass, inertia: target.inertia, pose: [target.yaw, x, y], twist: *twist }
        };
        pairs.map(body).collect()
    }

    /// The end effectors and targets that may meet: those that are to, and do not hold each other yet.
    fn pairs(self, attachments: &[Attachment]) -> Vec<ContactPair> {
        let mut pairs = Vec::new();
        for (i, (target, kinds)) in self.scenario.targets.iter().zip(&self.case.kinds).enumerate() {
            for (k, (touch, kind)) in target.contacts.iter().zip(kinds).enumerate() {
                let held = attachments.iter().any(|grip| grip.arm == touch.arm);
                if kind.is_some() && !held {
                    pairs.push(ContactPair { target: i, touch: k, arm: touch.arm });
                }
            }
        }
        pairs
    }

    /// The contacts of an instant: the one that was detected, and those that come with it.
    fn touching(
        self,
        pairs: &[ContactPair],
        event: usize,
        targets: &[Body],
        end_effectors: &[[f64; 3]],
    ) -> Vec<ImpactContact> {
        let mut touching = Vec::new();
        for (i, pair) in pairs.iter().enumerate() {
            let (Some(body), Some(end_effector)) = (targets.get(pair.target), end_effectors.get(pair.arm)) else {
                continue;
            };
            let (distance, normal) = signed_distance(self.scenario, pair.target, body, end_effector);
            let kind = self.case.kinds.get(pair.target).and_then(|kinds| kinds.get(pair.touch));
            let restitution = self.case.restitutions.get(pair.target).copied();
            let law = kind.and_then(|kind| contact_law(*kind, || normal, restitution));
            if let (true, Some(law)) = (i == event || distance.abs() <= TOGETHER, law) {
                let offset = [end_effector[1] - body.pose[1], end_effector[2] - body.pose[2]];
                touching.push(ImpactContact { target: pair.target, arm: pair.arm, law, offset, miss: distance.abs() });
            }
        }
        touching
    }

    fn check_apart(self, targets: &[Body], pairs: &[ContactPair]) -> Result<(), StudyError> {
        let initial = &self.scenario.initial;
        let mut end_effectors = vec![[0.0; 3]; self.scenario.layout.arms.len()];
        (self.make)()
            .end_effector_poses(&initial.base_pose, &initial.joint_angles, &mut end_effectors)
            .map_err(|source| StudyError::Approach(PhaseError { time: 0.0, source }))?;
        for pair in pairs {
            let (Some(body), Some(end_effector)) = (targets.get(pair.target), end_effectors.get(pair.arm)) else {
                continue;
            };
            let (distance, _) = signed_distance(self.scenario, pair.target, body, end_effector);
            if distance <= 0.0 {
                let arm = self.scenario.layout.arms.get(pair.arm).map_or_else(String::new, |arm| arm.name.clone());
                let target = self.scenario.targets.get(pair.target).map_or_else(String::new, |t| t.name.clone());
                return Err(StudyError::Inside { case: self.case.name.clone(), arm, target, depth: -distance });
            }
        }
        Ok(())
    }

    /// How near each pair comes in the samples of a phase that starts at `from` s.
    fn closest(
        self,
        pairs: &[ContactPair],
        phase: &Phase,
        from: f64,
        targets: impl Fn(usize) -> Vec<Body>,
    ) -> Vec<ClosestApproach> {
        let far = |pair: &ContactPair| ClosestApproach {
            target: pair.target,
            arm: pair.arm,
            distance: f64::INFINITY,
            time: from,
        };
        let mut closest: Vec<ClosestApproach> = pairs.iter().map(far).collect();
        if closest.is_empty() {
            return closest;
        }
        for (i, sample) in phase.samples.iter().enumerate() {
            let targets = targets(i);
            for nearest in &mut closest {
                let (body, end_effector) = (targets.get(nearest.target), sample.end_effector_poses.get(nearest.arm));
                let (Some(body), Some(end_effector)) = (body, end_effector) else { continue };
                let (distance, _) = signed_distance(self.scenario, nearest.target, body, end_effector);
                if distance < nearest.distance {
                    *nearest = ClosestApproach { distance, time: from + sample.time, ..*nearest };
                }
            }
        }
        closest
    }
}

/// Robot and targets in the course of a case.
struct SequenceState<'a> {
    course: CaptureSequence<'a>,
    state: RobotState,
    targets: Vec<Body>,
    attachments: Vec<Attachment>,
    assembly: Assembly,
    /// Of the first impact, rad.
    angles: Vec<f64>,
}

impl SequenceState<'_> {
    /// Velocities change, and what takes hold becomes part of the assembly.
    fn apply_impact(&mut self, touching: &[ImpactContact]) -> Result<ImpactSolution, StudyError> {
        let course = self.course;
        let impact = solve_impact(&self.assembly, &self.state, &self.targets, touching)
            .map_err(|source| course.unsolved(source))?;
        self.state.base_twist = impact.exact.base_twist_after;
        self.state.joint_rates.clone_from(&impact.exact.joint_rates_after);
        for (target, twist) in self.targets.iter_mut().zip(&impact.target_twists) {
            target.twist = *twist;
        }
        self.attachments.extend(holds(touching));
        self.assembly = Assembly::new((course.make)(), &self.state, &self.targets, &self.attachments)
            .map_err(|source| course.unsolved(source))?;
        Ok(impact)
    }

    /// The motion from `time` s after the first impact on, up to a contact of the pairs; and the targets at its
    /// samples.
    fn integrate_to_contact(
        &mut self,
        pairs: &[ContactPair],
        time: f64,
        observer: &mut dyn Observer,
    ) -> Result<(Phase, Vec<Vec<Body>>), StudyError> {
        let course = self.course;
        let Self { state, targets, assembly, .. } = self;
        let flight = TargetMotion::Assembled(assembly, targets);
        let mut contacts = ContactDetection::new(course.scenario, flight, pairs.to_vec());
        let wheels = wheels(&course.scenario.layout, &self.attachments);
        let wanted = PostCaptureLaw { after: course.after, wheels: &wheels, angles: &self.angles };
        let timing = course.timing(course.after.duration - time);
        let system = System { joint_limits: &course.scenario.joint_limits, ..assembly.system() };
        let phase = run_post_capture(&system, wanted, state, &timing, &mut contacts, &mut || observer.step())
            .map_err(|stopped| course.stopped(time + stopped.time, stopped.source))?;
        let at =
            |now: &Sample| assembly.targets(targets, &now.end_effector_poses, &now.end_effector_twists, &now.bodies);
        let along: Vec<Vec<Body>> = phase.samples.iter().map(at).collect();
        if let (Some(end), Some(last)) = (phase.end(), along.last()) {
            state.clone_from(&end.state);
            targets.clone_from(last);
        }
        Ok((phase, along))
    }

    /// What is left of the motion.
    fn remainder(&self, control: &PostCaptureControl, phase: &Phase) -> Result<ResidualMotion, StudyError> {
        let wheels = wheels(&self.course.scenario.layout, &self.attachments);
        let beside = phase.end().map_or_else(Vec::new, |end| self.assembly.pinned(&end.bodies));
        ResidualMotion::of(&*self.assembly.model, &beside, control, &self.state, &wheels)
            .map_err(|source| self.course.stopped(phase.duration, source))
    }
}

/// The contacts that hold.
fn holds(touching: &[ImpactContact]) -> impl Iterator<Item = Attachment> {
    let held = touching.iter().filter(|touch| touch.law.kind().holds());
    held.map(|touch| Attachment { target: touch.target, arm: touch.arm, kind: touch.law.kind() })
}
