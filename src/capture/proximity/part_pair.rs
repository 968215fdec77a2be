//! Two convex parts at one instant, a lower bound of their distance about it, and their first contact in an interval.

use super::convex::{ConvexPart, PlacedPart, Separation, separation};
use super::motion::FrameState;
use crate::error::Error;
use crate::frames::turned;

/// Longest interval that need not be divided, s.
pub(in crate::capture) const SHORTEST: f64 = 1e-9;

/// Parts that move by less than this, m, need no instant between: what fast ones pass in the interval is no deeper.
const NEAREST: f64 = 1e-9;

/// Most divisions of one step.
const MAX_DIVISIONS: u32 = 1_000_000;

/// Two parts at one instant, and how the gap of their projections on the normal changes.
#[derive(Clone, Copy, Debug)]
pub(in crate::capture) struct Instant {
    pub(in crate::capture) time: f64,
    /// Signed distance, m.
    pub(in crate::capture) distance: f64,
    /// The normal from the first part to the second one, in the frame of each.
    normals: [[f64; 2]; 2],
    /// Of the origins of the frames along the normal, m, and its rate, m/s.
    gap: [f64; 2],
    /// How fast the parts turn against the normal, rad/s.
    turns: [f64; 2],
    /// How fast the normal turns, rad/s: with the body of the edge to which it belongs.
    turn: f64,
    /// Not less than the relative speed of any two points, m/s.
    speed: f64,
    /// More than the distance of a corner of the one from a corner of the other, m.
    apart: f64,
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
        let ([omega, vx, vy], [other_omega, ux, uy]) = (first.twist, second.twist);
        let (between, turned_by) = (first.seen([ox - x, oy - y]), first.turn_to(second));
        placed.place(self.parts[1], between, turned_by);
        let Separation { distance, normal, edge_of } = separation(self.parts[0], placed);
        let turn = edge_of.map_or(0.0, |part| [omega, other_omega][part]);
        let ([nx, ny], [bx, by]) = (normal, between);
        let [rate_x, rate_y] = first.seen([ux - vx, uy - vy]);
        let speed = (rate_x * rate_x + rate_y * rate_y).sqrt();
        let (sin, cos) = turned_by;
        Instant {
            time,
            distance,
            normals: [normal, turned(normal, (-sin, cos))],
            gap: [nx * bx + ny * by, nx * rate_x + ny * rate_y + turn * (nx * by - ny * bx)],
            turns: [omega - turn, other_omega - turn],
            turn,
            speed: speed + omega.abs() * self.parts[0].reach + other_omega.abs() * self.parts[1].reach,
            apart: bx.abs() + by.abs() + self.parts[0].reach + self.parts[1].reach,
        }
    }

    /// Signed distance, m, and its rate, m/s: where the nearest corners are several, that of one of them.
    pub(in crate::capture) fn distance_and_rate(&self, instant: &Instant) -> [f64; 2] {
        let Instant { distance, normals, gap: [_, rate], turns, .. } = *instant;
        let along = |part: usize, [x, y]: [f64; 2]| normals[part][0] * x + normals[part][1] * y;
        let farthest = |part: usize, sign: f64| {
            let corners = self.parts[part].corners.iter();
            corners.max_by(|a, b| (sign * along(part, **a)).total_cmp(&(sign * along(part, **b)))).copied()
        };
        let turning = |part: usize, [x, y]: [f64; 2]| turns[part] * (normals[part][1] * x - normals[part][0] * y);
        let [end, start] = [farthest(0, 1.0), farthest(1, -1.0)].map(Option::unwrap_or_default);
        [distance, rate + turning(1, start) - turning(0, end)]
    }

    /// Whether an interval between two times is too short to be divided: for the motion, or for digits of the time.
    fn is_shortest(&self, [start, end]: [f64; 2]) -> bool {
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
        let Instant { normals, gap: [gap, rate], turns, turn, apart, .. } = instant;
        let [first, second] = self.parts;
        // what n · d and its rate have of a corner, by its product with this vector in its own frame
        let [toward, from] = [0, 1].map(|part| {
            let ([nx, ny], turned) = (normals[part], after * turns[part]);
            [nx + turned * ny, ny - turned * nx]
        });
        let along = |[nx, ny]: [f64; 2], [x, y]: [f64; 2]| nx * x + ny * y;
        let end = first.corners.iter().fold(f64::NEG_INFINITY, |end, corner| end.max(along(toward, *corner)));
        let start = second.corners.iter().fold(f64::INFINITY, |start, corner| start.min(along(from, *corner)));
        let turn = turn.abs();
        let turning = turn * (2.0 * self.speed + turn * (apart + self.speed * after.abs()));
        gap + after * rate + start
            - end
            - first.radius
            - second.radius
            - 0.5 * (self.acceleration + turning) * after * after
    }

    /// Between which times of two instants the distance may be below a level; `None` where it is not, as the bounds of the
    /// motion show, or for too short a time to be divided.
    pub(in crate::capture) fn doubt(&self, left: &Instant, right: &Instant, level: f64) -> Option<[f64; 2]> {
        let length = right.time - left.time;
        let by_speed = [left, right].map(|instant| self.time_for(instant, instant.distance - level));
        if by_speed[0] + by_speed[1] >= length {
            return None;
        }
        let from = self.reach(left, length, level).max(by_speed[0]);
        if from + by_speed[1] >= length {
            return None;
        }
        let to = self.reach(right, -length, level).max(by_speed[1]);
        self.remainder(left, right, [from, to])
    }

    /// The same for times at which it may be above the level.
    pub(in crate::capture) fn doubt_below(&self, left: &Instant, right: &Instant, level: f64) -> Option<[f64; 2]> {
        self.remainder(left, right, [left, right].map(|instant| self.time_for(instant, level - instant.distance)))
    }

    /// What is left between two instants with these times after the one and before the other, s, if it can be divided.
    fn remainder(&self, left: &Instant, right: &Instant, [after, before]: [f64; 2]) -> Option<[f64; 2]> {
        let (from, to) = (left.time + after, right.time - before);
        (!self.is_shortest([from, to])).then_some([from, to])
    }

    /// For how long before and after an instant the distance does not change by more than this, m, as speed and acceleration
    /// show: v t + ½ a t² is that. Zero for changes that are not positive.
    fn time_for(&self, instant: &Instant, change: f64) -> f64 {
        let change = change.max(0.0);
        let by_acceleration =
            2.0 * change / (instant.speed + (instant.speed * instant.speed + 2.0 * self.acceleration * change).sqrt());
        // NaN, where nothing moves and nothing may change, is no time
        by_acceleration.max(change / self.speed).max(0.0)
    }

    /// For how long after an instant (or before it, where `after` is negative) the distance is at least so large, of so long
    /// at most, s, as the bound shows.
    fn reach(&self, instant: &Instant, after: f64, level: f64) -> f64 {
        let (above, end) = (instant.distance - level, self.bound(instant, after) - level);
        if above >= 0.0 && end >= 0.0 {
            return after.abs();
        }
        // NaN is above nothing
        if !(above > 0.0 && end < 0.0) {
            return 0.0;
        }
        // a concave bound is above its chords
        let zero_of_chord = |time: f64, value: f64| time + (after - time) * (value / (value - end));
        let time = zero_of_chord(0.0, above);
        zero_of_chord(time, (self.bound(instant, time) - level).max(0.0)).abs()
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
            if let Some([from, to]) = self.doubt(&left, right, -depth) {
                if divisions == MAX_DIVISIONS {
                    let (what, change) = ("bounds of the distance between an end effector and its target", to - from);
                    return Err(Error::NotConverged { what, iterations: divisions, change });
                }
                divisions += 1;
                rights.push(instant_at(self, f64::midpoint(from, to)));
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
