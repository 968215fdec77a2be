//! Projections of bodies on the plane of motion, and warnings of bodies that would leave it.

use super::UrdfError;
use super::link_group::LinkGroup;
use super::plane::Plane;
use super::remark::Remark;
use super::tree::Tree;

/// Largest difference in height of centres of mass, m: rounding of files with nine digits.
const MAX_HEIGHT_DIFFERENCE: f64 = 1e-9;
/// Largest product of inertia with the normal over the moment of inertia about it.
const MAX_PRODUCT: f64 = 1e-9;

/// Mass, centre of mass and moment of inertia in the plane.
#[derive(Clone, Debug)]
pub(super) struct PlanarBody {
    link: String,
    pub(super) mass: f64,
    /// In the plane's axes of the group.
    pub(super) com: [f64; 2],
    /// About the normal through the centre of mass.
    pub(super) inertia: f64,
    /// Of the centre of mass above the frame of the base, m.
    height: f64,
    /// Products of inertia with the normal, kg m².
    products: [f64; 2],
}

impl PlanarBody {
    /// Of a group whose frame has this height, m.
    ///
    /// # Errors
    /// [`UrdfError::Part`] without mass or moment of inertia.
    pub(super) fn new(tree: &Tree, group: &LinkGroup, plane: &Plane, height: f64) -> Result<Self, UrdfError> {
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

/// Warnings of heights and products of inertia by which a free robot would leave the plane.
pub(super) fn remarks(bodies: &[PlanarBody]) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let highest = bodies.iter().map(|body| body.height).fold(f64::NEG_INFINITY, f64::max);
    let lowest = bodies.iter().map(|body| body.height).fold(f64::INFINITY, f64::min);
    if highest - lowest > MAX_HEIGHT_DIFFERENCE {
        let heights: Vec<String> = bodies.iter().map(|o| format!("`{}` {:?} m", o.link, o.height)).collect();
        remarks.push(Remark::warning(&format!(
            "the robot would leave the plane: centres of mass are at different heights along its normal: {}",
            heights.join(", ")
        )));
    }
    let skew = bodies.iter().filter(|o| o.products[0].hypot(o.products[1]) > MAX_PRODUCT * o.inertia);
    let skew: Vec<String> = skew.map(|o| format!("`{}` {:?} kg m²", o.link, o.products)).collect();
    if !skew.is_empty() {
        remarks.push(Remark::warning(&format!(
            "the robot would leave the plane: products of inertia with its normal: {}",
            skew.join(", ")
        )));
    }
    remarks
}
