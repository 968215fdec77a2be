//! The end effectors of the arms: requested links, or massless frames at the ends of the chains.

use super::chain::ChainJoint;
use super::link_group::LinkGroup;
use super::remark::Remark;
use super::tree::Tree;
use super::{UrdfError, spatial_body::SpatialBody};
use crate::diagnostic::{listing, nearest};
use nalgebra::Vector3;

/// The end of an arm, in the frame of its last link.
pub(super) struct EndEffector {
    pub(super) position: Vector3<f64>,
    /// The link at whose frame it is.
    pub(super) name: Option<String>,
}

/// The end effectors of the arms: the requested links, else the first massless leaf fixed to the last link, else its
/// only fixed leaf, else the point at twice the distance of the centre of mass.
pub(super) fn end_effectors(
    tree: &Tree,
    arms: &[Vec<ChainJoint>],
    names: &[String],
    wanted: &[String],
    remarks: &mut Vec<Remark>,
) -> Result<Vec<EndEffector>, UrdfError> {
    let ends: Vec<&LinkGroup> = arms.iter().filter_map(|steps| steps.last().map(|step| &step.group)).collect();
    let mut asked: Vec<Option<usize>> = vec![None; ends.len()];
    for name in wanted {
        let problem = |found: &str, wanted: String| UrdfError::part("tip", name, found, wanted);
        let candidates = || {
            let arms =
                ends.iter().zip(names).map(|(g, arm)| format!("{} (arm `{arm}`)", listing(&g.names(tree), "or")));
            format!("expected a link fixed to the end of an arm: {}", arms.collect::<Vec<_>>().join(", "))
        };
        let Some(link) = tree.link_named(name) else {
            let all = ends.iter().flat_map(|group| group.names(tree));
            let meant = nearest(name, all).map(|name| format!("did you mean `{name}`? ")).unwrap_or_default();
            return Err(problem("there is no such link", meant + &candidates()));
        };
        let Some(arm) = ends.iter().position(|group| group.members.iter().any(|(member, _)| *member == link)) else {
            return Err(problem("it is not at the end of an arm", candidates()));
        };
        if let Some(other) = asked[arm].replace(link) {
            let found = format!("arm `{}` has the end effector `{}` already", names[arm], tree.link_name(other));
            return Err(problem(&found, "expected one for each arm".to_owned()));
        }
    }
    let each = ends.iter().zip(asked).zip(names);
    each.map(|((group, asked), arm)| match asked {
        Some(link) => Ok(at_link(tree, group, link)),
        None => default_end_effector(tree, group, arm, remarks),
    })
    .collect()
}

/// The end effector of an arm without requested link.
fn default_end_effector(
    tree: &Tree,
    group: &LinkGroup,
    arm: &str,
    remarks: &mut Vec<Remark>,
) -> Result<EndEffector, UrdfError> {
    let fixed = group.members.iter().skip(1).map(|(link, _)| *link);
    let mut leaves: Vec<usize> = fixed.filter(|link| tree.child_joints(*link).is_empty()).collect();
    leaves.sort_unstable();
    let mut massless = Vec::new();
    for link in &leaves {
        if SpatialBody::from_link(tree.link(*link))?.is_massless() {
            massless.push(*link);
        }
    }
    let names = |links: &[usize]| listing(&links.iter().map(|link| tree.link_name(*link)).collect::<Vec<_>>(), "and");
    match (massless.as_slice(), leaves.as_slice()) {
        ([first], _) | ([], [first]) => Ok(at_link(tree, group, *first)),
        ([first, ..], _) => {
            let all = names(&massless);
            let text = format!(
                "arm `{arm}` ends with the frames {all}; its end effector is the first in the file, `{}`; `--tip` names another",
                tree.link_name(*first)
            );
            remarks.push(Remark::note(&text));
            Ok(at_link(tree, group, *first))
        }
        ([], leaves) => {
            let why = match leaves {
                [] => "no link is fixed to its end".to_owned(),
                several => format!("{} are fixed to its end, and none of them is massless", names(several)),
            };
            let text = format!(
                "arm `{arm}` has no frame for its end effector: {why}; it is taken at twice the distance of the centre of mass of `{}`; \
                 `--tip` names a link",
                tree.link_name(group.link)
            );
            remarks.push(Remark::note(&text));
            Ok(EndEffector { position: group.body.com * 2.0, name: None })
        }
    }
}

fn at_link(tree: &Tree, group: &LinkGroup, link: usize) -> EndEffector {
    let (_, frame) = group.members.iter().find(|(member, _)| *member == link).expect("the link belongs to the group");
    EndEffector { position: frame.translation.vector, name: Some(tree.link_name(link).to_owned()) }
}
