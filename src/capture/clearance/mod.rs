//! The clearance of a case: least distance and overlaps of all bodies that are not joined, continuously in time.
//!
//! Distances are those of the interpolated path (`simulate::path`), whatever the steps and the samples are. A pair is
//! computed again when its last distance less the bound of its relative motion falls below what matters: the least
//! distance so far, or an overlap.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::registry;
//! use planar_capture::scenario::{Case, Scenario};
//!
//! let path = "scenarios/elastic_rebound.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! // stretched arms that stay where they are, the ball of 0.3 m in front of the end effector at x = 3.5 m
//! scenario.initial.joint_angles = vec![0.0, 0.0, 0.0, std::f64::consts::PI, 0.0, 0.0];
//! scenario.approach.final_joint_angles = scenario.initial.joint_angles.clone();
//! scenario.targets.truncate(1);
//! (scenario.targets[0].position, scenario.targets[0].twist) = (Some([4.3, 0.0]), [0.0; 3]);
//! scenario.cases = vec![Case::of_targets("stretched", &scenario.targets)];
//! let study = study(&scenario, &|| registry::generic(&scenario.layout), 1.0, &mut Silent)?;
//! let least = study.cases[0].clearance.least.as_ref().expect("bodies that are not joined");
//! assert_eq!(least.bodies, ["arms/arm1/link3", "targets/ball"]);
//! assert!((least.distance - 0.5).abs() < 1e-9);
//! # Ok::<(), planar_capture::capture::StudyError>(())
//! ```

mod bodies;
mod search;
mod tracker;

use crate::capture::assembly::Attachment;
use crate::capture::contact_pair::ContactPair;
use crate::capture::target_motion::TargetMotion;
use crate::scenario::{OnOverlap, Scenario};
use crate::simulate::path::Path;
pub(crate) use bodies::ineffective_ignores;
use bodies::{bodies, end_effector_pairs, pairs};
use search::PairOverlap;
use std::fmt::{self, Display, Formatter};
use std::io;
use tracker::DistanceTracker;

/// Overlaps that begin within this time begin together, s: a contact is located to 1e-9 s.
const SAME_TIME: f64 = 1e-8;

/// The least distance of two bodies.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LeastDistance {
    /// m; negative for the depth of an overlap.
    pub distance: f64,
    /// Since the start of the approach, s.
    pub time: f64,
    /// `base`, `arms/ARM/link1`, `targets/TARGET`.
    pub bodies: [String; 2],
}

/// Two bodies inside each other by more than 1 µm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Overlap {
    /// As in [`LeastDistance`].
    pub bodies: [String; 2],
    /// From its first touch to its end, or that of the case; since the start of the approach, s.
    pub span: [f64; 2],
    /// The largest, m.
    pub depth: f64,
    /// Whether one of the outlines is a default, which the layout does not give.
    pub is_default: bool,
}

impl Overlap {
    /// In words.
    #[must_use]
    pub fn sentence(&self) -> String {
        let Self { bodies: [a, b], span: [from, to], depth, is_default } = self;
        let outlines = if *is_default { " (default outlines)" } else { "" };
        let when = match to - from {
            0.0 => return format!("`{a}` and `{b}` begin to overlap at {from:.3} s{outlines}"),
            short if short < 1e-3 => format!("at {from:.3} s for {short:.1e} s"),
            _ => format!("from {from:.3} s to {to:.3} s"),
        };
        format!("`{a}` and `{b}` overlap {when} by up to {depth:.2e} m{outlines}")
    }
}

/// The clearance of a case.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Clearance {
    /// Of all pairs; `None` where all bodies are joined.
    pub least: Option<LeastDistance>,
    /// Of the pairs but those of an arm's last link and a target that the arm captures, which are to meet.
    pub besides_contacts: Option<LeastDistance>,
    /// In the order of their beginnings.
    pub overlaps: Vec<Overlap>,
    /// How many distances were computed, for contact detection too.
    pub evaluations: u64,
    /// What an overlap does.
    pub on_overlap: OnOverlap,
}

impl Clearance {
    /// The least distance besides planned contacts; of all pairs where there are no others.
    #[must_use]
    pub fn least_shown(&self) -> Option<&LeastDistance> {
        self.besides_contacts.as_ref().or(self.least.as_ref())
    }

    /// The overlaps that fail the run.
    pub fn failures(&self) -> impl Iterator<Item = &Overlap> {
        self.overlaps.iter().filter(|overlap| self.on_overlap != OnOverlap::Report && !overlap.is_default)
    }
}

/// The smallest distance of an end effector from a target that it is to meet.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClosestApproach {
    /// Index of the target.
    pub target: usize,
    /// Index of the arm.
    pub arm: usize,
    /// From the outline, m; negative inside.
    pub distance: f64,
    /// Since the start of the approach, s.
    pub time: f64,
}

/// Why the clearance of a phase is not known.
#[derive(Debug)]
pub(crate) enum ClearanceError {
    /// There are too many distances to compute.
    Exhausted(Box<Exhausted>),
    /// The path is not in its file.
    Path(io::Error),
}

/// Distances that are used up.
#[derive(Clone, Debug, PartialEq)]
pub struct Exhausted {
    /// When, since the start of the approach, s.
    pub time: f64,
    /// How many were computed.
    pub evaluations: u64,
    /// The pair with the most of them, as in [`LeastDistance`].
    pub bodies: [String; 2],
    /// How many of these.
    pub of_pair: u64,
    /// The convex parts of the two.
    pub parts: [usize; 2],
}

impl Display for Exhausted {
    fn fmt(&self, to: &mut Formatter<'_>) -> fmt::Result {
        let Self { time, evaluations, bodies: [first, second], of_pair, parts: [of_first, of_second] } = self;
        write!(
            to,
            "{evaluations} distances were computed by {time} s, {of_pair} of them of `{first}` and `{second}`, whose \
             outlines have {of_first} and {of_second} convex parts"
        )
    }
}

impl From<io::Error> for ClearanceError {
    fn from(error: io::Error) -> Self {
        Self::Path(error)
    }
}

/// The clearance of a case so far.
#[derive(Clone)]
pub(crate) struct ClearanceTracker {
    /// Of all bodies; group 1 are the pairs that are to meet.
    bodies: DistanceTracker,
    /// Of end effectors and targets, each pair a group.
    end_effectors: DistanceTracker,
    on_overlap: OnOverlap,
    /// How many distances contact detection has computed.
    contact_evaluations: u64,
}

impl ClearanceTracker {
    /// For the start of a case with these planned contacts.
    pub(crate) fn new(scenario: &Scenario, contacts: &[ContactPair]) -> Self {
        let frames = scenario.frames();
        let all = bodies(scenario, &frames);
        let (points, planned) = end_effector_pairs(scenario, &frames, contacts);
        let pairs = pairs(scenario, &frames, &all);
        let rules = &scenario.clearance;
        Self {
            bodies: DistanceTracker::new(frames.clone(), all, pairs, rules.max_distances),
            end_effectors: DistanceTracker::new(frames, points, planned, rules.max_distances),
            on_overlap: rules.on_overlap,
            contact_evaluations: 0,
        }
    }

    /// Adds a phase that starts at `start` s; arms do not overlap with the targets that they hold.
    ///
    /// # Errors
    /// [`ClearanceError`].
    pub(crate) fn add_phase(
        &mut self,
        path: &Path,
        start: f64,
        targets: TargetMotion<'_>,
        attachments: &[Attachment],
    ) -> Result<(), ClearanceError> {
        self.bodies.add_phase(path, start, targets, attachments)?;
        self.end_effectors.add_phase(path, start, targets, attachments)
    }

    /// Adds distances that contact detection has computed.
    pub(crate) fn add_evaluations(&mut self, evaluations: u64) {
        self.contact_evaluations += evaluations;
    }

    /// The closest approaches of the planned contacts.
    pub(crate) fn closest(&self) -> Vec<ClosestApproach> {
        let tracker = &self.end_effectors;
        let closest = |&(distance, time, pair): &(f64, f64, usize)| {
            let (arm, target) = tracker.pairs[pair].contact?;
            Some(ClosestApproach { target, arm, distance, time })
        };
        tracker.found.least.iter().flatten().filter_map(closest).collect()
    }

    /// The largest depth of an end effector inside a target that it does not hold, m.
    pub(crate) fn penetration(&self) -> f64 {
        self.end_effectors.found.overlaps.iter().fold(0.0, |depth, overlap| overlap.depth.max(depth))
    }

    /// Pair and time (s) of the first overlap of two bodies whose outlines are both given.
    pub(crate) fn first_given_overlap(&self) -> Option<(usize, f64)> {
        let overlaps = self.bodies.found.overlaps.iter().filter(|overlap| !self.bodies.has_default(overlap.pair));
        overlaps.map(|overlap| (overlap.pair, overlap.span[0])).min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Adds the overlap at whose beginning the case ends.
    pub(crate) fn end_at(&mut self, (pair, time): (usize, f64)) {
        self.bodies.found.overlaps.push(PairOverlap { pair, span: [time, time], depth: 0.0 });
    }

    /// The result.
    pub(crate) fn result(&self) -> Clearance {
        let DistanceTracker { bodies, pairs, found, .. } = &self.bodies;
        let names = |pair: usize| pairs[pair].bodies.map(|body| bodies[body].name.clone());
        // zero has no sign
        let least = |&(distance, time, pair): &(f64, f64, usize)| LeastDistance {
            distance: distance + 0.0,
            time,
            bodies: names(pair),
        };
        let mut overlaps: Vec<_> = found.overlaps.iter().collect();
        overlaps.sort_by(|a, b| (a.pair, a.span[0]).partial_cmp(&(b.pair, b.span[0])).expect("times are finite"));
        let mut joined: Vec<(usize, Overlap)> = Vec::new();
        for PairOverlap { pair, span, depth } in overlaps {
            match joined.last_mut() {
                // another part of the same bodies
                Some((earlier, overlap)) if earlier == pair && span[0] <= overlap.span[1] => {
                    overlap.span[1] = overlap.span[1].max(span[1]);
                    overlap.depth = overlap.depth.max(*depth);
                }
                _ => {
                    let is_default = self.bodies.has_default(*pair);
                    joined.push((*pair, Overlap { bodies: names(*pair), span: *span, depth: *depth, is_default }));
                }
            }
        }
        // what begins together, as links do that a target reaches at their joint, stays in the order of the pairs
        let begins = |overlap: &Overlap| (overlap.span[0] / SAME_TIME).round();
        joined.sort_by(|(_, a), (_, b)| begins(a).total_cmp(&begins(b)));
        Clearance {
            least: found.least.iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0)).map(least),
            besides_contacts: found.least.first().and_then(Option::as_ref).map(least),
            overlaps: joined.into_iter().map(|(_, overlap)| overlap).collect(),
            evaluations: found.evaluations + self.end_effectors.found.evaluations + self.contact_evaluations,
            on_overlap: self.on_overlap,
        }
    }
}

#[cfg(test)]
mod tests;
