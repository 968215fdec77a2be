//! Converts the tree of a URDF to a layout.

use super::chain::{self, ChainJoint};
use super::description::{JointKind, Robot};
use super::end_effector::{EndEffector, end_effectors};
use super::imported_layout::{ImportedJoint, ImportedLayout};
use super::link_group::LinkGroup;
use super::names::{arm_names, layout_name};
use super::omissions::omissions;
use super::planar_body::PlanarBody;
use super::planar_part::{HeldJoint, planar_part};
use super::plane::{Plane, direction, in_rotated_axes, with_exact_zeros};
use super::remark::Remark;
use super::tree::Tree;
use super::{UrdfError, reader};
use crate::layout::{Arm, Base, Layout, Link};
use std::f64::consts::{PI, TAU};

/// What the file does not determine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportOptions {
    /// The name of the layout; by default that of the robot.
    pub name: Option<String>,
    /// Links at the end effectors, at most one for each arm.
    pub end_effectors: Vec<String>,
    /// The link that is the root, with what it carries; by default that of the file.
    pub subtree: Option<String>,
    /// Joints that are held, so that the others move in one plane.
    pub held: Vec<HeldJoint>,
}

/// Reads a URDF as a free-floating planar robot.
///
/// - Only the subtree of the requested link is read, and joints that are to be held are fixed ones. The base is the
///   root, or the child of a massless root without a revolute joint (`world`). Fixed joints merge links. Chains from the
///   base are arms, in the order of their first joints in the file.
/// - The plane's normal is z of the base link if the axes are along ±z, else the axis of the first joint.
/// - The end effector of an arm is at the requested link, else at the first massless leaf fixed to its last link, else at
///   its only fixed leaf, else at twice the distance of the centre of mass.
/// - Components below 1e-12 of their vector become exact zeros, which are structural.
/// - Orientations of end effectors, visuals, collisions, limits and losses are omitted.
///
/// # Errors
/// [`UrdfError`] with the first link or joint that a layout cannot represent.
pub fn import(text: &str, options: &ImportOptions) -> Result<ImportedLayout, UrdfError> {
    let (robot, lines) = reader::read(text)?;
    layout_of(robot, options).map_err(|error| lines.locate(error))
}

fn layout_of(robot: Robot, options: &ImportOptions) -> Result<ImportedLayout, UrdfError> {
    let mut remarks = Vec::new();
    let robot = planar_part(robot, options.subtree.as_deref(), &options.held, &mut remarks)?;
    let tree = Tree::new(robot)?;
    let name = layout_name(tree.name(), options.name.as_deref())?;
    let (base_link, passed) = tree.base()?;
    let base = LinkGroup::new(&tree, base_link)?;
    if let Some(joint) = passed.map(|joint| tree.joint(joint)).filter(|j| j.kind == JointKind::Fixed) {
        let (above, below) = (&joint.parent, &joint.child);
        remarks.push(Remark::note(&format!("`{above}` holds `{below}` in the file; here `{below}` floats freely")));
    }
    let Some((first, at)) = base.joints.first() else {
        let found = format!("its base `{}` has no moving joint", tree.link_name(base_link));
        return Err(UrdfError::part("robot", tree.name(), found, "expected at least one revolute or continuous joint"));
    };
    let plane = Plane::for_base(at.rotation * chain::axis(&tree, *first)?);
    let base_body = PlanarBody::new(&tree, &base, &plane, 0.0)?;
    let steps: Vec<Vec<ChainJoint>> =
        base.joints.iter().map(|joint| chain::serial_chain(&tree, &plane, *joint)).collect::<Result<_, _>>()?;
    let first_joints: Vec<&str> = base.joints.iter().map(|(joint, _)| tree.joint(*joint).name.as_str()).collect();
    let names = arm_names(&first_joints);
    let ends = end_effectors(&tree, &steps, &names, &options.end_effectors, &mut remarks)?;

    let mut bodies = vec![base_body.clone()];
    let (mut arms, mut joints) = (Vec::new(), Vec::new());
    for ((steps, end), name) in steps.iter().zip(&ends).zip(&names) {
        let (arm, coordinates) = arm(&tree, &base_body, name, (steps, end), &mut bodies)?;
        arms.push(arm);
        joints.extend(coordinates);
    }
    remarks.extend(super::planar_body::remarks(&bodies));
    remarks.extend(tilts(&tree, &steps));
    let moving = steps.iter().flatten().map(|step| tree.joint(step.joint));
    remarks.extend(omissions(moving));
    let base_body = Base { mass: base_body.mass, inertia: base_body.inertia, outline: None };
    let result = ImportedLayout {
        layout: Layout { name, base: base_body, arms },
        base: owned(&base.names(&tree)),
        normal: plane.normal.into_inner().into(),
        x_axis: plane.x.into(),
        joints,
        end_effectors: ends.into_iter().map(|end| end.name).collect(),
        remarks,
    };
    Layout::parse(&result.to_toml(tree.name()), "the layout")?;
    Ok(result)
}

/// One arm and its joints.
fn arm(
    tree: &Tree,
    base: &PlanarBody,
    name: &str,
    (steps, end): (&[ChainJoint], &EndEffector),
    bodies: &mut Vec<PlanarBody>,
) -> Result<(Arm, Vec<ImportedJoint>), UrdfError> {
    let (mut links, mut joints) = (Vec::new(), Vec::new());
    let (mut mount, mut mount_angle) = ([0.0; 2], 0.0);
    let mut inboard = 0.0; // direction of the inboard link in its URDF frame
    for (k, step) in steps.iter().enumerate() {
        let planar_body = PlanarBody::new(tree, &step.group, &step.plane, step.height)?;
        let outward = match steps.get(k + 1) {
            Some(next) => next.position,
            None => with_exact_zeros(step.plane.project(&end.position).0, end.position.norm()),
        };
        let length = libm::hypot(outward[0], outward[1]);
        let along = direction(outward); // 0 for a length of 0: the frame's own x axis
        let [offset] = with_exact_zeros([wrapped(step.turn + along - inboard)], 1.0);
        if k == 0 {
            let from_com = [0, 1].map(|i| step.position[i] - base.com[i]);
            let scale = libm::hypot(step.position[0], step.position[1]).max(libm::hypot(base.com[0], base.com[1]));
            (mount, mount_angle) = (with_exact_zeros(from_com, scale), offset);
        }
        let com = in_rotated_axes(planar_body.com, along);
        links.push(Link {
            length,
            mass: planar_body.mass,
            inertia: planar_body.inertia,
            com: with_exact_zeros(com, length.max(libm::hypot(com[0], com[1]))),
            outline: None,
        });
        joints.push(ImportedJoint {
            arm: name.to_owned(),
            number: k + 1,
            name: tree.joint(step.joint).name.clone(),
            links: owned(&step.group.names(tree)),
            sign: step.sign,
            offset: if k == 0 { 0.0 } else { offset },
        });
        bodies.push(planar_body);
        inboard = along;
    }
    Ok((Arm { name: name.to_owned(), mount, mount_angle, links }, joints))
}

/// The angle modulo 2π, between −π and π.
fn wrapped(angle: f64) -> f64 {
    if angle.abs() <= PI { angle } else { angle - TAU * (angle / TAU).round() }
}

/// A warning of axes that are only nearly parallel.
fn tilts(tree: &Tree, steps: &[Vec<ChainJoint>]) -> Option<Remark> {
    let off = steps.iter().flatten().filter(|step| step.tilt > 1e-9);
    let off = off.map(|step| format!("`{}` {:.1e} rad", tree.joint(step.joint).name, step.tilt));
    Remark::of_items(Remark::warning, "axes off the plane's normal are taken as parallel to it", ", ", off)
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}
