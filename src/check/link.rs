//! Links that no body of their length can be.

use super::number::short;
use crate::diagnostic::Warning;
use crate::layout::Link;

/// A link whose radius of gyration is a smaller part of its length has its mass nearly in one point.
const POINT: f64 = 0.01;

/// (key, why, help)
type Odd = (&'static str, String, String);

/// The first that is odd about a link; `path` is that of its table.
pub(super) fn oddity(link: &Link, path: &str) -> Option<Warning> {
    let found = match link.length {
        0.0 => unbalanced(link),
        _ => com_outside(link).or_else(|| too_much(link)).or_else(|| point_mass(link)),
    };
    found.map(|(key, why, help)| Warning { key: format!("{path}.{key}"), why, help })
}

fn unbalanced(wheel: &Link) -> Option<Odd> {
    (wheel.com[0].hypot(wheel.com[1]) > 0.0).then(|| {
        let why = "a wheel (a link of length 0) whose COM is not on its axle";
        ("com", why.to_owned(), "a balanced wheel has com = [0, 0]; other links have a length".to_owned())
    })
}

fn com_outside(link: &Link) -> Option<Odd> {
    let Link { length, com: [x, y], .. } = *link;
    (x < 0.0 || x > length || y.abs() > length).then(|| {
        let why = format!("the COM is outside the link, which is {} m long", short(length));
        let middle = short(length / 2.0);
        let help = format!(
            "com is in m from the link's joint, x towards the link's end: [{middle}, 0] is mid-link, the default"
        );
        ("com", why, help)
    })
}

/// The variance of a mass on [0, L] with mean c is at most c (L − c), all of it being at the two ends (Bhatia & Davis).
/// Across the link, a COM at y speaks of a body between 0 and 2 y: y² by the same rule.
fn too_much(link: &Link) -> Option<Odd> {
    let Link { length, mass, inertia, com: [x, y] } = *link;
    let most = mass * (x * (length - x) + y * y);
    (inertia > most * (1.0 + 1e-9)).then(|| {
        let formula = if y == 0.0 { "mass · x · (length − x)" } else { "mass · (x · (length − x) + y²)" };
        let why = format!(
            "more than {} kg m², the most that a body of this mass, length and COM [x, y] can have: {formula}",
            short(most)
        );
        let about_com = inertia - mass * (x * x + y * y);
        let help = if most <= 0.0 {
            let middle = short(length / 2.0);
            format!(
                "a COM at an end of the link leaves nothing but a point mass there: com = [{middle}, 0] is mid-link"
            )
        } else if about_com > 0.0 && about_com <= most {
            format!(
                "inertias are about the COM: if this one is about the joint, it is {} about the COM",
                short(about_com)
            )
        } else {
            format!(
                "inertias are about the COM, in kg m²; a uniform rod has mass · length² / 12 = {}",
                short(rod(link))
            )
        };
        ("inertia", why, help)
    })
}

fn point_mass(link: &Link) -> Option<Odd> {
    let radius = (link.inertia / link.mass).sqrt();
    (radius < POINT * link.length).then(|| {
        let why = format!(
            "a radius of gyration √(inertia / mass) of {} m in a link of {} m, nearly a point mass",
            short(radius),
            short(link.length)
        );
        let rod = short(rod(link));
        ("inertia", why, format!("lengths are in m, inertias in kg m²; a uniform rod has mass · length² / 12 = {rod}"))
    })
}

/// kg m².
fn rod(link: &Link) -> f64 {
    link.mass * link.length * link.length / 12.0
}
