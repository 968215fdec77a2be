//! Buffers for the states and bounds of all frames over intervals of a path.

use super::convex::PlacedPart;
use super::motion::{FrameKinematics, FramePair, FrameState, MotionBound};
use super::part_pair::{Instant, PartPair};
use crate::simulate::path::PathPart;

/// The states of frames at a time, s.
#[derive(Default)]
struct KnownInstant {
    time: f64,
    /// The interval that it is of.
    interval: u64,
    /// Between which two frames they are known, in that which carries both; `None` for all frames.
    between: Option<[usize; 2]>,
    states: Vec<FrameState>,
}

/// Bounds over one interval of the motion of two frames in that which carries both.
pub(in crate::capture) struct RelativeBound([MotionBound; 2]);

impl RelativeBound {
    /// Of the relative speed of points up to these distances from the origins of the frames, m/s.
    pub(in crate::capture) fn speed(&self, [a, b]: [f64; 2]) -> f64 {
        let [first, second] = &self.0;
        first.speed_within(a) + second.speed_within(b)
    }

    /// As [`speed`](Self::speed), of the acceleration, m/s².
    pub(in crate::capture) fn acceleration(&self, [a, b]: [f64; 2]) -> f64 {
        let [first, second] = &self.0;
        first.acceleration_within(a) + second.acceleration_within(b)
    }
}

/// Bounds over one interval, and states at instants within it.
#[derive(Default)]
pub(in crate::capture) struct PathWorkspace {
    /// Rates of the motion that all bodies have in common.
    reference: Vec<f64>,
    /// Bounds of the rates less these, and of their derivatives.
    coordinates: [Vec<f64>; 2],
    bounds: Vec<MotionBound>,
    /// Positions and rates at an instant.
    at: [Vec<f64>; 2],
    /// At the start and the end of the interval, where all pairs are looked at, and the last one between them.
    instants: [KnownInstant; 3],
    /// Counts the intervals.
    interval: u64,
    placed: PlacedPart,
}

impl PathWorkspace {
    /// Computes the bounds over an interval.
    pub(in crate::capture) fn set_bounds(&mut self, motions: &FrameKinematics<'_>, part: &impl PathPart) {
        for half in self.coordinates.iter_mut().chain(&mut self.at) {
            half.resize(part.first_rates().len(), 0.0);
        }
        motions.bounds(part, &mut self.reference, &mut self.coordinates, &mut self.bounds);
        self.interval += 1;
    }

    /// The states of two frames at a time within the interval whose bounds were computed, with their twists in the frame
    /// that carries both; between its ends their poses, too.
    pub(super) fn states(
        &mut self,
        motions: &FrameKinematics<'_>,
        part: &impl PathPart,
        pair: &FramePair,
        time: f64,
    ) -> [FrameState; 2] {
        let end = part.span().iter().position(|end| end.to_bits() == time.to_bits());
        let between = end.is_none().then_some(pair.frames);
        let known = &mut self.instants[end.unwrap_or(2)];
        if (known.interval, known.time.to_bits(), known.between) != (self.interval, time.to_bits(), between) {
            (known.interval, known.time, known.between) = (self.interval, time, between);
            let [positions, rates] = &mut self.at;
            part.at(time, positions, rates);
            motions.states(time, &self.at, between.and(Some(pair)), &mut known.states);
        }
        let states = &known.states;
        let carrier = pair.carrier.filter(|_| between.is_none());
        pair.frames.map(|frame| carrier.map_or(states[frame], |by| states[frame].relative_to(&states[by])))
    }

    /// The bound of the motion of two frames over the interval.
    pub(in crate::capture) fn relative_bound(&self, motions: &FrameKinematics<'_>, pair: &FramePair) -> RelativeBound {
        let bound = |frame| {
            pair.carrier.map_or_else(|| self.bounds[frame], |by| motions.bound_in(by, frame, &self.coordinates))
        };
        RelativeBound(pair.frames.map(bound))
    }

    /// Distance of the origins of two frames at a time within the interval, m.
    pub(in crate::capture) fn origin_distance(
        &mut self,
        motions: &FrameKinematics<'_>,
        part: &impl PathPart,
        pair: &FramePair,
        time: f64,
    ) -> f64 {
        let [[_, ax, ay], [_, bx, by]] = self.states(motions, part, pair, time).map(|state| state.pose);
        libm::hypot(ax - bx, ay - by)
    }

    /// Two parts of bodies with these frames at a time within the interval.
    pub(in crate::capture) fn instant(
        &mut self,
        motions: &FrameKinematics<'_>,
        part: &impl PathPart,
        (frames, pair): (&FramePair, &PartPair<'_>),
        time: f64,
    ) -> Instant {
        let states = self.states(motions, part, frames, time);
        pair.at(time, states, &mut self.placed)
    }
}
