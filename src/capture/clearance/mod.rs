//! The clearance of a case: least distance and overlaps of all bodies that are not joined, continuously in time.
//!
//! Distances are those of the interpolated path (`simulate::path`), whatever the steps and the samples are. A pair is
//! computed again when its last distance less the bound of its relative motion falls below what matters: the least
//! distance so far, or an overlap.

mod bodies;
mod convex;
mod motion;
mod part_pair;
mod search;

use crate::capture::assembly::Attachment;
use crate::capture::target_motion::TargetMotion;
use crate::frames::Frame;
use crate::scenario::{OnOverlap, Scenario};
use crate::simulate::path::Path;
use bodies::{BodyPair, ClearanceBody, bodies, pairs};
use convex::ConvexPart;
use motion::FrameMotions;
use part_pair::PartPair;
use search::{Findings, IntervalSearch, PairOverlap, PartDistance, Workspace};

/// The least distance of two bodies.
#[derive(Clone, Debug, PartialEq)]
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
        format!("`{a}` and `{b}` overlap from {from:.3} s to {to:.3} s by up to {depth:.2e} m{outlines}")
    }
}

/// The clearance of a case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Clearance {
    /// Of all pairs; `None` where all bodies are joined.
    pub least: Option<LeastDistance>,
    /// Of the pairs but those of an arm's last link and a target that the arm captures, which are to meet.
    pub besides_contacts: Option<LeastDistance>,
    /// In the order of their beginnings.
    pub overlaps: Vec<Overlap>,
    /// How many distances were computed.
    pub evaluations: u64,
    /// What an overlap does.
    pub on_overlap: OnOverlap,
}

impl Clearance {
    /// The overlaps that fail the run.
    pub fn failures(&self) -> impl Iterator<Item = &Overlap> {
        self.overlaps.iter().filter(|overlap| self.on_overlap != OnOverlap::Report && !overlap.is_default)
    }
}

/// The clearance of a case so far.
#[derive(Clone)]
pub(crate) struct ClearanceTracker {
    frames: Vec<Frame>,
    bodies: Vec<ClearanceBody>,
    pairs: Vec<BodyPair>,
    parts: Vec<PartDistance>,
    found: Findings,
    joints: usize,
    on_overlap: OnOverlap,
}

impl ClearanceTracker {
    /// For the start of a case.
    pub(crate) fn new(scenario: &Scenario) -> Self {
        let frames = scenario.frames();
        let bodies = bodies(scenario, &frames);
        let pairs = pairs(scenario, &frames, &bodies);
        let mut parts = Vec::new();
        for (pair, BodyPair { bodies: [a, b], .. }) in pairs.iter().enumerate() {
            for i in 0..bodies[*a].parts.len() {
                let of_pair = |j| PartDistance { pair, parts: [i, j], lower: f64::NEG_INFINITY, open: None };
                parts.extend((0..bodies[*b].parts.len()).map(of_pair));
            }
        }
        Self {
            frames,
            bodies,
            pairs,
            parts,
            found: Findings::default(),
            joints: scenario.layout.joints(),
            on_overlap: scenario.clearance.on_overlap,
        }
    }

    /// Adds a phase that starts at `start` s; arms do not overlap with the targets that they hold.
    pub(crate) fn add_phase(&mut self, path: &Path, start: f64, targets: TargetMotion<'_>, attachments: &[Attachment]) {
        let Self { frames, bodies, pairs, parts, found, joints, .. } = self;
        let motions = FrameMotions { frames, targets, joints: *joints };
        let size = path.size();
        let mut workspace = Workspace::new(size);
        let holds = |pair: &BodyPair| {
            pair.contact.is_some_and(|(arm, target)| attachments.iter().any(|a| (a.arm, a.target) == (arm, target)))
        };
        let mut end = start;
        for interval in path.intervals() {
            let length = interval.span[1] - interval.span[0];
            end = start + interval.span[1];
            motions.bounds(&interval, &mut workspace.coordinates, &mut workspace.bounds);
            for part in parts.iter_mut() {
                let pair = &pairs[part.pair];
                if holds(pair) {
                    part.open = None;
                    continue;
                }
                let frames = pair.bodies.map(|body| bodies[body].frame);
                let shapes = [0, 1].map(|i| &bodies[pair.bodies[i]].parts[part.parts[i]]);
                let bounds = frames.map(|frame| workspace.bounds[frame]);
                let reaches = shapes.map(ConvexPart::reach);
                let speed = bounds[0].speed_within(reaches[0]) + bounds[1].speed_within(reaches[1]);
                if part.open.is_none() && part.lower - speed * length >= found.goal(part, pair) {
                    part.lower -= speed * length;
                    continue;
                }
                let acceleration =
                    bounds[0].acceleration_within(reaches[0]) + bounds[1].acceleration_within(reaches[1]);
                let mut search = IntervalSearch {
                    shapes: PartPair { parts: shapes, acceleration },
                    frames,
                    motions,
                    interval,
                    start,
                    workspace: &mut workspace,
                };
                search.run(part, pair, found);
            }
        }
        for overlap in parts.iter().filter_map(|part| part.open) {
            found.overlaps[overlap].span[1] = end;
        }
    }

    /// Pair and time (s) of the first overlap of two bodies whose outlines are both given.
    pub(crate) fn first_given_overlap(&self) -> Option<(usize, f64)> {
        let given = |pair: usize| self.pairs[pair].bodies.iter().all(|body| !self.bodies[*body].is_default);
        let overlaps = self.found.overlaps.iter().filter(|overlap| given(overlap.pair));
        overlaps.map(|overlap| (overlap.pair, overlap.span[0])).min_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Adds the overlap at whose beginning the case ends.
    pub(crate) fn end_at(&mut self, (pair, time): (usize, f64)) {
        self.found.overlaps.push(PairOverlap { pair, span: [time, time], depth: 0.0 });
    }

    /// The result.
    pub(crate) fn result(&self) -> Clearance {
        let names = |pair: usize| self.pairs[pair].bodies.map(|body| self.bodies[body].name.clone());
        let least = |(distance, time, pair): (f64, f64, usize)| LeastDistance { distance, time, bodies: names(pair) };
        let mut overlaps: Vec<_> = self.found.overlaps.iter().collect();
        overlaps.sort_by(|a, b| (a.pair, a.span[0]).partial_cmp(&(b.pair, b.span[0])).expect("times are finite"));
        let mut joined: Vec<(usize, Overlap)> = Vec::new();
        for PairOverlap { pair, span, depth } in overlaps {
            match joined.last_mut() {
                // another part of the same bodies
                Some((last, overlap)) if last == pair && span[0] <= overlap.span[1] => {
                    overlap.span[1] = overlap.span[1].max(span[1]);
                    overlap.depth = overlap.depth.max(*depth);
                }
                _ => {
                    let is_default = self.pairs[*pair].bodies.iter().any(|body| self.bodies[*body].is_default);
                    joined.push((*pair, Overlap { bodies: names(*pair), span: *span, depth: *depth, is_default }));
                }
            }
        }
        joined.sort_by(|(_, a), (_, b)| a.span[0].total_cmp(&b.span[0]));
        Clearance {
            least: self.found.least.map(least),
            besides_contacts: self.found.besides_contacts.map(least),
            overlaps: joined.into_iter().map(|(_, overlap)| overlap).collect(),
            evaluations: self.found.evaluations,
            on_overlap: self.on_overlap,
        }
    }
}
