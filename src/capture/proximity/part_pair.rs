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
        let (sin, cos) = turned_by;
        Instant {
            time,
            distance,
            normals: [normal, turned(normal, (-sin, cos))],
            gap: [nx * bx + ny * by, nx * rate_x + ny * rate_y + turn * (nx * by - ny * bx)],
            turns: [omega - turn, other_omega - turn],
            turn,
            apart: bx.abs() + by.abs() + self.parts[0].reach + self.parts[1].reach,
        }
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

    /// Whether the distance is at least so large between two instants, as far as the bounds of the motion show.
    pub(in crate::capture) fn is_above(&self, left: &Instant, right: &Instant, level: f64) -> bool {
        // it falls from both by the speed at most
        let by_speed = 0.5 * (left.distance + right.distance - self.speed * (right.time - left.time));
        let half = 0.5 * (right.time - left.time);
        by_speed >= level || (self.bound(left, half) >= level && self.bound(right, -half) >= level)
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
