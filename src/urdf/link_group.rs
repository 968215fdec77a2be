//! Groups of links that fixed joints merge into one rigid body.

use super::UrdfError;
use super::description::JointKind;
use super::spatial_body::SpatialBody;
use super::tree::Tree;
use nalgebra::{IsometryMatrix3, Matrix3, Vector3};

/// A link and all links fixed to it, in the frame of that link.
pub(super) struct LinkGroup {
    /// The child of the moving joint.
    pub(super) link: usize,
    /// Of all links together.
    pub(super) body: SpatialBody,
    /// The links and their frames: first `link`, then the others in the order of the tree.
    pub(super) members: Vec<(usize, IsometryMatrix3<f64>)>,
    /// The moving joints on it and their frames, in the order of the document.
    pub(super) joints: Vec<(usize, IsometryMatrix3<f64>)>,
}

impl LinkGroup {
    /// Collects the links that are fixed to a link.
    pub(super) fn new(tree: &Tree, link: usize) -> Result<Self, UrdfError> {
        let nothing = SpatialBody { mass: 0.0, com: Vector3::zeros(), inertia: Matrix3::zeros() };
        let mut group = Self { link, body: nothing, members: Vec::new(), joints: Vec::new() };
        let mut open = vec![(link, IsometryMatrix3::identity())];
        while let Some((member, place)) = open.pop() {
            group.body = group.body.combined(&SpatialBody::from_link(tree.link(member))?.transformed(&place));
            group.members.push((member, place));
            for joint in tree.child_joints(member).iter().rev() {
                let at = place * tree.origin(*joint);
                if tree.joint(*joint).kind == JointKind::Fixed {
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
