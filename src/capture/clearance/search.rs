//! The search for the least distance and the overlaps of two convex parts over an interval of a path, by branch and
//! bound.

use super::bodies::BodyPair;
use crate::capture::proximity::motion::{FrameKinematics, FramePair};
use crate::capture::proximity::part_pair::{Instant, PartPair, SHORTEST};
use crate::capture::proximity::workspace::PathWorkspace;
use crate::simulate::path::{PathPart, PathWindow};
use crate::simulate::root::root_by_rates;
use std::convert::Infallible;

/// A lower least distance than the one found may be missed by this, m; shallower overlaps are none.
const RESOLUTION: f64 = 1e-6;

/// Distances that differ by less are equal, m: the time of the least is the first of them. Bodies that rest relative to each other
/// are at distances that differ by rounding.
const EQUAL: f64 = 1e-9;

/// Parts that separate by less than this, m, or by less than the smaller one is long, may overlap on: to look for smaller gaps in
/// an overlap would cost more than the rest.
const GAP: f64 = 1e-2;
/// Smaller gaps are not looked for between parts that are smaller, m.
const SMALLEST_GAP: f64 = 1e-4;

/// Time for which the most distances are meant, s; longer cases may have more in proportion.
const BUDGETED: f64 = 100.0;

/// Instants of a window that are kept together, so that memory does not grow with their number; few where this is tested.
const MOST_INSTANTS: usize = if cfg!(test) { 16 } else { 1 << 14 };

/// Two convex parts, and what is known of them.
#[derive(Clone)]
pub(super) struct PartDistance {
    pub(super) pair: usize,
    /// Indices of the parts.
    pub(super) parts: [usize; 2],
    /// Lower bound of the distance at the end of the last interval, m.
    pub(super) lower: f64,
    /// The end of the last interval that was looked at, in the time of the phase.
    pub(super) last: Option<Instant>,
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

    /// The distance above which nothing about a pair is of interest, whose parts do not overlap.
    pub(super) fn goal(&self, pair: &BodyPair) -> f64 {
        self.least[pair.group].map_or(f64::INFINITY, |(distance, ..)| distance - RESOLUTION).max(-RESOLUTION)
    }

    /// Whether more distances were computed by a time, s, than are allowed until then.
    #[allow(clippy::cast_precision_loss, reason = "a limit")]
    fn are_used_up(&self, time: f64) -> bool {
        self.evaluations as f64 > self.max_evaluations as f64 * (time / BUDGETED).max(1.0)
    }

    fn record(&mut self, pair: (usize, &BodyPair), instant: &Instant, start: f64) {
        self.evaluations += 1;
        let (index, BodyPair { group, .. }) = pair;
        self.of_pairs[index] += 1;
        let least = &mut self.least[*group];
        if least.is_none_or(|(least, ..)| instant.distance < least - EQUAL) {
            *least = Some((instant.distance, start + instant.time, index));
        }
    }
}

/// Two parts over a window of the path.
pub(super) struct WindowSearch<'a> {
    pub(super) shapes: PartPair<'a>,
    /// Of their bodies.
    pub(super) frames: &'a FramePair,
    pub(super) motions: &'a FrameKinematics<'a>,
    pub(super) window: PathWindow<'a>,
    /// Of the phase, s.
    pub(super) start: f64,
    pub(super) workspace: &'a mut PathWorkspace,
    /// Memory for instants, and for those to the right of one, the nearest last.
    pub(super) instants: &'a mut [Vec<Instant>; 2],
}

impl WindowSearch<'_> {
    /// Computes the distance at both ends, and between them wherever it may be below the goal; where the parts overlap,
    /// wherever there may be a gap, and the largest depth.
    ///
    /// # Errors
    /// The time at which the distances are used up, since the start of the approach, s.
    pub(super) fn run(&mut self, part: &mut PartDistance, pair: &BodyPair, found: &mut Findings) -> Result<(), f64> {
        let known = (part.pair, pair);
        let [first, last] = self.window.span();
        let before = part.last.filter(|instant| instant.time.to_bits() == first.to_bits());
        let mut left = before.map_or_else(|| self.record_at(first, known, found), Ok)?;
        let end = self.record_at(last, known, found)?;
        let [first, second] = self.shapes.parts;
        let gap = first.size.min(second.size).clamp(SMALLEST_GAP, GAP);
        let [mut instants, mut rights] = std::mem::take(self.instants);
        instants.clear();
        instants.push(left);
        rights.push(end);
        while let Some(right) = rights.last() {
            let doubt = if left.distance.min(right.distance) < -RESOLUTION {
                self.shapes.doubt_below(&left, right, gap)
            } else {
                self.shapes.doubt(&left, right, found.goal(pair))
            };
            if let Some([from, to]) = doubt {
                rights.push(self.record_at(f64::midpoint(from, to), known, found)?);
                continue;
            }
            left = *right;
            instants.push(left);
            rights.pop();
            if instants.len() == MOST_INSTANTS {
                self.take(&instants, part, known, found)?;
                instants.drain(..MOST_INSTANTS - 1);
            }
        }
        (part.lower, part.last) = (end.distance, Some(end));
        self.take(&instants, part, known, found)?;
        *self.instants = [instants, rights];
        Ok(())
    }

    /// Begins and ends overlaps at instants in their order, of which the first is the last one before, and finds their depths
    /// there.
    fn take(
        &mut self,
        instants: &[Instant],
        part: &mut PartDistance,
        known: (usize, &BodyPair),
        found: &mut Findings,
    ) -> Result<(), f64> {
        let mut begins = 0;
        for (i, now) in instants.iter().enumerate() {
            let before = i.saturating_sub(1);
            match part.open {
                None if now.distance < -RESOLUTION => {
                    begins = before;
                    let touch = self.touch([&instants[before], now], known, found)?;
                    let span = [touch, now.time].map(|time| self.start + time);
                    part.open = Some(found.overlaps.len());
                    found.overlaps.push(PairOverlap { pair: part.pair, span, depth: -now.distance });
                }
                Some(open) if now.distance > 0.0 => {
                    self.deepen(open, known, found, &instants[begins..=i])?;
                    let end = self.crossing([now, &instants[before]], known, found)?;
                    found.overlaps[open].span[1] = self.start + end;
                    part.open = None;
                }
                _ => {}
            }
        }
        if let Some(open) = part.open {
            self.deepen(open, known, found, &instants[begins..])?;
            found.overlaps[open].span[1] = self.start + instants[instants.len() - 1].time;
        }
        Ok(())
    }

    /// Finds the largest depth of an overlap between instants.
    fn deepen(
        &mut self,
        overlap: usize,
        pair: (usize, &BodyPair),
        found: &mut Findings,
        instants: &[Instant],
    ) -> Result<(), f64> {
        let least = |depth: f64, instant: &Instant| depth.max(-instant.distance);
        let mut depth = instants.iter().fold(found.overlaps[overlap].depth, least);
        for ends in instants.windows(2) {
            self.divide([ends[0], ends[1]], -depth - RESOLUTION, pair, found, |middle| {
                depth = least(depth, middle);
                Some(-depth - RESOLUTION)
            })?;
        }
        found.overlaps[overlap].depth = depth;
        Ok(())
    }

    /// Looks at instants between two, in their order, wherever the distance may be below a level; `visit` returns the next
    /// level after each, or `None` to end.
    fn divide(
        &mut self,
        [mut left, mut right]: [Instant; 2],
        mut level: f64,
        pair: (usize, &BodyPair),
        found: &mut Findings,
        mut visit: impl FnMut(&Instant) -> Option<f64>,
    ) -> Result<(), f64> {
        // beyond the right one, the nearest last
        let mut rights = Vec::new();
        loop {
            if let Some([from, to]) = self.shapes.doubt(&left, &right, level) {
                let middle = self.record_at(f64::midpoint(from, to), pair, found)?;
                let Some(next) = visit(&middle) else { return Ok(()) };
                level = next;
                rights.push(right);
                right = middle;
            } else {
                left = right;
                let Some(next) = rights.pop() else { return Ok(()) };
                right = next;
            }
        }
    }

    fn record_at(&mut self, time: f64, pair: (usize, &BodyPair), found: &mut Findings) -> Result<Instant, f64> {
        let instant = self.at(time);
        found.record(pair, &instant, self.start);
        if found.are_used_up(self.start + time) { Err(self.start + time) } else { Ok(instant) }
    }

    fn at(&mut self, time: f64) -> Instant {
        self.workspace.instant(self.motions, &self.window, (self.frames, &self.shapes), time)
    }

    /// The time at which the parts touch before they overlap at an instant; nothing is known of the times before an
    /// earlier instant at which they do.
    fn touch(
        &mut self,
        [before, now]: [&Instant; 2],
        pair: (usize, &BodyPair),
        found: &mut Findings,
    ) -> Result<f64, f64> {
        if before.distance > 0.0 {
            return self.crossing([before, now], pair, found);
        }
        let earliest = self.window.span()[0];
        let mut step = SHORTEST;
        let mut late = *now;
        loop {
            let early = self.at((now.time - step).max(earliest));
            if early.distance > 0.0 {
                return self.crossing([&early, &late], pair, found);
            }
            if early.time <= earliest {
                return Ok(earliest);
            }
            (late, step) = (early, 2.0 * step);
        }
    }

    /// The time nearest to an instant outside at which the parts begin to overlap, before or after one at which they do: in
    /// between they may separate and overlap again.
    fn crossing(
        &mut self,
        [outside, inside]: [&Instant; 2],
        pair: (usize, &BodyPair),
        found: &mut Findings,
    ) -> Result<f64, f64> {
        let mut inside = *inside;
        loop {
            let ends = [outside, &inside];
            let (times, distances) = (ends.map(|at| at.time), ends.map(|at| self.shapes.distance_and_rate(at)));
            let distance = |time| {
                let instant = self.at(time);
                Ok::<_, Infallible>(self.shapes.distance_and_rate(&instant))
            };
            let Ok(time) = root_by_rates(times, distances, SHORTEST, distance);
            let touch = self.at(time);
            let between = if outside.time < time { [*outside, touch] } else { [touch, *outside] };
            let mut nearer = None;
            self.divide(between, -RESOLUTION, pair, found, |middle| {
                nearer = (middle.distance < -RESOLUTION).then_some(*middle);
                nearer.is_none().then_some(-RESOLUTION)
            })?;
            match nearer {
                Some(nearer) => inside = nearer,
                None => return Ok(time),
            }
        }
    }
}

#[cfg(test)]
mod tests;
