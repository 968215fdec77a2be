//! Warnings about arms: mounts and lengths.

use super::bodies::has_size;
use super::number::short;
use super::warning;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout};

/// Largest distance of a mount from the base COM, in the base's radii of gyration.
const MAX_MOUNT_DISTANCE: f64 = 10.0;

pub(super) fn warnings(layout: &Layout) -> Vec<Warning> {
    let far = layout.arms.iter().enumerate().filter_map(|(i, arm)| far_mount(layout, i, arm));
    let shared = (0..layout.arms.len()).filter_map(|i| shared_mount(layout, i));
    let inner = layout.arms.iter().enumerate().flat_map(|(i, arm)| inner_wheels(i, arm));
    far.chain(shared).chain(inner).chain(wheels_alone(layout)).collect()
}

fn far_mount(layout: &Layout, i: usize, arm: &Arm) -> Option<Warning> {
    let (distance, radius) = (libm::hypot(arm.mount[0], arm.mount[1]), layout.base.radius_of_gyration());
    // an unlikely base, and lengths in mm, have warnings of their own
    (has_size(layout) && layout.millimetres().is_none() && distance > MAX_MOUNT_DISTANCE * radius).then(|| {
        let why = format!(
            "{} m from the base COM, {} times the base's radius of gyration √(inertia / mass), {} m",
            short(distance),
            short(distance / radius),
            short(radius)
        );
        let help = "mounts are in m from the base COM; or the base's inertia (kg m²) is too small for its mass";
        warning(format!("arm[{i}].mount"), why, help)
    })
}

#[allow(clippy::float_cmp, reason = "mounts are written down, not computed")]
fn shared_mount(layout: &Layout, i: usize) -> Option<Warning> {
    // a wheel may turn about another joint's axis
    let with_length = |arm: &&Arm| arm.reach() > 0.0;
    let arm = Some(&layout.arms[i]).filter(with_length)?;
    let other = layout.arms[..i].iter().position(|other| with_length(&other) && other.mount == arm.mount)?;
    let why = format!("`arm[{other}]` is mounted there too");
    let help = "two arms have their first joints in two places, mount = [x, y] in m from the base COM";
    Some(warning(format!("arm[{i}].mount"), why, help))
}

fn inner_wheels(i: usize, arm: &Arm) -> impl Iterator<Item = Warning> {
    let inner = arm.links.len().saturating_sub(1);
    let wheels = arm.links.iter().take(inner).enumerate().filter(|(_, link)| link.length == 0.0);
    wheels.map(move |(k, _)| {
        let why = "two joints of the arm in one place, as more links follow";
        let help = "length is the distance to the next joint, m; a reaction wheel is an arm of one link";
        warning(format!("arm[{i}].link[{k}].length"), why, help)
    })
}

fn wheels_alone(layout: &Layout) -> Option<Warning> {
    layout.arms.iter().all(|arm| arm.reach() == 0.0).then(|| {
        let why = "no link of any arm has a length: reaction wheels alone, nothing can be reached";
        warning("arm[0].link[0].length", why, "length is the distance to the next joint or to the end effector, m")
    })
}
