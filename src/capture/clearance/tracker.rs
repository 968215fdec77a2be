//! Least distances and overlaps of pairs of bodies over the phases of a case.

use super::ClearanceError;
use super::bodies::{BodyPair, ClearanceBody};
use super::search::{Findings, IntervalSearch, PartDistance};
use crate::capture::assembly::Attachment;
use crate::capture::proximity::motion::FrameKinematics;
use crate::capture::proximity::part_pair::PartPair;
use crate::capture::proximity::workspace::PathWorkspace;
use crate::capture::target_motion::TargetMotion;
use crate::frames::{Frame, FrameMotion};
use crate::simulate::path::Path;

/// Pairs of bodies, and what has been found of them.
#[derive(Clone)]
pub(super) struct DistanceTracker {
    frames: Vec<Frame>,
    pub(super) bodies: Vec<ClearanceBody>,
    pub(super) pairs: Vec<BodyPair>,
    parts: Vec<PartDistance>,
    pub(super) found: Findings,
    /// Number of joints.
    joints: usize,
}

impl DistanceTracker {
    /// For the start of a case. The least distance is found for each group of pairs, numbered from 0.
    pub(super) fn new(
        frames: Vec<Frame>,
        bodies: Vec<ClearanceBody>,
        pairs: Vec<BodyPair>,
        max_distances: u64,
    ) -> Self {
        let mut parts = Vec::new();
        for (pair, BodyPair { bodies: [a, b], .. }) in pairs.iter().enumerate() {
            for i in 0..bodies[*a].parts.len() {
                let of_pair = |j| PartDistance { pair, parts: [i, j], lower: f64::NEG_INFINITY, open: None };
                parts.extend((0..bodies[*b].parts.len()).map(of_pair));
            }
        }
        let groups = pairs.iter().map(|pair| pair.group + 1).max().unwrap_or(0);
        let joints = frames.iter().filter(|frame| matches!(frame.motion, FrameMotion::Joint(_))).count();
        Self { frames, bodies, pairs, parts, found: Findings::new(groups, max_distances), joints }
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
        let Self { frames, bodies, pairs, parts, found, joints, .. } = self;
        let motions = FrameKinematics { frames, targets, joints: *joints };
        let mut workspace = PathWorkspace::default();
        let holds = |pair: &BodyPair| {
            pair.contact.is_some_and(|(arm, target)| attachments.iter().any(|a| (a.arm, a.target) == (arm, target)))
        };
        let mut end = start;
        path.try_for_each(|interval| {
            let length = interval.span[1] - interval.span[0];
            end = start + interval.span[1];
            workspace.set_bounds(motions, &interval);
            for part in parts.iter_mut() {
                let pair = &pairs[part.pair];
                if holds(pair) {
                    part.open = None;
                    continue;
                }
                let frames = pair.bodies.map(|body| bodies[body].frame);
                let shapes = [0, 1].map(|i| &bodies[pair.bodies[i]].parts[part.parts[i]]);
                let reaches = shapes.map(|part| part.reach);
                let speed = workspace.speed(frames, reaches);
                if part.open.is_none() && part.lower - speed * length >= found.goal(part, pair) {
                    part.lower -= speed * length;
                    continue;
                }
                let acceleration = workspace.acceleration(frames, reaches);
                let mut search = IntervalSearch {
                    shapes: PartPair { parts: shapes, acceleration },
                    frames,
                    motions,
                    interval,
                    start,
                    workspace: &mut workspace,
                };
                search.run(part, pair, found)?;
            }
            Ok::<(), ClearanceError>(())
        })?;
        for overlap in parts.iter().filter_map(|part| part.open) {
            found.overlaps[overlap].span[1] = end;
        }
        Ok(())
    }
}
