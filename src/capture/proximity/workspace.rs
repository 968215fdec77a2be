//! Buffers for the states and bounds of all frames over intervals of a path.

use super::convex::PlacedPart;
use super::motion::{FrameKinematics, FramePair, FrameState, MotionBound};
use super::part_pair::{Instant, PartPair};
use crate::simulate::path::PathPart;

/// Places for instants whose states are kept: pairs of bodies are looked at one after the other, at the same times. A power
/// of two.
const PLACES: usize = 64;

/// The states of all frames at a time, s.
#[derive(Default)]
struct KnownInstant {
    time: f64,
    /// The interval that it is of.
    interval: u64,
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
    /// Each where its time has its place.
    instants: Vec<KnownInstant>,
    /// Counts the intervals.
    interval: u64,
    placed: PlacedPart,
}

/// The place of a time, by the highest bits of a product (Fibonacci hashing, Knuth 1998, section 6.4).
fn place(time: f64) -> usize {
    let product = time.to_bits().wrapping_mul(0x9E37_79B9_7F4A_7C15);
    usize::try_from(product >> (u64::BITS - PLACES.ilog2())).unwrap_or_default()
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
    /// that carries both.
    pub(super) fn states(
        &mut self,
        motions: &FrameKinematics<'_>,
        part: &impl PathPart,
        pair: FramePair,
        time: f64,
    ) -> [FrameState; 2] {
        if self.instants.is_empty() {
            self.instants.resize_with(PLACES, KnownInstant::default);
        }
        let known = &mut self.instants[place(time)];
        if known.interval != self.interval || known.time.to_bits() != time.to_bits() {
            (known.time, known.interval) = (time, self.interval);
            let [positions, rates] = &mut self.at;
            part.at(time, positions, rates);
            motions.states(time, &self.at, &mut known.states);
        }
        let states = &known.states;
        pair.frames.map(|frame| pair.carrier.map_or(states[frame], |by| states[frame].relative_to(&states[by])))
    }

    /// The bound of the motion of two frames over the interval.
    pub(in crate::capture) fn relative_bound(&self, motions: &FrameKinematics<'_>, pair: FramePair) -> RelativeBound {
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
        pair: FramePair,
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
        (frames, pair): (FramePair, &PartPair<'_>),
        time: f64,
    ) -> Instant {
        let states = self.states(motions, part, frames, time);
        pair.at(time, states, &mut self.placed)
    }
}
