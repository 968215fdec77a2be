//! From the tree of a URDF to a layout.

use super::chain::{self, Step};
use super::document::Remark;
use super::group::Group;
use super::names::{arm_names, layout_name};
use super::omission::omissions;
use super::planar_body::PlanarBody;
use super::plane::{Plane, direction, snapped, turned_back};
use super::tip::{Tip, tips};
use super::tree::Tree;
use super::{UrdfError, reader};
use crate::layout::{Arm, Base, Layout, Link};
use std::f64::consts::{PI, TAU};
use urdf_rs::JointType;

/// What the file alone does not say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ImportOptions {
    /// The name of the layout; default: from the robot's.
    pub name: Option<String>,
    /// Links whose frames are the tips of their arms, at most one for each arm.
    pub tips: Vec<String>,
}

/// A layout, and what of the URDF became what of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedLayout {
    /// The layout.
    pub layout: Layout,
    /// The links that make the base; its frame is that of the first, moved to the common centre of mass.
    pub base: Vec<String>,
    /// Normal of the plane in the frame of the base link.
    pub normal: [f64; 3],
    /// The plane's x axis, which is the layout's, in the frame of the base link; y is normal × x.
    pub x_axis: [f64; 3],
    /// The joints in the order of the layout.
    pub joints: Vec<ImportedJoint>,
    /// For each arm the link whose frame is its tip, if it is one.
    pub tips: Vec<Option<String>>,
    /// What was chosen or left out.
    pub remarks: Vec<Remark>,
}

/// A joint of the layout: its angle is `sign` times the URDF's plus `offset`.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedJoint {
    /// The arm.
    pub arm: String,
    /// Counted from 1 at the base.
    pub number: usize,
    /// The URDF's name for it.
    pub name: String,
    /// The links that it moves: the first on the joint, the others fixed to it.
    pub links: Vec<String>,
    /// −1 where the URDF's axis points against the plane's normal.
    pub sign: f64,
    /// The layout's angle when the URDF's is 0, rad. Always 0 for the first joint of an arm, which has `mount_angle`.
    pub offset: f64,
}

/// Reads a URDF as a free-floating planar robot.
///
/// - The root is the base, or the child of a massless root without a revolute joint (`world`). What fixed joints hold is
///   lumped. Chains from the base are arms, in the order of their first joints in the file.
/// - The plane's normal is z of the base link where the axes are along z, either way, else the axis of the first joint.
/// - The end of an arm is the link asked for, else the first massless link that is fixed to its last link and has no
///   joints, else the only link of any mass that is so, else the point at twice the distance of the centre of mass.
/// - Components below 1e-12 of the vector they belong to are exact zeros, which are structural.
/// - Orientations of tips, visuals, collisions, limits and losses are left out.
///
/// # Errors
/// [`UrdfError`]: the first link or joint that a layout cannot hold.
pub fn import(text: &str, options: &ImportOptions) -> Result<ImportedLayout, UrdfError> {
    let tree = Tree::new(reader::read(text)?)?;
    let name = layout_name(tree.name(), options.name.as_deref())?;
    let (base_link, passed) = tree.base()?;
    let base = Group::of(&tree, base_link)?;
    let mut remarks = Vec::new();
    if let Some(joint) = passed.map(|joint| tree.joint(joint)).filter(|j| j.joint_type == JointType::Fixed) {
        let (above, below) = (&joint.parent.link, &joint.child.link);
        remarks.push(Remark::note(&format!("`{above}` holds `{below}` in the file; here `{below}` floats freely")));
    }
    let Some((first, at)) = base.joints.first() else {
        return Err(UrdfError::Robot {
            robot: tree.name().to_owned(),
            found: format!("no joint moves anything on its base `{}`", tree.link_name(base_link)),
            wanted: "expected at least one revolute or continuous joint".to_owned(),
        });
    };
    let plane = Plane::of_base(at.rotation * chain::axis(&tree, *first)?);
    let base_body = PlanarBody::of(&tree, &base, &plane, 0.0)?;
    let steps: Vec<Vec<Step>> =
        base.joints.iter().map(|joint| chain::follow(&tree, &plane, *joint)).collect::<Result<_, _>>()?;
    let first_joints: Vec<&str> = base.joints.iter().map(|(joint, _)| tree.joint(*joint).name.as_str()).collect();
    let names = arm_names(&first_joints);
    let ends = tips(&tree, &steps, &names, &options.tips, &mut remarks)?;

    let mut planar_bodies = vec![base_body.clone()];
    let (mut arms, mut joints) = (Vec::new(), Vec::new());
    for ((steps, end), name) in steps.iter().zip(&ends).zip(&names) {
        let (arm, coordinates) = arm(&tree, &base_body, name, (steps, end), &mut planar_bodies)?;
        arms.push(arm);
        joints.extend(coordinates);
    }
    remarks.extend(super::planar_body::remarks(&planar_bodies));
    remarks.extend(tilts(&tree, &steps));
    let moving = steps.iter().flatten().map(|step| tree.joint(step.joint));
    remarks.extend(omissions(moving, &reader::joints_without_axis(text)));
    let base_body = Base { mass: base_body.mass, inertia: base_body.inertia };
    let result = ImportedLayout {
        layout: Layout { name, base: base_body, arms },
        base: owned(&base.names(&tree)),
        normal: plane.normal.into_inner().into(),
        x_axis: plane.x.into(),
        joints,
        tips: ends.into_iter().map(|tip| tip.name).collect(),
        remarks,
    };
    Layout::parse(&result.to_toml(tree.name()), "the layout")?;
    Ok(result)
}

/// One arm and its coordinates.
fn arm(
    tree: &Tree,
    base: &PlanarBody,
    name: &str,
    (steps, end): (&[Step], &Tip),
    planar_bodies: &mut Vec<PlanarBody>,
) -> Result<(Arm, Vec<ImportedJoint>), UrdfError> {
    let (mut links, mut joints) = (Vec::new(), Vec::new());
    let (mut mount, mut mount_angle) = ([0.0; 2], 0.0);
    let mut before = 0.0; // direction of the link before this one in its URDF frame
    for (k, step) in steps.iter().enumerate() {
        let planar_body = PlanarBody::of(tree, &step.group, &step.plane, step.height)?;
        let outward = match steps.get(k + 1) {
            Some(next) => next.position,
            None => snapped(step.plane.project(&end.position).0, end.position.norm()),
        };
        let length = outward[0].hypot(outward[1]);
        let along = direction(outward); // 0 for a length of 0: the frame's own x axis
        let [offset] = snapped([wrapped(step.turn + along - before)], 1.0);
        if k == 0 {
            let from_com = [0, 1].map(|i| step.position[i] - base.com[i]);
            let scale = step.position[0].hypot(step.position[1]).max(base.com[0].hypot(base.com[1]));
            (mount, mount_angle) = (snapped(from_com, scale), offset);
        }
        let com = turned_back(planar_body.com, along);
        links.push(Link {
            length,
            mass: planar_body.mass,
            inertia: planar_body.inertia,
            com: snapped(com, length.max(com[0].hypot(com[1]))),
        });
        joints.push(ImportedJoint {
            arm: name.to_owned(),
            number: k + 1,
            name: tree.joint(step.joint).name.clone(),
            links: owned(&step.group.names(tree)),
            sign: step.sign,
            offset: if k == 0 { 0.0 } else { offset },
        });
        planar_bodies.push(planar_body);
        before = along;
    }
    Ok((Arm { name: name.to_owned(), mount, mount_angle, links }, joints))
}

/// The same angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    if angle.abs() <= PI { angle } else { angle - TAU * (angle / TAU).round() }
}

/// Axes that are parallel only nearly.
fn tilts(tree: &Tree, steps: &[Vec<Step>]) -> Option<Remark> {
    let off = steps.iter().flatten().filter(|step| step.tilt > 1e-9);
    let off: Vec<String> = off.map(|s| format!("`{}` {:.1e} rad", tree.joint(s.joint).name, s.tilt)).collect();
    let text = || format!("axes off the plane's normal are taken as parallel to it: {}", off.join(", "));
    (!off.is_empty()).then(|| Remark::warning(&text()))
}

fn owned(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}
