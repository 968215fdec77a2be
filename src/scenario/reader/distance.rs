//! Distances from the inertial origin that positions can be written at.

use crate::diagnostic::Value;
use crate::layout::{Arm, Layout};

/// Largest distance over the robot's reach: double precision then resolves 1e-7 of the reach.
const FARTHEST: f64 = 1e9;

/// Rejects a position [x, y] where its digits do not resolve the robot.
pub(super) fn check_distance(value: &Value<'_>, [x, y]: [f64; 2], layout: Option<&Layout>) {
    let reach = layout.iter().flat_map(|layout| &layout.arms).map(Arm::reach_from_base).fold(0.0, f64::max);
    let (distance, limit) = (x.hypot(y), FARTHEST * reach);
    if reach > 0.0 && distance > limit {
        value.reject(&format!(
            "{distance:.3e} m from the inertial origin, where 16 digits do not resolve positions of the robot, expected at \
             most {limit:.3e} m (1e9 times its reach of {reach:.3} m): count positions from a nearer origin"
        ));
    }
}
