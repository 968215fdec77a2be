//! The search for the least distance and the overlaps of two convex parts over an interval of a path, by branch and
//! bound.

use super::bodies::BodyPair;
use crate::capture::proximity::motion::FrameKinematics;
use crate::capture::proximity::part_pair::{Instant, PartPair, SHORTEST};
use crate::capture::proximity::workspace::PathWorkspace;
use crate::simulate::path::PathInterval;

/// A lower least distance than the one found may be missed by this, m; shallower overlaps are none.
const RESOLUTION: f64 = 1e-6;

/// Time for which the most distances are meant, s; longer cases may have more in proportion.
const BUDGETED: f64 = 100.0;

/// Two convex parts, and what is known of them.
#[derive(Clone)]
pub(super) struct PartDistance {
    pub(super) pair: usize,
    /// Indices of the parts.
    pub(super) parts: [usize; 2],
    /// Lower bound of the distance at the end of the last interval, m.
    pub(super) lower: f64,
    /// The overlap that has not ended.
    pub(super) open: Option<usize>,
}

/// Results by indices of pairs.
#[derive(Clone)]
pub(super) struct Findings {
    /// Distance (m), time (s) and pair of each group.
    pub(super) least: Vec<Option<(f64, f64, usize)>>,
    pub(super) overlaps: Vec<PairOverlap>,
    /// How many distances were computed, and of each pair.
    pub(super) evaluations: u64,
    pub(super) of_pairs: Vec<u64>,
    /// Most of them in [`BUDGETED`].
    max_evaluations: u64,
}

/// An overlap of two parts of a pair.
#[derive(Clone)]
pub(super) struct PairOverlap {
    pub(super) pair: usize,
    pub(super) span: [f64; 2],
    pub(super) depth: f64,
}

impl Findings {
    /// For pairs, before their first phase.
    pub(super) fn new(pairs: &[BodyPair], max_evaluations: u64) -> Self {
        let groups = pairs.iter().map(|pair| pair.group + 1).max().unwrap_or(0);
        Self {
            least: vec![None; groups],
            overlaps: Vec::new(),
            evaluations: 0,
            of_pairs: vec![0; pairs.len()],
            max_evaluations,
        }
    }

    /// The distance above which nothing about a pair is of interest, of whose parts no overlap is open.
    pub(super) fn goal(&self, pair: &BodyPair) -> f64 {
        self.least[pair.group].map_or(f64::INFINITY, |(distance, ..)| distance - RESOLUTION).max(-RESOLUTION)
    }

    /// The same of a part.
    fn goal_of_part(&self, part: &PartDistance, pair: &BodyPair) -> f64 {
        part.open.map_or_else(|| self.goal(pair), |open| -self.overlaps[open].depth - RESOLUTION)
    }

    /// Whether more distances were computed by a time, s, than are allowed until then.
    #[allow(clippy::cast_precision_loss, reason = "a limit")]
    fn are_used_up(&self, time: f64) -> bool {
        self.evaluations as f64 > self.max_evaluations as f64 * (time / BUDGETED).max(1.0)
    }

    fn record(&mut self, part: &PartDistance, body_pair: &BodyPair, instant: &Instant, start: f64) {
        self.evaluations += 1;
        self.of_pairs[part.pair] += 1;
        let (pair, distance, time) = (part.pair, instant.distance, start + instant.time);
        if let Some(open) = part.open {
            self.overlaps[open].depth = self.overlaps[open].depth.max(-distance);
        }
        let least = &mut self.least[body_pair.group];
        if least.is_none_or(|(least, ..)| distance < least) {
            *least = Some((distance, time, pair));
        }
    }
}

/// Two parts over one interval of the path.
pub(super) struct IntervalSearch<'a> {
    pub(super) shapes: PartPair<'a>,
    /// Indices of the frames of their bodies.
    pub(super) frames: [usize; 2],
    pub(super) motions: FrameKinematics<'a>,
    pub(super) interval: PathInterval<'a>,
    /// Of the phase, s.
    pub(super) start: f64,
    pub(super) workspace: &'a mut PathWorkspace,
}

impl IntervalSearch<'_> {
    /// Computes the distance at both ends, and between them wherever it may be below the goal.
    ///
    /// # Errors
    /// The time at which the distances are used up, since the start of the approach, s.
    pub(super) fn run(&mut self, part: &mut PartDistance, pair: &BodyPair, found: &mut Findings) -> Result<(), f64> {
        let ends = self.interval.span.map(|time| self.at(time));
        for end in &ends {
            found.record(part, pair, end, self.start);
        }
        let mut left = ends[0];
        // the instants to the right, the nearest last
        let mut rights = vec![ends[1]];
        self.pass(part, found, [left, left], &rights);
        while let Some(right) = rights.last() {
            let half = 0.5 * (right.time - left.time);
            let lowest = self.shapes.bound(&left, half).min(self.shapes.bound(right, -half));
            if lowest >= found.goal_of_part(part, pair) || 2.0 * half <= SHORTEST {
                let now = *right;
                self.pass(part, found, [left, now], &rights);
                left = now;
                rights.pop();
            } else {
                let middle = self.at(left.time + half);
                found.record(part, pair, &middle, self.start);
                rights.push(middle);
                if found.are_used_up(self.start + left.time) {
                    return Err(self.start + left.time);
                }
            }
        }
        part.lower = ends[1].distance;
        Ok(())
    }

    fn at(&mut self, time: f64) -> Instant {
        self.workspace.instant(self.motions, &self.interval, (self.frames, &self.shapes), time)
    }

    /// Begins, continues or ends an overlap at the second instant; all before it is known, and the distances at those
    /// after it.
    fn pass(&mut self, part: &mut PartDistance, found: &mut Findings, [before, now]: [Instant; 2], later: &[Instant]) {
        match part.open {
            None if now.distance < -RESOLUTION => {
                let from = self.touch([self.interval.span[0], now.time]);
                part.open = Some(found.overlaps.len());
                let span = [self.start + from, self.start + now.time];
                let depth = later.iter().fold(-now.distance, |depth, instant| depth.max(-instant.distance));
                found.overlaps.push(PairOverlap { pair: part.pair, span, depth });
            }
            None => {}
            Some(open) => {
                let overlap = &mut found.overlaps[open];
                overlap.span[1] = self.start + now.time;
                if now.distance > 0.0 {
                    part.open = None;
                    overlap.span[1] = self.start + self.crossing([before.time, now.time]);
                }
            }
        }
    }

    /// The last time before the second one, not before the first, at which the parts touch: they overlap at the second.
    fn touch(&mut self, [earliest, overlapping]: [f64; 2]) -> f64 {
        let mut step = SHORTEST;
        let mut late = overlapping;
        loop {
            let early = (overlapping - step).max(earliest);
            if self.at(early).distance > 0.0 {
                return self.crossing([late, early]);
            }
            if early <= earliest {
                return earliest;
            }
            (late, step) = (early, 2.0 * step);
        }
    }

    /// A time at which the distance changes its sign: 0 or below at the first time, above at the second. By bisection.
    fn crossing(&mut self, [mut inside, mut outside]: [f64; 2]) -> f64 {
        while (outside - inside).abs() > SHORTEST {
            let middle = inside + 0.5 * (outside - inside);
            if self.at(middle).distance > 0.0 { outside = middle } else { inside = middle }
        }
        inside
    }
}
