//! One arm of a URDF: the groups of links that its joints move.

use super::UrdfError;
use super::group::Group;
use super::plane::{Plane, direction, snapped};
use super::tree::Tree;
use nalgebra::{IsometryMatrix3, Unit, Vector3};
use urdf_rs::JointType;

/// A joint and what it moves, seen from the body before it, all joints at zero.
pub(super) struct Step {
    pub(super) joint: usize,
    pub(super) group: Group,
    /// The plane in the frame of the group.
    pub(super) plane: Plane,
    /// −1 where the joint turns against the plane's normal.
    pub(super) sign: f64,
    /// Angle of the joint's axis with the normal, rad.
    pub(super) tilt: f64,
    /// Where the joint is, in the plane's axes of the body before it.
    pub(super) position: [f64; 2],
    /// Angle from the x axis of the body before it to its own, rad.
    pub(super) turn: f64,
    /// Of its frame above the frame of the base.
    pub(super) height: f64,
}

/// The steps from a joint on the base to the last link.
pub(super) fn follow(
    tree: &Tree,
    base: &Plane,
    (joint, place): (usize, IsometryMatrix3<f64>),
) -> Result<Vec<Step>, UrdfError> {
    let mut steps = vec![step(tree, base, 0.0, joint, &place)?];
    while let Some(Step { group, plane, height, .. }) = steps.last() {
        match group.joints.as_slice() {
            [] => break,
            [(joint, place)] => steps.push(step(tree, plane, *height, *joint, place)?),
            several => {
                let names: Vec<String> = several
                    .iter()
                    .map(|(j, _)| {
                        let joint = tree.joint(*j);
                        format!("`{}` ({}) to `{}`", joint.name, kind(joint), tree.link_name(tree.child(*j)))
                    })
                    .collect();
                return Err(UrdfError::link(
                    tree.link_name(group.link),
                    format!("the arm branches here, with the joints {}", names.join(", ")),
                    "a layout has branches on the base alone: make all but one of them fixed",
                ));
            }
        }
    }
    Ok(steps)
}

fn step(tree: &Tree, plane: &Plane, height: f64, joint: usize, at: &IsometryMatrix3<f64>) -> Result<Step, UrdfError> {
    let axis = axis(tree, joint)?;
    let own = plane.seen_from(&at.rotation);
    let (tilt, against) = own.tilt(&axis);
    if tilt > super::plane::PARALLEL {
        let [x, y, z] = axis.into_inner().into();
        return Err(UrdfError::joint(
            &tree.joint(joint).name,
            format!("its axis [{x:?}, {y:?}, {z:?}] is {tilt:.6} rad off the normal of the plane"),
            format!(
                "all axes must be parallel, to {:?} rad, with all joints at zero (a missing <axis> is x)",
                super::plane::PARALLEL
            ),
        ));
    }
    let (position, above) = plane.project(&at.translation.vector);
    let (seen, _) = plane.project(&(at.rotation * own.x));
    Ok(Step {
        joint,
        group: Group::of(tree, tree.child(joint))?,
        plane: own,
        sign: if against { -1.0 } else { 1.0 },
        tilt,
        position: snapped(position, at.translation.vector.norm()),
        turn: direction(seen),
        height: height + above,
    })
}

/// The axis of a joint that a layout can have, in the frame of the link that it moves.
pub(super) fn axis(tree: &Tree, joint: usize) -> Result<Unit<Vector3<f64>>, UrdfError> {
    let joint = tree.joint(joint);
    let problem = |found: String, wanted: &str| UrdfError::joint(&joint.name, found, wanted);
    if !matches!(joint.joint_type, JointType::Revolute | JointType::Continuous) {
        let found = format!("it is {}, from `{}` to `{}`", kind(joint), joint.parent.link, joint.child.link);
        return Err(problem(found, "a layout has revolute joints alone: expected revolute, continuous or fixed"));
    }
    if let Some(mimic) = &joint.mimic {
        let found = format!("it mimics joint `{}`", mimic.joint);
        return Err(problem(found, "a layout's joints move on their own: make it fixed, or take <mimic> away"));
    }
    Unit::try_new(Vector3::from(*joint.axis.xyz), 0.0)
        .ok_or_else(|| problem("its axis is [0, 0, 0]".to_owned(), "expected a direction"))
}

/// As the file has it.
fn kind(joint: &urdf_rs::Joint) -> &'static str {
    match joint.joint_type {
        JointType::Revolute => "revolute",
        JointType::Continuous => "continuous",
        JointType::Prismatic => "prismatic",
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    }
}
