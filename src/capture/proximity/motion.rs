//! Poses, twists and bounds of the motion of all frames over an interval of a path.

use crate::capture::assembly::TargetPlacement;
use crate::capture::target_motion::TargetMotion;
use crate::frames::{Frame, FrameMotion, turned};
use crate::scalar::Scalar;
use crate::simulate::path::PathPart;
use crate::simulate::system::Body;
use multiversion::multiversion;

/// Where a frame is during a phase.
#[derive(Clone, Copy)]
enum Place<'a> {
    /// That of a body of the integrated vector, by the index of its first coordinate.
    Body(usize),
    /// That of a body that moves freely.
    Free(&'a Body),
    /// Carried by a frame that comes before it, or by the inertial one.
    Carried {
        by: Option<usize>,
        /// In the frame that carries it, where the angle of the joint is 0.
        pose: [f64; 3],
        /// Of its origin from that of the frame that carries it, m.
        distance: f64,
        joint: Option<usize>,
        /// Sine and cosine of the angle of `pose`.
        turn: (f64, f64),
    },
}

/// The motion of all frames during a phase.
pub(in crate::capture) struct FrameKinematics<'a> {
    places: Vec<Place<'a>>,
    all: FrameSet,
    /// Number of joints.
    joints: usize,
}

/// Some frames, each after the one that carries it.
#[derive(Clone)]
struct FrameSet {
    indices: Vec<usize>,
    /// Those whose yaw is not that of another one but for a constant.
    turning: Vec<usize>,
}

/// Two frames.
#[derive(Clone)]
pub(in crate::capture) struct FramePair {
    pub(in crate::capture) frames: [usize; 2],
    /// The last frame that carries both, or is one of them; `None` for the inertial one. How it moves is nothing to the
    /// distance of the two.
    pub(in crate::capture) carrier: Option<usize>,
    /// The two, and those that carry them, up to that which carries both.
    between: FrameSet,
}

/// Pose and twist of the origin of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::capture) struct FrameState {
    /// [yaw, x, y] in rad, m.
    pub(in crate::capture) pose: [f64; 3],
    /// [ω, vx, vy] in rad/s, m/s.
    pub(in crate::capture) twist: [f64; 3],
    /// Sine and cosine of the yaw.
    direction: (f64, f64),
}

/// Bounds of the motion of a frame over an interval.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::capture) struct MotionBound {
    /// Of the yaw rate, rad/s.
    pub(in crate::capture) yaw_rate: f64,
    /// Of the speed of the origin less the velocity of the base at the start of the interval, m/s.
    pub(in crate::capture) speed: f64,
    /// Of the yaw acceleration, rad/s².
    yaw_acceleration: f64,
    /// Of the acceleration of the origin, m/s².
    acceleration: f64,
}

/// [vx, vy] of the base at the start of an interval, m/s.
pub(super) fn velocity_of_base(part: &impl PathPart) -> [f64; 2] {
    let rates = part.first_rates();
    [rates[1], rates[2]]
}

/// Bounds of the rate and acceleration of a joint, of those of all coordinates; zeros without a joint.
fn turning(joint: Option<usize>, [rates, accelerations]: &[Vec<f64>; 2]) -> [f64; 2] {
    joint.map_or([0.0; 2], |joint| [rates[3 + joint], accelerations[3 + joint]])
}

impl FrameSet {
    fn new(places: &[Place<'_>], indices: Vec<usize>) -> Self {
        let is_turning = |index: &usize| !matches!(places[*index], Place::Carried { joint: None, .. });
        let turning = indices.iter().copied().filter(is_turning).collect();
        Self { indices, turning }
    }
}

impl MotionBound {
    /// Of the speed of points up to `reach` from the origin, less the velocity of the base at the start, m/s.
    pub(in crate::capture) fn speed_within(&self, reach: f64) -> f64 {
        self.speed + self.yaw_rate * reach
    }

    /// Of the acceleration of points up to `reach` from the origin, m/s².
    pub(in crate::capture) fn acceleration_within(&self, reach: f64) -> f64 {
        self.acceleration + (self.yaw_acceleration + self.yaw_rate * self.yaw_rate) * reach
    }

    /// Of a frame at a distance from the origin that turns relative to it.
    fn carried(&self, distance: f64, [rate, acceleration]: [f64; 2]) -> Self {
        Self {
            yaw_rate: self.yaw_rate + rate,
            yaw_acceleration: self.yaw_acceleration + acceleration,
            speed: self.speed_within(distance),
            acceleration: self.acceleration_within(distance),
        }
    }

    fn of_body(rates: &[f64], accelerations: &[f64]) -> Self {
        Self {
            yaw_rate: rates[0],
            speed: libm::hypot(rates[1], rates[2]),
            yaw_acceleration: accelerations[0],
            acceleration: libm::hypot(accelerations[1], accelerations[2]),
        }
    }
}

impl FrameState {
    /// Of the inertial frame.
    const INERTIAL: Self = Self { pose: [0.0; 3], twist: [0.0; 3], direction: (0.0, 1.0) };

    #[cfg(test)]
    pub(in crate::capture) fn new(pose: [f64; 3], twist: [f64; 3]) -> Self {
        Self { pose, twist, direction: Scalar::sin_cos(pose[0]) }
    }

    /// A point of the frame from its origin, in inertial axes.
    pub(in crate::capture) fn rotated(&self, point: [f64; 2]) -> [f64; 2] {
        turned(point, self.direction)
    }

    /// A vector in inertial axes, in those of the frame.
    pub(in crate::capture) fn seen(&self, vector: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = self.direction;
        turned(vector, (-sin, cos))
    }

    /// Sine and cosine of the angle from this frame to another.
    pub(in crate::capture) fn turn_to(&self, other: &Self) -> (f64, f64) {
        let (sin, cos) = other.direction;
        let [cos, sin] = self.seen([cos, sin]);
        (sin, cos)
    }

    /// Moves with another frame, in which the origin is at [x, y]; the yaw rate is known.
    #[inline]
    fn carry(&mut self, origin: [f64; 2], by: &Self) {
        let ([_, ox, oy], [omega, vx, vy]) = (by.pose, by.twist);
        let [dx, dy] = by.rotated(origin);
        (self.pose[1], self.pose[2]) = (ox + dx, oy + dy);
        (self.twist[1], self.twist[2]) = (vx - omega * dy, vy + omega * dx);
    }

    /// The same with the twist relative to another frame, which turns with it.
    pub(super) fn relative_to(&self, other: &Self) -> Self {
        let ([_, x, y], [_, ox, oy]) = (self.pose, other.pose);
        let ([omega, vx, vy], [turn, ux, uy]) = (self.twist, other.twist);
        let twist = [omega - turn, vx - ux + turn * (y - oy), vy - uy - turn * (x - ox)];
        Self { twist, ..*self }
    }
}

impl<'a> FrameKinematics<'a> {
    /// Of these frames, each of which comes after the one that carries it; targets move as given.
    pub(in crate::capture) fn new(frames: &[Frame], targets: TargetMotion<'a>) -> Self {
        let joints = frames.iter().filter(|frame| matches!(frame.motion, FrameMotion::Joint(_))).count();
        let carried = |by: Option<usize>, pose: [f64; 3], joint| {
            let distance = libm::hypot(pose[1], pose[2]);
            Place::Carried { by, pose, distance, joint, turn: Scalar::sin_cos(pose[0]) }
        };
        let place = |frame: &Frame| match frame.motion {
            FrameMotion::Base => Place::Body(0),
            FrameMotion::Joint(joint) => carried(frame.parent, frame.pose, Some(joint)),
            FrameMotion::Fixed => carried(frame.parent, frame.pose, None),
            FrameMotion::Target(target) => match targets {
                TargetMotion::Free(bodies) => Place::Free(&bodies[target]),
                TargetMotion::Assembled(assembly, _) => match assembly.places[target] {
                    TargetPlacement::Separate(i) => Place::Body(3 + joints + 3 * i),
                    TargetPlacement::Merged { arm, offset: [x, y], yaw } => {
                        let is_end = |frame: &Frame| frame.arm == Some(arm) && frame.motion == FrameMotion::Fixed;
                        carried(frames.iter().position(is_end), [yaw, x, y], None)
                    }
                },
            },
        };
        let places: Vec<_> = frames.iter().map(place).collect();
        let all = FrameSet::new(&places, (0..places.len()).collect());
        Self { places, all, joints }
    }

    /// Two frames, by their indices.
    pub(in crate::capture) fn pair(&self, frames: [usize; 2]) -> FramePair {
        let carrier_of = |frame: usize| match self.places[frame] {
            Place::Carried { by, .. } => by,
            Place::Body(_) | Place::Free(_) => None,
        };
        let [mut a, mut b] = frames.map(Some);
        let mut indices = Vec::new();
        while a != b {
            let later = if a > b { &mut a } else { &mut b };
            indices.extend(*later);
            *later = later.and_then(carrier_of);
        }
        indices.reverse();
        FramePair { frames, carrier: a, between: FrameSet::new(&self.places, indices) }
    }

    /// The states of all frames where the coordinates and their rates are these; of a pair those of its frames alone, in the
    /// frame that carries both.
    pub(super) fn states(
        &self,
        time: f64,
        coordinates: &[Vec<f64>; 2],
        pair: Option<&FramePair>,
        states: &mut Vec<FrameState>,
    ) {
        states.resize(self.places.len(), FrameState::INERTIAL);
        if let Some(carrier) = pair.and_then(|pair| pair.carrier) {
            states[carrier] = FrameState::INERTIAL;
        }
        states_of(&self.places, pair.map_or(&self.all, |pair| &pair.between), time, coordinates, states);
    }

    /// Bounds of the motion of all frames over the interval, relative to the base's velocity at its start; `coordinates`
    /// holds those of the rates and their derivatives afterwards, `reference` the rates of this motion of all.
    pub(in crate::capture) fn bounds(
        &self,
        part: &impl PathPart,
        reference: &mut Vec<f64>,
        coordinates: &mut [Vec<f64>; 2],
        bounds: &mut Vec<MotionBound>,
    ) {
        let [rates, accelerations] = &mut *coordinates;
        // all bodies move together in an orbit
        let [bx, by] = velocity_of_base(part);
        reference.clear();
        reference.resize(rates.len(), 0.0);
        // before the joints is the pose of the base, after them are those of bodies
        let (base, others) = reference.split_at_mut(3);
        for pose in std::iter::once(base).chain(others[self.joints..].chunks_exact_mut(3)) {
            pose.copy_from_slice(&[0.0, bx, by]);
        }
        part.bounds(reference, rates, accelerations);
        bounds.clear();
        for place in &self.places {
            let bound = match *place {
                Place::Body(i) => MotionBound::of_body(&coordinates[0][i..i + 3], &coordinates[1][i..i + 3]),
                Place::Free(Body { twist: [omega, vx, vy], .. }) => {
                    let speed = libm::hypot(vx - bx, vy - by);
                    MotionBound { yaw_rate: omega.abs(), speed, ..MotionBound::default() }
                }
                Place::Carried { by, distance, joint, .. } => {
                    let carrier = by.map_or_else(MotionBound::default, |by| bounds[by]);
                    carrier.carried(distance, turning(joint, coordinates))
                }
            };
            bounds.push(bound);
        }
    }

    /// The bound of the motion of a frame relative to one that carries it.
    pub(super) fn bound_in(&self, carrier: usize, frame: usize, coordinates: &[Vec<f64>; 2]) -> MotionBound {
        match self.places[frame] {
            Place::Carried { by: Some(by), distance, joint, .. } if frame != carrier => {
                self.bound_in(carrier, by, coordinates).carried(distance, turning(joint, coordinates))
            }
            _ => MotionBound::default(),
        }
    }
}

/// The states of some of the frames at these places.
#[multiversion(targets("x86_64+avx2"))]
fn states_of(
    places: &[Place<'_>],
    FrameSet { indices, turning }: &FrameSet,
    time: f64,
    [positions, rates]: &[Vec<f64>; 2],
    states: &mut [FrameState],
) {
    let three = |values: &[f64], i: usize| [values[i], values[i + 1], values[i + 2]];
    for index in indices {
        let (before, rest) = states.split_at_mut(*index);
        let state = &mut rest[0];
        match places[*index] {
            Place::Body(first) => (state.pose, state.twist) = (three(positions, first), three(rates, first)),
            Place::Free(body) => Body { pose: state.pose, twist: state.twist, .. } = body.after(time),
            Place::Carried { by, pose: [angle, ..], joint, .. } => {
                let carrier = by.map_or(&FrameState::INERTIAL, |by| &before[by]);
                let [angle, rate] =
                    joint.map_or([angle, 0.0], |joint| [angle + positions[3 + joint], rates[3 + joint]]);
                (state.pose[0], state.twist[0]) = (carrier.pose[0] + angle, carrier.twist[0] + rate);
            }
        }
    }
    for four in turning.chunks(4) {
        let mut yaws = [0.0; 4];
        yaws.iter_mut().zip(four).for_each(|(yaw, index)| *yaw = states[*index].pose[0]);
        let directions = Scalar::sin_cos_all(yaws);
        four.iter().zip(directions).for_each(|(index, direction)| states[*index].direction = direction);
    }
    for index in indices {
        if let Place::Carried { by, pose: [_, x, y], joint, turn: (sin, cos), .. } = places[*index] {
            let (before, rest) = states.split_at_mut(*index);
            let (carrier, state) = (by.map_or(&FrameState::INERTIAL, |by| &before[by]), &mut rest[0]);
            state.carry([x, y], carrier);
            if joint.is_none() {
                let [cos, sin] = carrier.rotated([cos, sin]);
                state.direction = (sin, cos);
            }
        }
    }
}
