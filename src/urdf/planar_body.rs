//! Bodies as the plane sees them, and what it does not see.

use super::UrdfError;
use super::document::Remark;
use super::group::Group;
use super::plane::Plane;
use super::tree::Tree;

/// What two centres of mass may differ in height, m: rounding of files with nine digits or more.
const FLAT: f64 = 1e-9;
/// What products of inertia with the normal may be, of the moment of inertia about it: the same.
const BALANCED: f64 = 1e-9;

/// Mass, centre of mass and inertia in a plane.
#[derive(Clone, Debug)]
pub(super) struct PlanarBody {
    link: String,
    pub(super) mass: f64,
    /// In the plane's axes of the group.
    pub(super) com: [f64; 2],
    /// About the normal through the centre of mass.
    pub(super) inertia: f64,
    /// Of the centre of mass above the frame of the base.
    height: f64,
    /// Of inertia, with the normal.
    products: [f64; 2],
}

impl PlanarBody {
    /// Of a group whose frame stands at a height; it must have mass and inertia.
    pub(super) fn of(tree: &Tree, group: &Group, plane: &Plane, height: f64) -> Result<Self, UrdfError> {
        let (com, above) = plane.project(&group.body.com);
        let (products, inertia) = plane.project(&(group.body.inertia * plane.normal.into_inner()));
        let mass = group.body.mass;
        let link = tree.link_name(group.link);
        let fixed = group.names(tree).len() - 1;
        let with = if fixed > 0 { format!(", with the {fixed} fixed to it,") } else { String::new() };
        if mass <= 0.0 {
            let found = format!("it moves{with} and its mass is {mass:?} kg");
            return Err(UrdfError::link(link, found, "expected more than 0, in <inertial> (missing, it is 0)"));
        }
        if inertia <= 0.0 {
            let found = format!("its moment of inertia{with} about the plane's normal is {inertia:?} kg m²");
            return Err(UrdfError::link(link, found, "expected more than 0"));
        }
        Ok(Self { link: link.to_owned(), mass, com, inertia, height: height + above, products })
    }
}

/// Warnings of what makes a robot without supports leave the plane.
pub(super) fn remarks(planar_bodies: &[PlanarBody]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let highest = planar_bodies.iter().fold(f64::NEG_INFINITY, |most, planar_body| most.max(planar_body.height));
    let lowest = planar_bodies.iter().fold(f64::INFINITY, |least, planar_body| least.min(planar_body.height));
    if highest - lowest > FLAT {
        let heights: Vec<String> = planar_bodies.iter().map(|o| format!("`{}` {:?} m", o.link, o.height)).collect();
        remarks.push(Remark::warning(&format!(
            "the robot would leave the plane: centres of mass are at different heights along its normal: {}",
            heights.join(", ")
        )));
    }
    let skew = planar_bodies.iter().filter(|o| o.products[0].hypot(o.products[1]) > BALANCED * o.inertia);
    let skew: Vec<String> = skew.map(|o| format!("`{}` {:?} kg m²", o.link, o.products)).collect();
    if !skew.is_empty() {
        remarks.push(Remark::warning(&format!(
            "the robot would leave the plane: products of inertia with its normal: {}",
            skew.join(", ")
        )));
    }
    remarks
}
