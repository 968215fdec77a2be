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
    /// Of a group whose frame has this height, m; an error without mass or moment of inertia.
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
    let highest = bodies.iter().map(|body| body.height).fold(f64::NEG_INFINITY, f64::max);
    let lowest = bodies.iter().map(|body| body.height).fold(f64::INFINITY, f64::min);
    let apart = bodies.iter().filter(|_| highest - lowest > MAX_HEIGHT_DIFFERENCE);
    let heights = apart.map(|body| format!("`{}` {:?} m", body.link, body.height));
    let skew =
        bodies.iter().filter(|body| libm::hypot(body.products[0], body.products[1]) > MAX_PRODUCT * body.inertia);
    let products = skew.map(|body| format!("`{}` {:?} kg m²", body.link, body.products));
    let [height_fact, product_fact] = [
        "the robot would leave the plane: centres of mass are at different heights along its normal",
        "the robot would leave the plane: products of inertia with its normal",
    ];
    let heights = Remark::of_items(Remark::warning, height_fact, ", ", heights);
    heights.into_iter().chain(Remark::of_items(Remark::warning, product_fact, ", ", products)).collect()
}
