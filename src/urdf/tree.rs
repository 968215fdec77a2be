//! The tree of the links and joints of a URDF.

use super::UrdfError;
use super::description::{DEFAULT_AXIS, Joint, JointKind, Link, Robot};
use super::finite::finite;
use super::spatial_body::SpatialBody;
use nalgebra::IsometryMatrix3;
use std::collections::HashMap;

/// Links and joints by their indices in the document; every link but the root is the child of one joint.
pub(super) struct Tree {
    robot: Robot,
    /// Per link, the joints whose parent it is.
    children: Vec<Vec<usize>>,
    /// Per joint, its child link.
    child: Vec<usize>,
    root: usize,
}

impl Tree {
    /// Checks that the links form one tree, that names are unique and that numbers are finite.
    pub(super) fn new(robot: Robot) -> Result<Self, UrdfError> {
        let problem = |found: String, wanted: &str| UrdfError::part("robot", &robot.name, found, wanted);
        if robot.links.is_empty() {
            return Err(problem("it has no links".to_owned(), "expected `<robot>` with `<link>` and `<joint>` in it"));
        }
        let mut links = HashMap::new();
        for (i, link) in robot.links.iter().enumerate() {
            if links.insert(link.name.as_str(), i).is_some() {
                return Err(UrdfError::link(&link.name, "there are two of this name", "names must differ"));
            }
        }
        let mut children = vec![Vec::new(); robot.links.len()];
        let mut parent: Vec<Option<usize>> = vec![None; robot.links.len()];
        let mut child = Vec::new();
        let mut names = HashMap::new();
        for (j, joint) in robot.joints.iter().enumerate() {
            if names.insert(joint.name.as_str(), j).is_some() {
                return Err(UrdfError::joint(&joint.name, "there are two of this name", "names must differ"));
            }
            let find = |what: &str, name: &str| {
                let missing = || format!("its {what} `{name}` is no link of this file");
                links.get(name).copied().ok_or_else(|| UrdfError::joint(&joint.name, missing(), "name a `<link>`"))
            };
            let (above, below) = (find("parent", &joint.parent)?, find("child", &joint.child)?);
            if let Some(other) = parent[below].replace(j) {
                let found = format!("it is the child of joints `{}` and `{}`", robot.joints[other].name, joint.name);
                return Err(UrdfError::link(
                    &joint.child,
                    found,
                    "a tree of links has no closed chains: expected one joint",
                ));
            }
            finite("its origin", joint.origin.xyz, |f, w| UrdfError::joint(&joint.name, f, w))?;
            finite("its origin's rpy", joint.origin.rpy, |f, w| UrdfError::joint(&joint.name, f, w))?;
            finite("its axis", joint.axis.unwrap_or(DEFAULT_AXIS), |f, w| UrdfError::joint(&joint.name, f, w))?;
            children[above].push(j);
            child.push(below);
        }
        let tops: Vec<usize> = (0..robot.links.len()).filter(|link| parent[*link].is_none()).collect();
        let Some(first) = tops.first().copied() else {
            let found = "every link is the child of a joint: the joints go round in a circle".to_owned();
            return Err(problem(found, "one link must be the base"));
        };
        if let Some(second) = tops.get(1) {
            let (first, second) = (&robot.links[first].name, &robot.links[*second].name);
            let found = format!("neither `{first}` nor `{second}` is the child of a joint");
            return Err(problem(found, "expected one tree, with one link that is the base"));
        }
        let tree = Self { robot, children, child, root: first };
        tree.reject_cycles()?;
        Ok(tree)
    }

    /// Links that cannot be reached from the root form cycles, because all but the root have one parent.
    fn reject_cycles(&self) -> Result<(), UrdfError> {
        let mut reached = vec![false; self.robot.links.len()];
        let mut open = vec![self.root];
        while let Some(link) = open.pop() {
            reached[link] = true;
            open.extend(self.child_joints(link).iter().map(|joint| self.child[*joint]));
        }
        match reached.iter().position(|reached| !reached) {
            Some(link) => Err(UrdfError::link(
                self.link_name(link),
                format!("no chain of joints leads to it from `{}`", self.link_name(self.root)),
                "the joints go round in a circle; expected one tree",
            )),
            None => Ok(()),
        }
    }

    pub(super) fn name(&self) -> &str {
        &self.robot.name
    }

    pub(super) fn link(&self, link: usize) -> &Link {
        &self.robot.links[link]
    }

    pub(super) fn link_name(&self, link: usize) -> &str {
        &self.link(link).name
    }

    pub(super) fn link_named(&self, name: &str) -> Option<usize> {
        self.robot.links.iter().position(|link| link.name == name)
    }

    pub(super) fn joint(&self, joint: usize) -> &Joint {
        &self.robot.joints[joint]
    }

    pub(super) fn child(&self, joint: usize) -> usize {
        self.child[joint]
    }

    /// The joints whose parent is this link, in the order of the document.
    pub(super) fn child_joints(&self, link: usize) -> &[usize] {
        &self.children[link]
    }

    /// From the frame of the child link, at joint angle 0, to that of the parent link.
    pub(super) fn origin(&self, joint: usize) -> IsometryMatrix3<f64> {
        let joint = self.joint(joint);
        joint.motion.map_or(joint.origin.isometry(), |motion| joint.origin.isometry() * motion)
    }

    /// The base: the root, or the child of a massless root (`world`) with one joint that is not revolute. Also the last
    /// such joint.
    pub(super) fn base(&self) -> Result<(usize, Option<usize>), UrdfError> {
        let (mut link, mut passed) = (self.root, None);
        while let [joint] = *self.child_joints(link) {
            let free = matches!(self.joint(joint).kind, JointKind::Fixed | JointKind::Floating | JointKind::Planar);
            if !free || !SpatialBody::from_link(self.link(link))?.is_massless() {
                break;
            }
            (link, passed) = (self.child(joint), Some(joint));
        }
        Ok((link, passed))
    }
}
