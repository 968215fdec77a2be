//! Frames and outlines of robot and targets: the one forward kinematics of figures, recordings and the report's page.
//!
//! `base` is in the inertial frame, `arms/ARM/link1`, …, `arms/ARM/end effector` are each in the one before,
//! `targets/TARGET` is in the inertial frame, at the target's COM.

mod body;

pub use body::{Body, Shape, base_size, bodies};
#[cfg(feature = "figures")]
pub(crate) use body::{base, outline};

use crate::layout::Layout;
use crate::owned::RobotState;
use crate::scenario::Scenario;

/// A frame of the tree. Its pose in its parent is fixed, but for a joint's angle, or the measured pose of a free body.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// As in recordings.
    pub name: String,
    /// Index of the parent; `None` for the inertial frame.
    pub parent: Option<usize>,
    /// [angle, x, y] in the parent, rad, m; zeros for a free body.
    pub pose: [f64; 3],
    /// What moves it.
    pub motion: Motion,
    /// The arm that it belongs to.
    pub arm: Option<usize>,
}

/// What moves a frame in its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    /// Nothing.
    Fixed,
    /// The angle of a joint, by its index.
    Joint(usize),
    /// The base is free.
    Base,
    /// A target is free, by its index.
    Target(usize),
}

/// The frames of a scenario's robot and targets; parents come before their children.
#[must_use]
pub fn frames(scenario: &Scenario) -> Vec<Frame> {
    let mut frames = robot_frames(&scenario.layout);
    frames.extend(scenario.targets.iter().enumerate().map(|(i, target)| Frame {
        name: format!("targets/{}", target.name),
        parent: None,
        pose: [0.0; 3],
        motion: Motion::Target(i),
        arm: None,
    }));
    frames
}

/// The frames of a robot: the base first, then each arm's links and its end effector.
#[must_use]
pub fn robot_frames(layout: &Layout) -> Vec<Frame> {
    let free = Frame { name: "base".to_owned(), parent: None, pose: [0.0; 3], motion: Motion::Base, arm: None };
    let mut frames = vec![free];
    let mut joint = 0;
    for (i, arm) in layout.arms.iter().enumerate() {
        let mut next = Frame {
            name: String::new(),
            parent: Some(0),
            pose: [arm.mount_angle, arm.mount[0], arm.mount[1]],
            motion: Motion::Fixed,
            arm: Some(i),
        };
        for (k, link) in arm.links.iter().enumerate() {
            let name = format!("arms/{}/link{}", arm.name, k + 1);
            frames.push(Frame { name, motion: Motion::Joint(joint), ..next.clone() });
            joint += 1;
            next = Frame { parent: Some(frames.len() - 1), pose: [0.0, link.length, 0.0], ..next };
        }
        frames.push(Frame { name: format!("arms/{}/tip", arm.name), ..next });
    }
    frames
}

impl Frame {
    /// [angle, x, y] in the parent; `targets` holds the poses of the targets.
    #[must_use]
    pub fn pose_in_parent(&self, state: &RobotState, targets: &[[f64; 3]]) -> [f64; 3] {
        let [angle, x, y] = self.pose;
        match self.motion {
            Motion::Fixed => self.pose,
            Motion::Joint(joint) => [angle + state.joint_angles[joint], x, y],
            Motion::Base => state.base_pose,
            Motion::Target(target) => targets[target],
        }
    }
}

/// [yaw, x, y] of every frame in the inertial frame.
#[must_use]
pub fn poses(frames: &[Frame], state: &RobotState, targets: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut poses: Vec<[f64; 3]> = Vec::with_capacity(frames.len());
    for frame in frames {
        let pose @ [angle, x, y] = frame.pose_in_parent(state, targets);
        poses.push(match frame.parent {
            None => pose,
            Some(parent) => {
                let [x, y] = point(poses[parent], [x, y]);
                [poses[parent][0] + angle, x, y]
            }
        });
    }
    poses
}

/// A point given in a frame with this pose.
#[must_use]
pub fn point([yaw, x, y]: [f64; 3], [along, across]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = yaw.sin_cos();
    [x + cos * along - sin * across, y + sin * along + cos * across]
}
