//! Buffers for the states and bounds of all frames over intervals of a path.

use super::convex::PlacedPart;
use super::motion::{FrameKinematics, FrameState, MotionBound};
use super::part_pair::{Instant, PartPair};
use crate::simulate::path::PathPart;

/// Places for instants whose states are kept: pairs of bodies are looked at one after the other, at the same times. A power
/// of two.
const PLACES: usize = 64;

/// Coordinates and their rates at a time, s, and the states of the frames that were asked for.
#[derive(Default)]
struct KnownInstant {
    time: f64,
    /// The interval that it is of.
    interval: u64,
    coordinates: [Vec<f64>; 2],
    states: Vec<Option<FrameState>>,
}

/// Bounds over one interval, and states at instants within it.
#[derive(Default)]
pub(in crate::capture) struct PathWorkspace {
    coordinates: [Vec<f64>; 2],
    bounds: Vec<MotionBound>,
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
    pub(in crate::capture) fn set_bounds(&mut self, motions: FrameKinematics<'_>, part: &impl PathPart) {
        for half in &mut self.coordinates {
            half.resize(part.first_rates().len(), 0.0);
        }
        motions.bounds(part, &mut self.coordinates, &mut self.bounds);
        self.interval += 1;
    }

    /// The states of two frames at a time within the interval whose bounds were computed.
    fn states(
        &mut self,
        motions: FrameKinematics<'_>,
        part: &impl PathPart,
        frames: [usize; 2],
        time: f64,
    ) -> [FrameState; 2] {
        if self.instants.is_empty() {
            self.instants.resize_with(PLACES, KnownInstant::default);
        }
        let known = &mut self.instants[place(time)];
        if known.interval != self.interval || known.time.to_bits() != time.to_bits() {
            (known.time, known.interval) = (time, self.interval);
            let [positions, rates] = &mut known.coordinates;
            let size = part.first_rates().len();
            positions.resize(size, 0.0);
            rates.resize(size, 0.0);
            part.at(time, positions, rates);
            known.states.clear();
            known.states.resize(motions.frames.len(), None);
        }
        let KnownInstant { coordinates, states, .. } = known;
        frames.map(|frame| motions.state(frame, time, coordinates, states))
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
        part: &impl PathPart,
        frames: [usize; 2],
        time: f64,
    ) -> f64 {
        let [[_, ax, ay], [_, bx, by]] = self.states(motions, part, frames, time).map(|state| state.pose);
        libm::hypot(ax - bx, ay - by)
    }

    /// Two parts of bodies with these frames at a time within the interval.
    pub(in crate::capture) fn instant(
        &mut self,
        motions: FrameKinematics<'_>,
        part: &impl PathPart,
        (frames, pair): ([usize; 2], &PartPair<'_>),
        time: f64,
    ) -> Instant {
        let states = self.states(motions, part, frames, time);
        pair.at(time, states, &mut self.placed)
    }
}
