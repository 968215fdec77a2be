//! Poses, twists and bounds of the motion of all frames over an interval of a path.

use crate::capture::assembly::{TargetPlacement, turned};
use crate::capture::target_motion::TargetMotion;
use crate::frames::{Frame, FrameMotion};
use crate::scalar::Scalar;
use crate::simulate::path::PathPart;
use crate::simulate::system::Body;

/// The motion of all frames during a phase.
#[derive(Clone, Copy)]
pub(in crate::capture) struct FrameKinematics<'a> {
    pub(in crate::capture) frames: &'a [Frame],
    pub(in crate::capture) targets: TargetMotion<'a>,
    /// Number of joints.
    pub(in crate::capture) joints: usize,
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

    fn carried(&self, [angle, x, y]: [f64; 3], rate: f64) -> Self {
        let ([yaw, ox, oy], [omega, vx, vy]) = (self.pose, self.twist);
        let [dx, dy] = self.rotated([x, y]);
        let (pose, twist) = ([yaw + angle, ox + dx, oy + dy], [omega + rate, vx - omega * dy, vy + omega * dx]);
        if angle == 0.0 { Self { pose, twist, ..*self } } else { Self::new(pose, twist) }
    }
}

impl FrameKinematics<'_> {
    /// The state of a frame where the coordinates and their rates are these; it is added to the `states` that are known, with
    /// those of the frames that carry it.
    pub(in crate::capture) fn state(
        &self,
        index: usize,
        time: f64,
        coordinates: &[Vec<f64>; 2],
        states: &mut [Option<FrameState>],
    ) -> FrameState {
        if let Some(known) = states[index] {
            return known;
        }
        let [positions, rates] = coordinates;
        let three = |values: &[f64], i: usize| [values[i], values[i + 1], values[i + 2]];
        let body = |i: usize| FrameState::new(three(positions, i), three(rates, i));
        let frame = &self.frames[index];
        let mut carried = |by: Option<usize>, pose, rate| {
            by.map_or(FrameState::INERTIAL, |by| self.state(by, time, coordinates, states)).carried(pose, rate)
        };
        let state = match frame.motion {
            FrameMotion::Base => body(0),
            FrameMotion::Joint(joint) => {
                let [angle, x, y] = frame.pose;
                carried(frame.parent, [angle + positions[3 + joint], x, y], rates[3 + joint])
            }
            FrameMotion::Fixed => carried(frame.parent, frame.pose, 0.0),
            FrameMotion::Target(target) => match self.targets {
                TargetMotion::Free(bodies) => {
                    let Body { pose, twist, .. } = bodies[target].after(time);
                    FrameState::new(pose, twist)
                }
                TargetMotion::Assembled(assembly, _) => match assembly.places[target] {
                    TargetPlacement::Separate(i) => body(3 + self.joints + 3 * i),
                    TargetPlacement::Merged { arm, offset: [x, y], yaw } => {
                        carried(Some(self.end_effector(index, arm)), [yaw, x, y], 0.0)
                    }
                },
            },
        };
        states[index] = Some(state);
        state
    }

    /// Bounds of the motion of all frames over the interval, relative to the base's velocity at its start.
    pub(in crate::capture) fn bounds(
        &self,
        part: &impl PathPart,
        coordinates: &mut [Vec<f64>; 2],
        bounds: &mut Vec<MotionBound>,
    ) {
        let [rates, accelerations] = coordinates;
        // all bodies move together in an orbit
        let [bx, by] = velocity_of_base(part);
        let reference = |i: usize| {
            // of a pose: that of the base before the joints, or that of a body after them
            let component = i.checked_sub(3 + self.joints).map_or(i, |of_bodies| of_bodies % 3);
            [0.0, bx, by].get(component).copied().unwrap_or(0.0)
        };
        part.bounds(reference, rates, accelerations);
        let body = |i: usize| MotionBound::of_body(&rates[i..i + 3], &accelerations[i..i + 3]);
        bounds.clear();
        for (k, frame) in self.frames.iter().enumerate() {
            let distance = libm::hypot(frame.pose[1], frame.pose[2]);
            let parent = frame.parent.map_or_else(MotionBound::default, |parent| bounds[parent]);
            let bound = match frame.motion {
                FrameMotion::Base => body(0),
                FrameMotion::Joint(joint) => parent.carried(distance, [rates[3 + joint], accelerations[3 + joint]]),
                FrameMotion::Fixed => parent.carried(distance, [0.0; 2]),
                FrameMotion::Target(target) => match self.targets {
                    TargetMotion::Free(bodies) => {
                        let [omega, vx, vy] = bodies[target].twist;
                        let speed = libm::hypot(vx - bx, vy - by);
                        MotionBound { yaw_rate: omega.abs(), speed, ..MotionBound::default() }
                    }
                    TargetMotion::Assembled(assembly, _) => match assembly.places[target] {
                        TargetPlacement::Separate(i) => body(3 + self.joints + 3 * i),
                        TargetPlacement::Merged { arm, offset: [x, y], .. } => {
                            bounds[self.end_effector(k, arm)].carried(libm::hypot(x, y), [0.0; 2])
                        }
                    },
                },
            };
            bounds.push(bound);
        }
    }

    /// Index of the frame of an arm's end effector, which comes before those of the targets.
    fn end_effector(&self, before: usize, arm: usize) -> usize {
        let is_end = |frame: &Frame| frame.arm == Some(arm) && frame.motion == FrameMotion::Fixed;
        self.frames[..before].iter().position(is_end).expect("every arm has an end effector")
    }
}
