//! Contact detection: events where the signed distance of an end effector from the outline of its target falls to zero.
//!
//! # Example
//! ```
//! use planar_capture::capture::contact_detection::{ContactDetection, ContactPair, TargetMotion};
//! use planar_capture::simulate::system::{Body, System};
//! use planar_capture::simulate::{Timing, simulate};
//! use planar_capture::{control::ZeroTorque, generated::dual_arm_3r::Model, registry, scenario::Scenario};
//!
//! let path = "scenarios/elastic_rebound.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! scenario.initial.joint_angles = vec![0.0; 6]; // the first end effector is at x = 3.5 m
//! scenario.targets.truncate(1); // a ball of 0.3 m
//! let ball = [Body { mass: 20.0, inertia: 1.0, pose: [0.0, 4.8, 0.0], twist: [0.0, -0.1, 0.0] }];
//! let pair = ContactPair { target: 0, contact: 0, arm: 0 };
//! let mut contacts = ContactDetection::new(&scenario, TargetMotion::Free(&ball), vec![pair]);
//! let (robot, timing) = (Model::default(), Timing { duration: 20.0, step: 0.5, sample: 5.0, ..Timing::default() });
//! let system = System::alone(&robot);
//! let phase = simulate(&system, &mut ZeroTorque, &scenario.initial, &timing, &mut contacts, &mut || ())?;
//! assert!((phase.duration - 10.0).abs() < 1e-6); // 1 m at 0.1 m/s
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

use crate::capture::assembly::rotated;
use crate::capture::proximity::convex::ConvexPart;
use crate::capture::proximity::motion::{FrameKinematics, FramePair};
use crate::capture::proximity::part_pair::{Instant, PartPair, SHORTEST};
use crate::capture::proximity::workspace::PathWorkspace;
use crate::error::Error;
use crate::frames::FrameMotion;
use crate::outline::SignedDistance;
use crate::scenario::Scenario;
use crate::simulate::event::{EventState, Events};
use crate::simulate::path::PathInterval;
use crate::simulate::system::Body;

pub use crate::capture::contact_pair::ContactPair;
pub use crate::capture::target_motion::TargetMotion;

/// Depth of an end effector inside a target at which bounds of the motion count it as a contact, m; the time of the
/// contact is that of the depth 0.
const DEPTH: f64 = 1e-9;

/// One event for each pair: its value is the distance of the end effector from the outline of the target, m, negative
/// inside. Crossings within a step are found by bounds of the motion.
pub struct ContactDetection<'a> {
    scenario: &'a Scenario,
    motion: TargetMotion<'a>,
    pairs: Vec<DetectedPair>,
    end_effectors: Vec<[f64; 3]>,
    motions: FrameKinematics<'a>,
    end_effector: ConvexPart,
    workspace: PathWorkspace,
    /// How many distances were computed.
    evaluations: u64,
}

/// A pair, and what is known of its distance at the end of the last step.
struct DetectedPair {
    pair: ContactPair,
    /// Of end effector and target.
    frames: FramePair,
    /// Of the target.
    parts: Vec<ConvexPart>,
    /// Lower bound of the distance, m.
    lower: f64,
    /// Whether the distance has been positive since the start of the phase.
    armed: bool,
}

impl<'a> ContactDetection<'a> {
    /// Detects the contacts of these pairs.
    ///
    /// # Panics
    /// For arms and targets that the scenario does not have.
    #[must_use]
    pub fn new(scenario: &'a Scenario, motion: TargetMotion<'a>, pairs: Vec<ContactPair>) -> Self {
        let frames = scenario.frames();
        let frame = |motion, arm| {
            let found = frames.iter().position(|frame| frame.motion == motion && frame.arm == arm);
            found.expect("every end effector and target has a frame")
        };
        let motions = FrameKinematics::new(&frames, motion);
        let detected = |pair: ContactPair| DetectedPair {
            pair,
            frames: motions
                .pair([frame(FrameMotion::Fixed, Some(pair.arm)), frame(FrameMotion::Target(pair.target), None)]),
            parts: ConvexPart::of(&scenario.targets[pair.target].outline),
            lower: f64::NEG_INFINITY,
            armed: false,
        };
        let pairs = pairs.into_iter().map(detected).collect();
        let end_effectors = vec![[0.0; 3]; scenario.layout.arms.len()];
        Self {
            scenario,
            motion,
            pairs,
            end_effectors,
            motions,
            end_effector: ConvexPart::point(),
            workspace: PathWorkspace::default(),
            evaluations: 0,
        }
    }

    /// How many distances were computed.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.evaluations
    }
}

/// Distance and outward normal, inertial axes, of an end effector from a target of the scenario.
pub(crate) fn signed_distance(
    scenario: &Scenario,
    target: usize,
    body: &Body,
    end_effector: &[f64; 3],
) -> (f64, [f64; 2]) {
    let [yaw, x, y] = body.pose;
    let point = rotated([end_effector[1] - x, end_effector[2] - y], -yaw);
    let SignedDistance { distance, normal } = scenario.targets[target].outline.signed_distance(point);
    (distance, rotated(normal, yaw))
}

impl Events for ContactDetection<'_> {
    fn count(&self) -> usize {
        self.pairs.len()
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        let model = now.system.model;
        model.end_effector_poses(&now.state.base_pose, now.state.joint_angles, &mut self.end_effectors)?;
        let targets = match self.motion {
            TargetMotion::Free(targets) => targets.iter().map(|target| target.after(now.time)).collect(),
            // the twists are not used
            TargetMotion::Assembled(assembly, targets) => {
                assembly.targets(targets, &self.end_effectors, &self.end_effectors, now.bodies)
            }
        };
        for (value, DetectedPair { pair, .. }) in values.iter_mut().zip(&self.pairs) {
            let (body, end_effector) = (&targets[pair.target], &self.end_effectors[pair.arm]);
            (*value, _) = signed_distance(self.scenario, pair.target, body, end_effector);
        }
        Ok(())
    }

    fn are_bounded(&self) -> bool {
        true
    }

    fn crossings(&mut self, step: &PathInterval<'_>) -> Result<Vec<Option<[f64; 2]>>, Error> {
        let Self { motions, pairs, end_effector, workspace, evaluations, .. } = self;
        workspace.set_bounds(motions, step);
        let mut search = StepSearch { motions, step, workspace, evaluations };
        pairs.iter_mut().map(|pair| search.crossing(pair, end_effector)).collect()
    }
}

/// The search for contacts within one step.
struct StepSearch<'a> {
    motions: &'a FrameKinematics<'a>,
    step: &'a PathInterval<'a>,
    workspace: &'a mut PathWorkspace,
    evaluations: &'a mut u64,
}

impl StepSearch<'_> {
    /// Two times between which the end effector of a pair reaches its target for the first time.
    fn crossing(&mut self, detected: &mut DetectedPair, end_effector: &ConvexPart) -> Result<Option<[f64; 2]>, Error> {
        let [start, end] = self.step.span;
        let reaches = [0.0, detected.parts.iter().map(|part| part.reach).fold(0.0, f64::max)];
        let bound = self.workspace.relative_bound(self.motions, &detected.frames);
        let speed = bound.speed(reaches);
        let approach = speed * (end - start);
        if detected.armed && detected.lower - approach > 0.0 {
            detected.lower -= approach;
            return Ok(None);
        }
        let acceleration = bound.acceleration(reaches);
        let pairs: Vec<_> =
            detected.parts.iter().map(|part| PartPair { parts: [end_effector, part], speed, acceleration }).collect();
        let frames = &detected.frames;
        let mut instant_at = |pair: &PartPair<'_>, time: f64| self.at(pair, frames, time);
        let mut distance_at = |time: f64| {
            let distances = pairs.iter().map(|pair| instant_at(pair, time).distance);
            distances.fold(f64::INFINITY, f64::min)
        };
        detected.lower = distance_at(end);
        // a pair in contact at the start can only touch again after it has separated
        let mut from = start;
        let mut wait = SHORTEST;
        while !detected.armed {
            detected.armed = distance_at(from) > DEPTH;
            if !detected.armed {
                if from >= end {
                    return Ok(None);
                }
                from = (start + wait).min(end);
                wait *= 2.0;
            }
        }
        let mut first: Option<f64> = None;
        for pair in &pairs {
            if let Some([_, below]) = pair.first_contact([from, end], DEPTH, &mut instant_at)? {
                first = Some(first.map_or(below, |earlier| earlier.min(below)));
            }
        }
        Ok(first.map(|below| [from, below]))
    }

    fn at(&mut self, pair: &PartPair<'_>, frames: &FramePair, time: f64) -> Instant {
        *self.evaluations += 1;
        self.workspace.instant(self.motions, self.step, (frames, pair), time)
    }
}

#[cfg(test)]
mod tests;
