//! Masses and inertias that bodies of one robot seldom have.

use super::link;
use super::number::short;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout, Link};

/// Radii of gyration of bases, from a small circuit board's to a space station's, in m.
const BASES: std::ops::RangeInclusive<f64> = 1e-3..=100.0;
/// Bodies of one robot do not differ more than this in mass …
const MASSES: f64 = 1e6;
/// … and this in inertia.
const INERTIAS: f64 = 1e9;

/// What is odd about base and links.
pub(super) fn warnings(layout: &Layout) -> Vec<Warning> {
    let links = layout.arms.iter().enumerate().flat_map(|(i, arm)| {
        let links = arm.links.iter().enumerate();
        links.filter_map(move |(k, link)| link::oddity(link, &format!("arm[{i}].link[{k}]")))
    });
    let of_all = [
        light_base(layout),
        gyration(layout),
        span(layout, "mass", "kg", MASSES, layout.base.mass, |link| link.mass),
        span(layout, "inertia", "kg m²", INERTIAS, layout.base.inertia, |link| link.inertia),
    ];
    links.chain(of_all.into_iter().flatten()).collect()
}

fn light_base(layout: &Layout) -> Option<Warning> {
    let arms: f64 = layout.arms.iter().map(Arm::mass).sum();
    (layout.base.mass < arms).then(|| Warning {
        key: "base.mass".to_owned(),
        why: format!("less than the arms together have, {} kg", short(arms)),
        help: "masses are in kg; a base lighter than its arms is moved by them more than it moves them".to_owned(),
    })
}

/// Whether the base's radius of gyration is one that bodies have.
pub(super) fn has_size(layout: &Layout) -> bool {
    BASES.contains(&layout.base.radius_of_gyration())
}

fn gyration(layout: &Layout) -> Option<Warning> {
    let (mass, radius) = (layout.base.mass, layout.base.radius_of_gyration());
    (!has_size(layout)).then(|| Warning {
        key: "base.inertia".to_owned(),
        why: format!("gives a radius of gyration √(inertia / mass) of {} m, with {} kg", short(radius), short(mass)),
        help: format!("inertias are in kg m²; a square plate of that mass, 1 m × 1 m, has {}", short(mass / 6.0)),
    })
}

/// Light and heavy bodies that cannot be of one robot.
fn span(
    layout: &Layout,
    key: &str,
    unit: &str,
    widest: f64,
    base: f64,
    of: impl Fn(&Link) -> f64 + Copy,
) -> Option<Warning> {
    let links = layout.arms.iter().enumerate().flat_map(|(i, arm)| {
        let links = arm.links.iter().enumerate();
        links.map(move |(k, link)| (format!("arm[{i}].link[{k}].{key}"), of(link)))
    });
    let all: Vec<_> = std::iter::once((format!("base.{key}"), base)).chain(links).collect();
    let (least_key, least) = all.iter().min_by(|(_, a), (_, b)| a.total_cmp(b))?;
    let (most_key, most) = all.iter().max_by(|(_, a), (_, b)| a.total_cmp(b))?;
    (most / least > widest).then(|| Warning {
        key: least_key.clone(),
        why: format!("{} times smaller than `{most_key}`, {} {unit}", short(most / least), short(*most)),
        help: format!("one of them may be in another unit than {unit}"),
    })
}
