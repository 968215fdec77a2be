//! Warnings about links: centre of mass and inertia against the length.

use super::number::short;
use super::warning;
use crate::diagnostic::Warning;
use crate::layout::Link;

/// Smallest radius of gyration of a link, relative to its length.
const MIN_RADIUS: f64 = 0.01;

/// The first warning about a link; `path` is that of its table.
pub(super) fn check(link: &Link, path: &str) -> Option<Warning> {
    match link.length {
        0.0 => unbalanced(link, path),
        _ => com_outside(link, path).or_else(|| large_inertia(link, path)).or_else(|| point_mass(link, path)),
    }
}

fn unbalanced(wheel: &Link, path: &str) -> Option<Warning> {
    (libm::hypot(wheel.com[0], wheel.com[1]) > 0.0).then(|| {
        let why = "a wheel (a link of length 0) whose COM is not on its axle";
        warning(format!("{path}.com"), why, "a balanced wheel has com = [0, 0]; other links have a length")
    })
}

fn com_outside(link: &Link, path: &str) -> Option<Warning> {
    let Link { length, com: [x, y], .. } = *link;
    (x < 0.0 || x > length || y.abs() > length).then(|| {
        let why = format!("the COM is outside the link, which is {} m long", short(length));
        let help = format!(
            "com is in m from the link's joint, x towards the link's end: [{}, 0] is mid-link, the default",
            short(length / 2.0)
        );
        warning(format!("{path}.com"), why, help)
    })
}

/// The variance of a mass on [0, L] with mean c is at most c (L − c), that of two point masses at the ends (Bhatia &
/// Davis). Across the link, a COM at y is that of a body between 0 and 2 y: at most y² by the same rule.
fn large_inertia(link: &Link, path: &str) -> Option<Warning> {
    let Link { length, mass, inertia, com: [x, y], .. } = *link;
    let largest = mass * (x * (length - x) + y * y);
    (inertia > largest * (1.0 + 1e-9)).then(|| {
        let formula = if y == 0.0 { "mass · x · (length − x)" } else { "mass · (x · (length − x) + y²)" };
        let why = format!(
            "more than {} kg m², the most that a body of this mass, length and COM [x, y] can have: {formula}",
            short(largest)
        );
        let about_com = inertia - mass * (x * x + y * y);
        let help = if largest <= 0.0 {
            let middle = short(length / 2.0);
            format!(
                "a COM at an end of the link leaves nothing but a point mass there: com = [{middle}, 0] is mid-link"
            )
        } else if about_com > 0.0 && about_com <= largest {
            let about_com = short(about_com);
            format!("inertias are about the COM: if this one is about the joint, it is {about_com} about the COM")
        } else {
            let rod = short(rod_inertia(link));
            format!("inertias are about the COM, in kg m²; a uniform rod has mass · length² / 12 = {rod}")
        };
        warning(format!("{path}.inertia"), why, help)
    })
}

fn point_mass(link: &Link, path: &str) -> Option<Warning> {
    let radius = (link.inertia / link.mass).sqrt();
    (radius < MIN_RADIUS * link.length).then(|| {
        let why = format!(
            "a radius of gyration √(inertia / mass) of {} m in a link of {} m, nearly a point mass",
            short(radius),
            short(link.length)
        );
        let rod = short(rod_inertia(link));
        let help = format!("lengths are in m, inertias in kg m²; a uniform rod has mass · length² / 12 = {rod}");
        warning(format!("{path}.inertia"), why, help)
    })
}

/// Of a uniform rod with the link's mass and length about its COM, kg m².
fn rod_inertia(link: &Link) -> f64 {
    link.mass * link.length * link.length / 12.0
}
