//! Buffers for the states and bounds of all frames over intervals of a path.

use super::motion::{FrameKinematics, FrameState, MotionBound};
use super::part_pair::{Instant, PartPair};
use crate::simulate::path::PathInterval;

/// Bounds over one interval, and states at one instant.
#[derive(Default)]
pub(in crate::capture) struct PathWorkspace {
    coordinates: [Vec<f64>; 2],
    bounds: Vec<MotionBound>,
    states: Vec<FrameState>,
}

impl PathWorkspace {
    /// Computes the bounds over an interval.
    pub(in crate::capture) fn set_bounds(&mut self, motions: FrameKinematics<'_>, interval: &PathInterval<'_>) {
        for half in &mut self.coordinates {
            half.resize(interval.start[0].len(), 0.0);
        }
        motions.bounds(interval, &mut self.coordinates, &mut self.bounds);
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
        motions.at(interval, time, &mut self.coordinates, &mut self.states);
        let [[_, ax, ay], [_, bx, by]] = frames.map(|frame| self.states[frame].pose);
        (ax - bx).hypot(ay - by)
    }

    /// Two parts of bodies with these frames at a time within the interval.
    pub(in crate::capture) fn instant(
        &mut self,
        motions: FrameKinematics<'_>,
        interval: &PathInterval<'_>,
        (frames, pair): ([usize; 2], &PartPair<'_>),
        time: f64,
    ) -> Instant {
        motions.at(interval, time, &mut self.coordinates, &mut self.states);
        pair.at(time, frames.map(|frame| self.states[frame]))
    }
}
