//! Frames of the bodies, and where they are.
//!
//! `world` is the inertial frame; `base`, and the chain of each arm from it: `arms/ARM/link1`, …, `arms/ARM/tip`; and
//! `targets/TARGET` at each target's COM, given in `world`. z is the plane's normal.

use super::channel::timestamp;
use crate::layout::Arm;
use crate::record::Row;
use crate::scenario::{Scenario, Target};
use foxglove::messages::{FrameTransform, FrameTransforms, Quaternion, Vector3};

pub(super) const WORLD: &str = "world";
pub(super) const BASE: &str = "base";

/// The frame of a link, counted from 0.
pub(super) fn link(arm: &Arm, k: usize) -> String {
    format!("arms/{}/link{}", arm.name, k + 1)
}

fn tip(arm: &Arm) -> String {
    format!("arms/{}/tip", arm.name)
}

/// The frame of a target.
pub(super) fn target(target: &Target) -> String {
    format!("targets/{}", target.name)
}

/// Where every frame is at one instant.
pub(super) fn transforms(scenario: &Scenario, row: &Row<'_>) -> FrameTransforms {
    let motion = &row.sample.state;
    let mut list = vec![transform(row.time, WORLD, BASE.to_owned(), motion.base_pose)];
    let mut joint_angles = motion.joint_angles.iter();
    for arm in &scenario.layout.arms {
        let mut parent = BASE.to_owned();
        // the next frame in its parent's: first at the mount, then at the end of the link before
        let [mut x, mut y] = arm.mount;
        let mut direction = arm.mount_angle;
        for (k, (body, angle)) in arm.links.iter().zip(&mut joint_angles).enumerate() {
            let child = link(arm, k);
            list.push(transform(row.time, &parent, child.clone(), [direction + angle, x, y]));
            (parent, direction, x, y) = (child, 0.0, body.length, 0.0);
        }
        list.push(transform(row.time, &parent, tip(arm), [direction, x, y]));
    }
    for (captured, body) in scenario.targets.iter().zip(&row.targets) {
        list.push(transform(row.time, WORLD, target(captured), body.pose));
    }
    FrameTransforms { transforms: list }
}

fn transform(time: f64, parent: &str, child: String, [yaw, x, y]: [f64; 3]) -> FrameTransform {
    FrameTransform {
        timestamp: Some(timestamp(time)),
        parent_frame_id: parent.to_owned(),
        child_frame_id: child,
        translation: Some(Vector3 { x, y, z: 0.0 }),
        rotation: Some(about_z(yaw)),
    }
}

/// A turn in the plane.
pub(super) fn about_z(yaw: f64) -> Quaternion {
    let (sin, cos) = (yaw / 2.0).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}
