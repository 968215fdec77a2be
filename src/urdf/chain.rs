//! The serial chain of joints and link groups of one arm.

use super::UrdfError;
use super::description::{DEFAULT_AXIS, JointKind};
use super::link_group::LinkGroup;
use super::plane::{Plane, direction, with_exact_zeros};
use super::tree::Tree;
use nalgebra::{IsometryMatrix3, Unit, Vector3};

/// A joint of an arm and the links that it moves, at joint angles 0. "Inboard" is the link group before it.
pub(super) struct ChainJoint {
    pub(super) joint: usize,
    pub(super) group: LinkGroup,
    /// The plane in the frame of the group.
    pub(super) plane: Plane,
    /// −1 if the joint axis points against the plane's normal.
    pub(super) sign: f64,
    /// Angle between joint axis and normal, rad.
    pub(super) tilt: f64,
    /// Of the joint, in the plane's axes of the inboard group, m.
    pub(super) position: [f64; 2],
    /// Angle from the x axis of the inboard group to its own, rad.
    pub(super) turn: f64,
    /// Of its frame above that of the base along the normal, m.
    pub(super) height: f64,
}

/// The joints from one on the base to the last.
pub(super) fn serial_chain(
    tree: &Tree,
    base: &Plane,
    (joint, place): (usize, IsometryMatrix3<f64>),
) -> Result<Vec<ChainJoint>, UrdfError> {
    let mut steps = vec![step(tree, base, 0.0, joint, &place)?];
    while let Some(ChainJoint { group, plane, height, .. }) = steps.last() {
        match group.joints.as_slice() {
            [] => break,
            [(joint, place)] => steps.push(step(tree, plane, *height, *joint, place)?),
            several => {
                let names: Vec<String> = several
                    .iter()
                    .map(|(j, _)| {
                        let joint = tree.joint(*j);
                        format!("`{}` ({}) to `{}`", joint.name, joint.kind.name(), tree.link_name(tree.child(*j)))
                    })
                    .collect();
                return Err(UrdfError::link(
                    tree.link_name(group.link),
                    format!("the arm branches here, with the joints {}", names.join(", ")),
                    "only the base of a layout has branches: fix all but one of them, with `--fix JOINT=ANGLE`",
                ));
            }
        }
    }
    Ok(steps)
}

fn step(
    tree: &Tree,
    plane: &Plane,
    height: f64,
    joint: usize,
    at: &IsometryMatrix3<f64>,
) -> Result<ChainJoint, UrdfError> {
    let axis = axis(tree, joint)?;
    let own = plane.in_frame(&at.rotation);
    let (tilt, against) = own.tilt(&axis);
    if tilt > super::plane::MAX_TILT {
        let [x, y, z] = axis.into_inner().into();
        return Err(UrdfError::joint(
            &tree.joint(joint).name,
            format!("its axis [{x:?}, {y:?}, {z:?}] is {tilt:.6} rad off the normal of the plane"),
            format!(
                "all axes must be parallel, to {:?} rad, with all joints at zero (a missing <axis> is x); `--fix JOINT=ANGLE` holds \
                 a joint, `--subtree LINK` takes only what a link carries",
                super::plane::MAX_TILT
            ),
        ));
    }
    let (position, above) = plane.project(&at.translation.vector);
    let (seen, _) = plane.project(&(at.rotation * own.x));
    Ok(ChainJoint {
        joint,
        group: LinkGroup::new(tree, tree.child(joint))?,
        plane: own,
        sign: if against { -1.0 } else { 1.0 },
        tilt,
        position: with_exact_zeros(position, at.translation.vector.norm()),
        turn: direction(seen),
        height: height + above,
    })
}

/// The axis of a revolute joint in the frame of its child link.
pub(super) fn axis(tree: &Tree, joint: usize) -> Result<Unit<Vector3<f64>>, UrdfError> {
    let joint = tree.joint(joint);
    let problem = |found: String, wanted: &str| UrdfError::joint(&joint.name, found, wanted);
    if !matches!(joint.kind, JointKind::Revolute | JointKind::Continuous) {
        let found = format!("it is {}, from `{}` to `{}`", joint.kind.name(), joint.parent, joint.child);
        return Err(problem(
            found,
            "a layout has only revolute joints: expected revolute, continuous or fixed; `--fix JOINT=POSITION` holds a joint",
        ));
    }
    if let Some(mimic) = &joint.mimic {
        let found = format!("it mimics joint `{mimic}`");
        return Err(problem(
            found,
            "joints of a layout are independent: fix it with `--fix JOINT=ANGLE`, or remove <mimic>",
        ));
    }
    Unit::try_new(Vector3::from(joint.axis.unwrap_or(DEFAULT_AXIS)), 0.0)
        .ok_or_else(|| problem("its axis is [0, 0, 0]".to_owned(), "expected a direction"))
}
