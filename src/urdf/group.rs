//! Links that fixed joints make one rigid body.

use super::UrdfError;
use super::body::Body;
use super::tree::Tree;
use nalgebra::{IsometryMatrix3, Matrix3, Vector3};
use urdf_rs::JointType;

/// A link and all that is fixed to it, in the frame of that link.
pub(super) struct Group {
    /// The link that the moving joint holds.
    pub(super) link: usize,
    /// All of it.
    pub(super) body: Body,
    /// The links and their frames: the first is `link`, then in the order of the tree.
    pub(super) members: Vec<(usize, IsometryMatrix3<f64>)>,
    /// The moving joints on it and their frames, in the order of the document.
    pub(super) joints: Vec<(usize, IsometryMatrix3<f64>)>,
}

impl Group {
    /// Collects what is fixed to a link.
    pub(super) fn of(tree: &Tree, link: usize) -> Result<Self, UrdfError> {
        let nothing = Body { mass: 0.0, com: Vector3::zeros(), inertia: Matrix3::zeros() };
        let mut group = Self { link, body: nothing, members: Vec::new(), joints: Vec::new() };
        let mut open = vec![(link, IsometryMatrix3::identity())];
        while let Some((member, place)) = open.pop() {
            group.body = group.body.with(&Body::of(tree.link(member))?.seen_through(&place));
            group.members.push((member, place));
            for joint in tree.joints_below(member).iter().rev() {
                let at = place * tree.place(*joint);
                if tree.joint(*joint).joint_type == JointType::Fixed {
                    open.push((tree.child(*joint), at));
                } else {
                    group.joints.push((*joint, at));
                }
            }
        }
        group.joints.sort_by_key(|(joint, _)| *joint);
        Ok(group)
    }

    /// The names of its links.
    pub(super) fn names<'a>(&'a self, tree: &'a Tree) -> Vec<&'a str> {
        self.members.iter().map(|(link, _)| tree.link_name(*link)).collect()
    }
}
