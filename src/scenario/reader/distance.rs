//! Distances from the inertial origin that positions can be written at, and sizes that distances can be computed of.

use crate::diagnostic::{Table, Value};
use crate::layout::{Arm, Layout};
use crate::outline::Outline;

/// Largest distance over the robot's reach: double precision then resolves 1e-7 of the reach.
const FARTHEST: f64 = 1e9;

/// Largest outline of a target over the robot's reach: every motion of a larger one moves its rim by more than the
/// robot.
const LARGEST: f64 = 1e6;

/// Rejects a position [x, y] where its digits do not resolve the robot.
pub(super) fn check_distance(value: &Value<'_>, [x, y]: [f64; 2], layout: Option<&Layout>) {
    let reach = reach(layout);
    let (distance, limit) = (x.hypot(y), FARTHEST * reach);
    if reach > 0.0 && distance > limit {
        value.reject(&format!(
            "{distance:.3e} m from the inertial origin, where 16 digits do not resolve positions of the robot, expected at \
             most {limit:.3e} m (1e9 times its reach of {reach:.3} m): count positions from a nearer origin"
        ));
    }
}

/// Whether a target's `radius` or `polygon` is not far larger than the robot; rejects it otherwise.
pub(super) fn check_size(table: &Table<'_>, outline: &Outline, layout: Option<&Layout>) -> bool {
    let (size, reach) = (outline.reach(), reach(layout));
    let is_fine = reach == 0.0 || size <= LARGEST * reach;
    if let Some(value) = table.get("polygon").or_else(|| table.get("radius")).filter(|_| !is_fine) {
        let most = LARGEST * reach;
        value.reject(&format!(
            "{size:.3e} m from the COM, expected at most {most:.3e} m (1e6 times the robot's reach of {reach:.3} m)"
        ));
    }
    is_fine
}

/// Of the robot's end effectors from its base's COM, m; 0 for one without arms.
fn reach(layout: Option<&Layout>) -> f64 {
    layout.iter().flat_map(|layout| &layout.arms).map(Arm::reach_from_base).fold(0.0, f64::max)
}
