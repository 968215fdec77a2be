//! What a layout takes of a URDF: its links and joints as they are written, not checked to form a tree.

use nalgebra::{IsometryMatrix3, Rotation3, Translation3};

/// The content of `<robot>`.
#[derive(Debug, Default)]
pub(super) struct Robot {
    /// Empty where none is given.
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<Joint>,
}

#[derive(Debug)]
pub(super) struct Link {
    pub(super) name: String,
    /// All zero without `<inertial>`.
    pub(super) inertial: Inertial,
}

#[derive(Debug, Default)]
pub(super) struct Inertial {
    pub(super) origin: Pose,
    pub(super) mass: f64,
    /// ixx, ixy, ixz, iyy, iyz, izz.
    pub(super) inertia: [f64; 6],
}

/// An `<origin>`; without one, all zero.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pose {
    pub(super) xyz: [f64; 3],
    /// Rotations about the fixed axes x, y, z in this order.
    pub(super) rpy: [f64; 3],
}

#[derive(Debug)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) kind: JointKind,
    pub(super) origin: Pose,
    /// Of the child in the frame at the origin, where the joint is held.
    pub(super) motion: Option<IsometryMatrix3<f64>>,
    pub(super) parent: String,
    pub(super) child: String,
    /// [`DEFAULT_AXIS`] where `None`.
    pub(super) axis: Option<[f64; 3]>,
    pub(super) limit: Limit,
    pub(super) damping: f64,
    pub(super) friction: f64,
    /// The joint that it follows.
    pub(super) mimic: Option<String>,
}

/// Infinite where there is none.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    pub(super) lower: f64,
    pub(super) upper: f64,
    pub(super) effort: f64,
    pub(super) velocity: f64,
}

/// The axis of a joint without `<axis>`.
pub(super) const DEFAULT_AXIS: [f64; 3] = [1.0, 0.0, 0.0];

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointKind {
    Revolute,
    Continuous,
    Prismatic,
    Fixed,
    Floating,
    Planar,
    Spherical,
}

impl JointKind {
    /// All, with their names in a file.
    pub(super) const ALL: [(&str, Self); 7] = [
        ("revolute", Self::Revolute),
        ("continuous", Self::Continuous),
        ("prismatic", Self::Prismatic),
        ("fixed", Self::Fixed),
        ("floating", Self::Floating),
        ("planar", Self::Planar),
        ("spherical", Self::Spherical),
    ];

    /// As in the file.
    pub(super) fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, kind)| *kind == self).map_or("", |(name, _)| name)
    }
}

impl Pose {
    /// From the frame at the pose to the one that it is given in.
    pub(super) fn isometry(&self) -> IsometryMatrix3<f64> {
        let ([x, y, z], [roll, pitch, yaw]) = (self.xyz, self.rpy);
        IsometryMatrix3::from_parts(Translation3::new(x, y, z), Rotation3::from_euler_angles(roll, pitch, yaw))
    }
}
