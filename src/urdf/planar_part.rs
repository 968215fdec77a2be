//! The part of a robot that moves in a plane: below one link, and with joints held.

use super::UrdfError;
use super::description::{DEFAULT_AXIS, Joint, JointKind, Link, Robot};
use super::remark::Remark;
use super::spatial_body::SpatialBody;
use nalgebra::{IsometryMatrix3, Translation3, Unit, UnitQuaternion, Vector3};
use std::collections::{HashMap, HashSet};
use std::f64::consts::TAU;

/// A joint that is held, as a fixed one.
#[derive(Clone, Debug, PartialEq)]
pub struct HeldJoint {
    /// Its name in the URDF.
    pub name: String,
    /// In the URDF's sense: rad, or m for a prismatic joint.
    pub position: f64,
}

/// The robot with the link as its root and the joints fixed; the latter must be below the link.
pub(super) fn planar_part(
    mut robot: Robot,
    top: Option<&str>,
    held: &[HeldJoint],
    remarks: &mut Vec<Remark>,
) -> Result<Robot, UrdfError> {
    if let Some(top) = top {
        robot = below(robot, top, remarks)?;
    }
    let mut seen = HashSet::new();
    for HeldJoint { name, position } in held {
        if !seen.insert(name) {
            return Err(UrdfError::joint(name, "it is fixed twice", "expected one `--fix` for each joint"));
        }
        let Some(joint) = robot.joints.iter_mut().find(|joint| joint.name == *name) else {
            let place = top.map_or_else(|| "this file".to_owned(), |top| format!("the subtree of `{top}`"));
            return Err(UrdfError::joint(name, format!("there is no such joint in {place}"), "name a `<joint>`"));
        };
        remarks.push(hold(joint, *position)?);
    }
    Ok(robot)
}

/// The link with all that it carries.
fn below(robot: Robot, top: &str, remarks: &mut Vec<Remark>) -> Result<Robot, UrdfError> {
    if !robot.links.iter().any(|link| link.name == top) {
        return Err(UrdfError::link(top, "there is no such link in this file", "name a `<link>`"));
    }
    let mut children: HashMap<&str, Vec<&str>> = HashMap::new();
    for joint in &robot.joints {
        children.entry(&joint.parent).or_default().push(&joint.child);
    }
    let (mut kept, mut open) = (HashSet::from([top]), vec![top]);
    while let Some(link) = open.pop() {
        open.extend(children.get(link).into_iter().flatten().filter(|child| kept.insert(**child)));
    }
    let kept: HashSet<String> = kept.into_iter().map(str::to_owned).collect();
    let Robot { name, links, joints } = robot;
    let (links, left_out): (Vec<Link>, Vec<Link>) = links.into_iter().partition(|link| kept.contains(&link.name));
    let joints = joints.into_iter().filter(|joint| kept.contains(&joint.parent) && joint.child != top).collect();
    let with_mass = left_out.iter().filter_map(|link| {
        let is_massless = SpatialBody::from_link(link).is_ok_and(|body| body.is_massless());
        (!is_massless).then(|| format!("`{}` {:?} kg", link.name, link.inertial.mass))
    });
    let fact = format!("left out, for only `{top}` and what it carries is taken");
    remarks.extend(Remark::of_items(Remark::warning, &fact, ", ", with_mass));
    Ok(Robot { name, links, joints })
}

/// Makes a joint a fixed one at this position.
fn hold(joint: &mut Joint, position: f64) -> Result<Remark, UrdfError> {
    let problem = |found: String, wanted: &str| Err(UrdfError::joint(&joint.name, found, wanted));
    let is_turned = match joint.kind {
        JointKind::Revolute | JointKind::Continuous => true,
        JointKind::Prismatic => false,
        kind => {
            let found = format!("it is {}", kind.name());
            return problem(found, "only revolute, continuous and prismatic joints are fixed at a position");
        }
    };
    let unit = if is_turned { "rad" } else { "m" };
    if !position.is_finite() {
        return problem(format!("its position is {position}"), "expected a finite number in rad or m");
    }
    if is_turned && position.abs() > TAU {
        let wanted = "expected an angle in rad between -2π and 2π: is it in degrees?";
        return problem(format!("it is fixed at {position:?}"), wanted);
    }
    let Some(axis) = Unit::try_new(Vector3::from(joint.axis.unwrap_or(DEFAULT_AXIS)), 0.0) else {
        return problem("its axis is [0, 0, 0]".to_owned(), "expected a direction");
    };
    let motion = if is_turned {
        let turn = UnitQuaternion::from_axis_angle(&axis, position).to_rotation_matrix();
        IsometryMatrix3::from_parts(Translation3::identity(), turn)
    } else {
        IsometryMatrix3::from_parts(Translation3::from(axis.scale(position)), nalgebra::Rotation3::identity())
    };
    joint.motion = Some(motion);
    let fact = format!("joint `{}` is fixed at {position:?} {unit}", joint.name);
    let (lower, upper) = (joint.limit.lower, joint.limit.upper);
    let is_within = joint.kind == JointKind::Continuous || (lower..=upper).contains(&position);
    let remark = if is_within {
        Remark::note(&fact)
    } else {
        Remark::warning(&format!("{fact}, outside its limits [{lower:?}, {upper:?}] {unit}"))
    };
    joint.kind = JointKind::Fixed;
    joint.mimic = None;
    Ok(remark)
}
