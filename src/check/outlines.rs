//! Warnings about outlines: in another unit than m.

use super::number::short;
use super::warning;
use crate::diagnostic::Warning;
use crate::layout::Layout;
use crate::outline::Outline;

/// Farthest point of a base's outline, in what the arms reach from its COM: solar panels are longer than arms.
const MAX_BASE_REACH: f64 = 50.0;
/// Farthest point of a link's outline from its joint, the same.
const MAX_LINK_REACH: f64 = 5.0;

pub(super) fn warnings(layout: &Layout) -> Vec<Warning> {
    let robot = layout.reach_from_base();
    let far = |key: String, of: &str, outline: Option<&Outline>, most: f64| {
        let reach = outline?.reach();
        (robot > 0.0 && reach > most * robot).then(|| {
            let times = short(reach / robot);
            let why = format!(
                "goes up to {} m from {of}, {times} times what the arms reach from the base COM, {} m",
                short(reach),
                short(robot)
            );
            let help = format!("outlines are in m; {} mm are {} m", short(reach), short(reach / 1000.0));
            warning(key, why, help)
        })
    };
    let base = far("base.outline".to_owned(), "the base COM", layout.base.outline.as_ref(), MAX_BASE_REACH);
    let links = layout.arms.iter().enumerate().flat_map(|(i, arm)| {
        let links = arm.links.iter().enumerate();
        links.map(move |(k, link)| (format!("arm[{i}].link[{k}].outline"), link.outline.as_ref()))
    });
    base.into_iter().chain(links.filter_map(|(key, outline)| far(key, "its joint", outline, MAX_LINK_REACH))).collect()
}
