//! Forward kinematics of robot and targets: one tree of frames for the clearance, figures, MCAP and the HTML report.
//!
//! The frames form a tree: `base` and `targets/TARGET` (at the target's COM) in the inertial frame, `arms/ARM/link1` in
//! `base`, `arms/ARM/link2` in `arms/ARM/link1` and so on to `arms/ARM/tip`.
//!
//! # Example
//! ```
//! use planar_capture::frames::{frames, poses};
//! use planar_capture::layout::Layout;
//! use planar_capture::owned::RobotState;
//! use std::f64::consts::FRAC_PI_2;
//!
//! let layout = Layout::read("codegen/layouts/dual_arm_3r.toml".as_ref())?;
//! let frames = frames(&layout, ["ball"]);
//! // the first arm, of three links of 1 m on a mount at (0.5, 0), is straight and points along y
//! let joint_angles = vec![FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0];
//! let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates: vec![0.0; 6] };
//! let poses = poses(&frames, &state, &[[0.0, 2.0, -2.0]]);
//! let tip = frames.iter().position(|frame| frame.name == "arms/arm1/tip").expect("every arm has one");
//! let [yaw, x, y] = poses[tip];
//! assert!((yaw - FRAC_PI_2).abs() + (x - 0.5).abs() + (y - 3.0).abs() < 1e-12);
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use crate::layout::Layout;
use crate::owned::RobotState;
use crate::scalar::Scalar;

/// A coordinate frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// As in MCAP.
    pub name: String,
    /// Index of the parent; `None` for the inertial frame.
    pub parent: Option<usize>,
    /// [angle, x, y] in the parent with the joint angle 0, rad, m; zeros for a free body.
    pub pose: [f64; 3],
    /// What determines its motion.
    pub motion: FrameMotion,
    /// Index of its arm.
    pub arm: Option<usize>,
}

/// What determines the motion of a frame in its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameMotion {
    /// It is fixed.
    Fixed,
    /// The angle of the joint of this index.
    Joint(usize),
    /// The pose of the free base.
    Base,
    /// The pose of the free target of this index.
    Target(usize),
}

/// The frames of a robot and of targets with these names; parents come before their children.
#[must_use]
pub fn frames<'a>(layout: &Layout, targets: impl IntoIterator<Item = &'a str>) -> Vec<Frame> {
    let mut frames = robot_frames(layout);
    frames.extend(targets.into_iter().enumerate().map(|(i, name)| Frame {
        name: format!("targets/{name}"),
        parent: None,
        pose: [0.0; 3],
        motion: FrameMotion::Target(i),
        arm: None,
    }));
    frames
}

/// The frames of a robot: the base, then the links and the end effector of each arm; parents come before their
/// children.
#[must_use]
pub fn robot_frames(layout: &Layout) -> Vec<Frame> {
    let free = Frame { name: "base".to_owned(), parent: None, pose: [0.0; 3], motion: FrameMotion::Base, arm: None };
    let mut frames = vec![free];
    let mut joint = 0;
    for (i, arm) in layout.arms.iter().enumerate() {
        let mut next = Frame {
            name: String::new(),
            parent: Some(0),
            pose: [arm.mount_angle, arm.mount[0], arm.mount[1]],
            motion: FrameMotion::Fixed,
            arm: Some(i),
        };
        for (k, link) in arm.links.iter().enumerate() {
            let name = format!("arms/{}/link{}", arm.name, k + 1);
            frames.push(Frame { name, motion: FrameMotion::Joint(joint), ..next.clone() });
            joint += 1;
            next = Frame { parent: Some(frames.len() - 1), pose: [0.0, link.length, 0.0], ..next };
        }
        frames.push(Frame { name: format!("arms/{}/tip", arm.name), ..next });
    }
    frames
}

impl Frame {
    /// [angle, x, y] in the parent, rad, m; `targets` are the poses of the targets.
    #[must_use]
    pub fn pose_in_parent(&self, state: &RobotState, targets: &[[f64; 3]]) -> [f64; 3] {
        let [angle, x, y] = self.pose;
        match self.motion {
            FrameMotion::Fixed => self.pose,
            FrameMotion::Joint(joint) => [angle + state.joint_angles[joint], x, y],
            FrameMotion::Base => state.base_pose,
            FrameMotion::Target(target) => targets[target],
        }
    }
}

/// [yaw, x, y] of every frame in the inertial frame, rad, m.
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

/// Inertial coordinates of the point [along, across] of a frame with this pose.
#[must_use]
pub fn point([yaw, x, y]: [f64; 3], [along, across]: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = Scalar::sin_cos(yaw);
    [x + cos * along - sin * across, y + sin * along + cos * across]
}

/// A vector rotated by an angle of this sine and cosine.
#[inline]
pub(crate) fn turned([x, y]: [f64; 2], (sin, cos): (f64, f64)) -> [f64; 2] {
    [cos * x - sin * y, sin * x + cos * y]
}
