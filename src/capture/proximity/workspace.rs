//! Buffers for the states and bounds of all frames over intervals of a path.

use super::convex::PlacedPart;
use super::motion::{FrameKinematics, FrameState, MotionBound};
use super::part_pair::{Instant, PartPair};
use crate::simulate::path::PathInterval;

/// Most instants whose states are kept: pairs of bodies are looked at one after the other, at the same times.
const MOST_KEPT: usize = 64;

/// Bounds over one interval, and states at instants within it.
#[derive(Default)]
pub(in crate::capture) struct PathWorkspace {
    coordinates: [Vec<f64>; 2],
    bounds: Vec<MotionBound>,
    /// Times and states of all frames, of which the first `kept` are of this interval.
    states: Vec<(f64, Vec<FrameState>)>,
    kept: usize,
    /// Where the next ones take the place of others.
    next: usize,
    placed: [PlacedPart; 2],
}

impl PathWorkspace {
    /// Computes the bounds over an interval.
    pub(in crate::capture) fn set_bounds(&mut self, motions: FrameKinematics<'_>, interval: &PathInterval<'_>) {
        for half in &mut self.coordinates {
            half.resize(interval.start[0].len(), 0.0);
        }
        motions.bounds(interval, &mut self.coordinates, &mut self.bounds);
        (self.kept, self.next) = (0, 0);
    }

    /// Index of the states at a time within the interval whose bounds were computed.
    fn states_at(&mut self, motions: FrameKinematics<'_>, interval: &PathInterval<'_>, time: f64) -> usize {
        let known = self.states[..self.kept].iter().position(|(other, _)| other.to_bits() == time.to_bits());
        known.unwrap_or_else(|| {
            let place = self.next;
            if place == self.states.len() {
                self.states.push((time, Vec::new()));
            }
            let (at, states) = &mut self.states[place];
            *at = time;
            motions.at(interval, time, &mut self.coordinates, states);
            (self.kept, self.next) = (self.kept.max(place + 1), (place + 1) % MOST_KEPT);
            place
        })
    }

    /// Bound of the relative speed of points up to these distances from the origins of two frames, m/s.
    pub(in crate::capture) fn speed(&self, frames: [usize; 2], [a, b]: [f64; 2]) -> f64 {
        self.bounds[frames[0]].speed_within(a) + self.bounds[frames[1]].speed_within(b)
    }

    /// As [`speed`](Self::speed), of the acceleration, m/s².
    pub(in crate::capture) fn acceleration(&self, frames: [usize; 2], [a, b]: [f64; 2]) -> f64 {
        self.bounds[frames[0]].acceleration_within(a) + self.bounds[frames[1]].acceleration_within(b)
    }

    /// Distance of the origins of two frames at a time within the interval, m.
    pub(in crate::capture) fn origin_distance(
        &mut self,
        motions: FrameKinematics<'_>,
        interval: &PathInterval<'_>,
        frames: [usize; 2],
        time: f64,
    ) -> f64 {
        let at = self.states_at(motions, interval, time);
        let [[_, ax, ay], [_, bx, by]] = frames.map(|frame| self.states[at].1[frame].pose);
        libm::hypot(ax - bx, ay - by)
    }

    /// Two parts of bodies with these frames at a time within the interval.
    pub(in crate::capture) fn instant(
        &mut self,
        motions: FrameKinematics<'_>,
        interval: &PathInterval<'_>,
        (frames, pair): ([usize; 2], &PartPair<'_>),
        time: f64,
    ) -> Instant {
        let at = self.states_at(motions, interval, time);
        pair.at(time, frames.map(|frame| self.states[at].1[frame]), &mut self.placed)
    }
}
