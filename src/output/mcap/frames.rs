//! Where every frame of the [scene](crate::output::scene) is; `world` is the inertial frame, z the plane's normal.

use super::channel::timestamp;
use crate::output::scene::Frame;
use crate::output::time_series::TimeSeriesRow;
use foxglove::messages::{FrameTransform, FrameTransforms, Quaternion, Vector3};

pub(super) const WORLD: &str = "world";

/// Every frame in its parent, at one instant.
pub(super) fn transforms(frames: &[Frame], row: &TimeSeriesRow<'_>) -> FrameTransforms {
    let targets: Vec<[f64; 3]> = row.targets.iter().map(|target| target.pose).collect();
    // before there is a capture no target is anywhere
    let there = |frame: &&Frame| !matches!(frame.motion, crate::output::scene::Motion::Target(i) if i >= targets.len());
    let each = frames.iter().filter(there).map(|frame| {
        let parent = frame.parent.map_or(WORLD, |parent| &frames[parent].name);
        transform(row.time, parent, frame.name.clone(), frame.pose_in_parent(&row.sample.state, &targets))
    });
    FrameTransforms { transforms: each.collect() }
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
