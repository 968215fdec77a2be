//! Masses and inertias of one robot that 16 digits resolve beside each other.

use planar_dynamics::manifest::ParameterKind;

/// Largest ratio of the base's mass to that of all arms together.
const BASE_RATIO: f64 = 1e9;

/// Largest ratio of a link's I + m · reach² to that of all other bodies together: errors of accelerations grow with it and
/// reach 1e-8 to 6e-8 here. A light body loses nothing, for it is the others' inertia that differences are taken of.
const LINK_RATIO: f64 = 1e5;

/// Mass in kg and moment of inertia about the centre of mass in kg m².
#[derive(Clone, Copy)]
pub(crate) struct Inertia {
    pub mass: f64,
    pub inertia: f64,
}

/// A body that is too heavy or moves too lightly for the others: what of it, of which arm and link, its value, and why.
pub(crate) struct Disproportion {
    pub kind: ParameterKind,
    pub arm: usize,
    pub link: usize,
    pub value: f64,
    pub why: String,
}

/// The first body beside which the others are lost. `arms` has the links of each arm.
pub(crate) fn disproportion(base: Inertia, arms: &[Vec<Inertia>], reach: f64) -> Option<Disproportion> {
    let arms = arms.iter().enumerate();
    let links: Vec<_> =
        arms.flat_map(|(i, links)| links.iter().enumerate().map(move |(k, link)| ((i, k), *link))).collect();
    let arms: f64 = links.iter().map(|(_, link)| link.mass).sum();
    if base.mass > BASE_RATIO * arms {
        let wanted = format!("{:.3e} kg, {BASE_RATIO:e} times the mass of all arms", BASE_RATIO * arms);
        return Some(too_large(ParameterKind::BaseMass, (0, 0), base.mass, &wanted));
    }
    let comparable = |body: Inertia| body.inertia + body.mass * reach * reach;
    let of_links: Vec<f64> = links.iter().map(|(_, link)| comparable(*link)).collect();
    let others = sums_of_others(comparable(base), &of_links);
    links.iter().zip(of_links).zip(others).find_map(|(((place, link), own), others)| {
        let most = LINK_RATIO * others;
        (own > most).then(|| {
            let by_mass = link.inertia < 0.5 * own;
            let (kind, value, share, unit) = if by_mass {
                (ParameterKind::LinkMass, link.mass, most / (reach * reach), "kg")
            } else {
                (ParameterKind::LinkInertia, link.inertia, most, "kg m²")
            };
            let wanted = format!(
                "about {share:.3e} {unit}: inertia + mass · reach² is {own:.3e} kg m², more than {LINK_RATIO:e} times that \
                 of all other bodies together, {others:.3e} kg m²"
            );
            too_large(kind, *place, value, &wanted)
        })
    })
}

fn too_large(kind: ParameterKind, (arm, link): (usize, usize), value: f64, most: &str) -> Disproportion {
    let why = format!("16 digits do not resolve the motion of the other bodies beside it, expected at most {most}");
    Disproportion { kind, arm, link, value, why }
}

/// For each link the sum over the base and all other links; not a difference of the total, of which a heavy link leaves
/// nothing.
fn sums_of_others(base: f64, of_links: &[f64]) -> Vec<f64> {
    let mut sums = Vec::with_capacity(of_links.len());
    let mut before = base;
    for value in of_links {
        sums.push(before);
        before += value;
    }
    let mut after = 0.0;
    for (sum, value) in sums.iter_mut().zip(of_links).rev() {
        *sum += after;
        after += value;
    }
    sums
}
