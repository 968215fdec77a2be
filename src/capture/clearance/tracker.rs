//! Least distances and overlaps of pairs of bodies over the phases of a case.

use super::bodies::{BodyPair, ClearanceBody};
use super::search::{Findings, PartDistance, WindowSearch};
use super::{ClearanceError, Exhausted};
use crate::capture::assembly::Attachment;
use crate::capture::proximity::motion::FrameKinematics;
use crate::capture::proximity::part_pair::PartPair;
use crate::capture::proximity::workspace::PathWorkspace;
use crate::capture::target_motion::TargetMotion;
use crate::frames::Frame;
use crate::simulate::path::{Path, PathPart};

/// Intervals of a path that are looked at together: what is far apart, or comes steadily nearer, needs no more instants
/// over many of them than over one.
const WINDOW: usize = 16;

/// Pairs of bodies, and what has been found of them.
#[derive(Clone)]
pub(super) struct DistanceTracker {
    frames: Vec<Frame>,
    pub(super) bodies: Vec<ClearanceBody>,
    pub(super) pairs: Vec<BodyPair>,
    /// One for each pair.
    distances: Vec<PairDistance>,
    pub(super) found: Findings,
}

/// What is known of the distance of a pair.
#[derive(Clone)]
struct PairDistance {
    /// Lower bound at the end of the last interval by circles about the frames, m.
    circles: f64,
    /// Whether this is all that is known: the parts were not looked at.
    is_far: bool,
    parts: Vec<PartDistance>,
}

impl DistanceTracker {
    /// For the start of a case. The least distance is found for each group of pairs, numbered from 0.
    pub(super) fn new(
        frames: Vec<Frame>,
        bodies: Vec<ClearanceBody>,
        pairs: Vec<BodyPair>,
        max_distances: u64,
    ) -> Self {
        let of_pair = |(pair, BodyPair { bodies: [a, b], .. }): (usize, &BodyPair)| {
            let second = bodies[*b].parts.len();
            let indices = (0..bodies[*a].parts.len()).flat_map(|i| (0..second).map(move |j| [i, j]));
            let part = |parts| PartDistance { pair, parts, lower: f64::NEG_INFINITY, last: None, open: None };
            PairDistance { circles: f64::NEG_INFINITY, is_far: false, parts: indices.map(part).collect() }
        };
        let distances = pairs.iter().enumerate().map(of_pair).collect();
        let found = Findings::new(&pairs, max_distances);
        Self { frames, bodies, pairs, distances, found }
    }

    /// Whether the layout leaves the outline of a body of a pair at its default.
    pub(super) fn has_default(&self, pair: usize) -> bool {
        self.pairs[pair].bodies.iter().any(|body| self.bodies[*body].is_default)
    }

    /// Adds a phase that starts at `start` s; arms do not overlap with the targets that they hold.
    ///
    /// # Errors
    /// [`ClearanceError`].
    pub(super) fn add_phase(
        &mut self,
        path: &Path,
        start: f64,
        targets: TargetMotion<'_>,
        attachments: &[Attachment],
    ) -> Result<(), ClearanceError> {
        let Self { frames, bodies, pairs, distances, found } = self;
        let motions = &FrameKinematics::new(frames, targets);
        let of_frames: Vec<_> =
            pairs.iter().map(|pair| motions.pair(pair.bodies.map(|body| bodies[body].frame))).collect();
        let (mut workspace, mut instants) = (PathWorkspace::default(), Default::default());
        let holds = |pair: &BodyPair| {
            pair.contact.is_some_and(|(arm, target)| attachments.iter().any(|a| (a.arm, a.target) == (arm, target)))
        };
        let mut end = start;
        distances.iter_mut().flat_map(|known| &mut known.parts).for_each(|part| part.last = None);
        path.try_for_each_window(WINDOW, |window| {
            let [first, last] = window.span();
            let length = last - first;
            end = start + last;
            workspace.set_bounds(motions, &window);
            for ((pair, frames), known) in pairs.iter().zip(&of_frames).zip(distances.iter_mut()) {
                if holds(pair) {
                    known.parts.iter_mut().for_each(|part| part.open = None);
                    continue;
                }
                let [a, b] = pair.bodies.map(|body| &bodies[body]);
                let bound = workspace.relative_bound(motions, frames);
                if known.parts.iter().all(|part| part.open.is_none()) {
                    let (goal, away) = (found.goal(pair), bound.speed([0.0; 2]) * length);
                    if known.circles - away < goal {
                        let between = workspace.origin_distance(motions, &window, frames, first);
                        known.circles = between - a.reach() - b.reach();
                    }
                    known.circles -= away;
                    known.is_far |= known.circles >= goal;
                    if known.circles >= goal {
                        continue;
                    }
                }
                if std::mem::take(&mut known.is_far) {
                    known.parts.iter_mut().for_each(|part| part.lower = f64::NEG_INFINITY);
                }
                for part in &mut known.parts {
                    let shapes = [&a.parts[part.parts[0]], &b.parts[part.parts[1]]];
                    let reaches = shapes.map(|part| part.reach);
                    let speed = bound.speed(reaches);
                    if part.open.is_none() && part.lower - speed * length >= found.goal(pair) {
                        part.lower -= speed * length;
                        continue;
                    }
                    let acceleration = bound.acceleration(reaches);
                    let mut search = WindowSearch {
                        shapes: PartPair { parts: shapes, speed, acceleration },
                        frames,
                        motions,
                        window,
                        start,
                        workspace: &mut workspace,
                        instants: &mut instants,
                    };
                    search.run(part, pair, found).map_err(|time| exhausted(found, pairs, bodies, time))?;
                }
            }
            Ok::<(), ClearanceError>(())
        })?;
        for overlap in distances.iter().flat_map(|known| &known.parts).filter_map(|part| part.open) {
            found.overlaps[overlap].span[1] = end;
        }
        Ok(())
    }
}

/// What has used up the distances by a time, s.
fn exhausted(found: &Findings, pairs: &[BodyPair], bodies: &[ClearanceBody], time: f64) -> ClearanceError {
    let most = found.of_pairs.iter().copied().zip(pairs).max_by_key(|(count, _)| *count);
    let (of_pair, pair) = most.expect("distances are of a pair");
    let of_pair = Exhausted {
        time,
        evaluations: found.evaluations,
        bodies: pair.bodies.map(|body| bodies[body].name.clone()),
        of_pair,
        parts: pair.bodies.map(|body| bodies[body].parts.len()),
    };
    ClearanceError::Exhausted(Box::new(of_pair))
}

#[cfg(test)]
mod tests;
