//! Arms that sit or end where arms seldom do.

use super::bodies::has_size;
use super::number::short;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout};

/// Arms are mounted on the base: not further out than so many of its radii of gyration.
const MOUNT: f64 = 10.0;

/// What is odd about mounts and lengths.
pub(super) fn warnings(layout: &Layout) -> Vec<Warning> {
    let far = layout.arms.iter().enumerate().filter_map(|(i, arm)| far_mount(layout, i, arm));
    let shared = (0..layout.arms.len()).filter_map(|i| shared_mount(layout, i));
    let inner = layout.arms.iter().enumerate().flat_map(|(i, arm)| inner_wheels(i, arm));
    far.chain(shared).chain(inner).chain(wheels_alone(layout)).collect()
}

fn far_mount(layout: &Layout, i: usize, arm: &Arm) -> Option<Warning> {
    let (distance, radius) = (arm.mount[0].hypot(arm.mount[1]), layout.base.radius_of_gyration());
    // where the base itself is odd, that is the one thing to say
    (has_size(layout) && distance > MOUNT * radius).then(|| Warning {
        key: format!("arm[{i}].mount"),
        why: format!(
            "{} m from the base COM, {} times the base's radius of gyration √(inertia / mass), {} m",
            short(distance),
            short(distance / radius),
            short(radius)
        ),
        help: "mounts are in m from the base COM; or the base's inertia (kg m²) is too small for its mass".to_owned(),
    })
}

#[allow(clippy::float_cmp, reason = "mounts are written down, not computed")]
fn shared_mount(layout: &Layout, i: usize) -> Option<Warning> {
    let arm = layout.arms.get(i).filter(|arm| arm.reach() > 0.0)?;
    // a wheel may turn about another joint's axis
    let other = layout.arms.iter().take(i).position(|other| other.reach() > 0.0 && other.mount == arm.mount)?;
    Some(Warning {
        key: format!("arm[{i}].mount"),
        why: format!("`arm[{other}]` is mounted there too"),
        help: "two arms have their first joints in two places, mount = [x, y] in m from the base COM".to_owned(),
    })
}

fn inner_wheels(i: usize, arm: &Arm) -> impl Iterator<Item = Warning> {
    let inner = arm.links.len().saturating_sub(1);
    let wheels = arm.links.iter().take(inner).enumerate().filter(|(_, link)| link.length == 0.0);
    wheels.map(move |(k, _)| Warning {
        key: format!("arm[{i}].link[{k}].length"),
        why: "two joints of the arm in one place, as more links follow".to_owned(),
        help: "length is the distance to the next joint, m; a reaction wheel is an arm of one link".to_owned(),
    })
}

fn wheels_alone(layout: &Layout) -> Option<Warning> {
    let none = layout.arms.iter().all(|arm| arm.reach() == 0.0);
    none.then(|| Warning {
        key: "arm[0].link[0].length".to_owned(),
        why: "no link of any arm has a length: reaction wheels alone, nothing can be reached".to_owned(),
        help: "length is the distance to the next joint or to the tip, m".to_owned(),
    })
}
