//! Two convex parts at one instant, a lower bound of their distance about it, and their first contact in an interval.

use super::convex::{ConvexPart, PlacedPart, Separation, separation};
use super::motion::FrameState;
use crate::error::Error;

/// Longest interval that need not be divided, s.
pub(in crate::capture) const SHORTEST: f64 = 1e-9;

/// Parts that move by less than this, m, need no instant between: what fast ones pass in the interval is no deeper.
const NEAREST: f64 = 1e-9;

/// Most divisions of one step.
const MAX_DIVISIONS: u32 = 1_000_000;

/// Two parts at one instant.
#[derive(Clone, Copy, Debug)]
pub(in crate::capture) struct Instant {
    pub(in crate::capture) time: f64,
    /// Signed distance, m.
    pub(in crate::capture) distance: f64,
    normal: [f64; 2],
    /// The part with whose body the normal turns.
    edge_of: Option<usize>,
    states: [FrameState; 2],
}

/// Two convex parts of two bodies.
pub(in crate::capture) struct PartPair<'a> {
    pub(in crate::capture) parts: [&'a ConvexPart; 2],
    /// Bound of the relative speed of their points over the interval, m/s.
    pub(in crate::capture) speed: f64,
    /// Bound of the relative acceleration of their points over the interval, m/s².
    pub(in crate::capture) acceleration: f64,
}

impl PartPair<'_> {
    /// The separation at one instant; `placed` is working space, for the second part in the frame of the first.
    pub(in crate::capture) fn at(&self, time: f64, states: [FrameState; 2], placed: &mut PlacedPart) -> Instant {
        let [first, second] = &states;
        let ([_, x, y], [_, ox, oy]) = (first.pose, second.pose);
        placed.place(self.parts[1], first.seen([ox - x, oy - y]), first.turn_to(second));
        let Separation { distance, normal, edge_of } = separation(self.parts[0], placed);
        Instant { time, distance, normal: first.rotated(normal), edge_of, states }
    }

    /// The corners of a part in inertial axes from the position of a frame.
    fn corners<'a>(
        &'a self,
        part: usize,
        state: &'a FrameState,
        [_, x, y]: [f64; 3],
    ) -> impl Iterator<Item = [f64; 2]> + 'a {
        let [_, ox, oy] = state.pose;
        let at = move |corner: &[f64; 2]| {
            let [dx, dy] = state.rotated(*corner);
            [ox - x + dx, oy - y + dy]
        };
        self.parts[part].corners.iter().map(at)
    }

    /// Whether an interval between two times is too short to be divided: for the motion, or for digits of the time.
    pub(in crate::capture) fn is_shortest(&self, [start, end]: [f64; 2]) -> bool {
        let shortest = SHORTEST.min(NEAREST / self.speed);
        end - start <= shortest.max(4.0 * f64::EPSILON * end.abs())
    }

    /// A lower bound of the distance `after` s (or before, where negative) the instant.
    ///
    /// The distance is at least the gap of the projections on any direction n: here the normal of this instant, along which
    /// the gap is the distance now. That of an edge turns on with the rate ω of the edge's body, ṅ = ω × n, or the bound
    /// would be wrong in first order. For corners of both parts a distance d apart `d²/dt² (n · d) = n · d̈ + 2 ṅ · ḋ − ω² n · d`;
    /// with the bounds a, v of acceleration and speed the gap changes by ½ (a + 2 |ω| v + ω² (|d| + v |t|)) t² at most beside
    /// its rate. So the bound is concave in the time, and between two times it is at least the smaller of its values there.
    pub(in crate::capture) fn bound(&self, instant: &Instant, after: f64) -> f64 {
        let [nx, ny] = instant.normal;
        let origin = instant.states[0].pose;
        let turn = instant.edge_of.map_or(0.0, |part| instant.states[part].twist[0]);
        let mut apart = 0.0;
        let mut ends = [0.0; 2];
        for (part, end) in ends.iter_mut().enumerate() {
            let state = &instant.states[part];
            let ([_, ox, oy], [omega, vx, vy]) = (state.pose, state.twist);
            let (ox, oy) = (ox - origin[1], oy - origin[2]);
            // of the first part the end along the normal, of the second one the start
            let sign = if part == 0 { 1.0 } else { -1.0 };
            let (mut farthest, mut largest) = (0.0_f64, f64::NEG_INFINITY);
            for [x, y] in self.corners(part, state, origin) {
                let rate = nx * (vx - omega * (y - oy)) + ny * (vy + omega * (x - ox)) + turn * (nx * y - ny * x);
                largest = largest.max(sign * (nx * x + ny * y + after * rate));
                farthest = farthest.max(x.abs() + y.abs());
            }
            *end = largest + self.parts[part].radius;
            apart += farthest;
        }
        let turn = turn.abs();
        let turning = turn * (2.0 * self.speed + turn * (apart + self.speed * after.abs()));
        -ends[0] - ends[1] - 0.5 * (self.acceleration + turning) * after * after
    }

    /// A lower bound of the distance between two instants, at which it may be lower.
    fn lowest(&self, left: &Instant, right: &Instant) -> f64 {
        let half = 0.5 * (right.time - left.time);
        self.bound(left, half).min(self.bound(right, -half))
    }

    /// Whether the distance is at least so large between two instants, as far as the bounds of the motion show.
    pub(in crate::capture) fn is_above(&self, left: &Instant, right: &Instant, level: f64) -> bool {
        // it falls from both by the speed at most
        let by_speed = 0.5 * (left.distance + right.distance - self.speed * (right.time - left.time));
        by_speed >= level || self.lowest(left, right) >= level
    }

    /// Times in the interval between which the distance falls from above `-depth` to below it, for the first time;
    /// `None` where it does not, as the bounds of the motion show. The distance is above `-depth` at the start.
    ///
    /// # Errors
    /// [`Error::NotConverged`] for parts that move too fast.
    pub(in crate::capture) fn first_contact(
        &self,
        [start, end]: [f64; 2],
        depth: f64,
        mut instant_at: impl FnMut(&Self, f64) -> Instant,
    ) -> Result<Option<[f64; 2]>, Error> {
        let mut divisions = 0;
        let mut left = instant_at(self, start);
        // the instants to the right, the nearest last
        let mut rights = vec![instant_at(self, end)];
        while let Some(right) = rights.last() {
            let half = 0.5 * (right.time - left.time);
            if !self.is_above(&left, right, -depth) && !self.is_shortest([left.time, right.time]) {
                if divisions == MAX_DIVISIONS {
                    let (what, change) = ("bounds of the distance between an end effector and its target", half);
                    return Err(Error::NotConverged { what, iterations: divisions, change });
                }
                divisions += 1;
                rights.push(instant_at(self, left.time + half));
                continue;
            }
            if right.distance < -depth {
                return Ok(Some([left.time, right.time]));
            }
            left = *right;
            rights.pop();
        }
        Ok(None)
    }
}
