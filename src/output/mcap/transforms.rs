//! The poses of all [frames](crate::frames) as transforms; `world` is the inertial frame.

use super::recording::timestamp;
use crate::frames::Frame;
use crate::output::time_series::TimeSeriesRow;
use foxglove::messages::{FrameTransform, FrameTransforms, Pose, Quaternion, Vector3};

pub(super) const WORLD: &str = "world";

/// Every frame in its parent, at one instant.
pub(super) fn transforms(frames: &[Frame], row: &TimeSeriesRow<'_>) -> FrameTransforms {
    let targets: Vec<[f64; 3]> = row.targets.iter().map(|target| target.pose).collect();
    let transform = |frame: &Frame| {
        let Pose { position, orientation } = pose(frame.pose_in_parent(&row.sample.state, &targets));
        FrameTransform {
            timestamp: Some(timestamp(row.time)),
            parent_frame_id: frame.parent.map_or(WORLD, |parent| &frames[parent].name).to_owned(),
            child_frame_id: frame.name.clone(),
            translation: position,
            rotation: orientation,
        }
    };
    FrameTransforms { transforms: frames.iter().map(transform).collect() }
}

/// A pose [yaw, x, y] in space; z is the normal of the plane.
pub(super) fn pose([yaw, x, y]: [f64; 3]) -> Pose {
    let (sin, cos) = libm::sincos(yaw / 2.0);
    Pose { position: Some(Vector3 { x, y, z: 0.0 }), orientation: Some(Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }) }
}
