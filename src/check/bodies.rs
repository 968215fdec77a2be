//! Warnings about masses and inertias of base and links.

use super::link;
use super::number::short;
use super::warning;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout, Link, Millimetres};

/// Radii of gyration of bases, from a small circuit board's to a space station's, m.
const BASE_RADII: std::ops::RangeInclusive<f64> = 1e-3..=100.0;
/// Largest radius of gyration of a base without an outline, in reaches of its arms.
const MAX_BASE_SIZE: f64 = 2.0;
/// Largest ratio of the longest link to the next longest one.
const MAX_LENGTH_RATIO: f64 = 50.0;
/// Largest ratio of two masses of one robot.
const MAX_MASS_RATIO: f64 = 1e6;
/// Largest ratio of two inertias of one robot.
const MAX_INERTIA_RATIO: f64 = 1e9;

pub(super) fn warnings(layout: &Layout) -> Vec<Warning> {
    // what follows from all lengths is not said of each
    if let Some(lengths) = millimetres(layout) {
        return [Some(lengths), light_base(layout)].into_iter().flatten().collect();
    }
    let links = layout.arms.iter().enumerate().flat_map(|(i, arm)| {
        let links = arm.links.iter().enumerate();
        links.filter_map(move |(k, link)| link::check(link, &format!("arm[{i}].link[{k}]")))
    });
    let of_all = [
        light_base(layout),
        gyration(layout),
        ratio(layout, "mass", "kg", MAX_MASS_RATIO, layout.base.mass, |link| link.mass),
        ratio(layout, "inertia", "kg m²", MAX_INERTIA_RATIO, layout.base.inertia, |link| link.inertia),
    ];
    links.chain(long_links(layout)).chain(of_all.into_iter().flatten()).collect()
}

fn millimetres(layout: &Layout) -> Option<Warning> {
    let Millimetres { arm, link, why, help } = layout.millimetres()?;
    Some(warning(format!("arm[{arm}].link[{link}].length"), format!("{why}: lengths look like mm"), help))
}

fn light_base(layout: &Layout) -> Option<Warning> {
    let arms: f64 = layout.arms.iter().map(Arm::mass).sum();
    (layout.base.mass < arms).then(|| {
        let why = format!("less than the arms together have, {} kg", short(arms));
        let help = "masses are in kg; a base lighter than its arms is moved by them more than it moves them";
        warning("base.mass", why, help)
    })
}

/// Whether the base's radius of gyration is realistic.
pub(super) fn has_size(layout: &Layout) -> bool {
    BASE_RADII.contains(&layout.base.radius_of_gyration())
}

fn gyration(layout: &Layout) -> Option<Warning> {
    let (mass, radius) = (layout.base.mass, layout.base.radius_of_gyration());
    let reach = layout.reach_from_base();
    // no body's is larger than the distance of its farthest point
    let beyond = match &layout.base.outline {
        Some(outline) => (radius > outline.reach() * (1.0 + 1e-9)).then(|| {
            format!(", more than the largest distance of its outline from the COM, {} m", short(outline.reach()))
        }),
        None => (radius > MAX_BASE_SIZE * reach && reach > 0.0).then(|| {
            format!(", {} times what the arms reach from the base COM, {} m", short(radius / reach), short(reach))
        }),
    };
    (!has_size(layout) || beyond.is_some()).then(|| {
        let why = format!(
            "gives a radius of gyration √(inertia / mass) of {} m, with {} kg{}",
            short(radius),
            short(mass),
            beyond.unwrap_or_default()
        );
        let help = format!("inertias are in kg m²; a square plate of that mass, 1 m × 1 m, has {}", short(mass / 6.0));
        warning("base.inertia", why, help)
    })
}

/// Links far longer than all others, of any arm: lengths in another unit.
fn long_links(layout: &Layout) -> Vec<Warning> {
    let Some((long, next)) = layout.longest_links() else { return Vec::new() };
    let others = if long.len() > 1 { "longest link with another length" } else { "next longest link" };
    let far = long.into_iter().filter_map(|[arm, link]| {
        let length = layout.arms[arm].links[link].length;
        (length > MAX_LENGTH_RATIO * next).then(|| {
            let why = format!("{} times as long as the {others}, {} m", short(length / next), short(next));
            let help = format!("lengths are in m; {} mm are {} m", short(length), short(length / 1000.0));
            warning(format!("arm[{arm}].link[{link}].length"), why, help)
        })
    });
    far.collect()
}

/// Bodies too different in size for one robot.
fn ratio(
    layout: &Layout,
    key: &str,
    unit: &str,
    largest: f64,
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
    (most / least > largest).then(|| {
        let why = format!("{} times smaller than `{most_key}`, {} {unit}", short(most / least), short(*most));
        warning(least_key.as_str(), why, format!("one of them may be in another unit than {unit}"))
    })
}
