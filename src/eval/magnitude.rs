//! Angles and masses that 16 digits resolve in the results.

use crate::layout::Layout;

/// rad; the directions of links are sums of angles, whose rounding is then 1e-10 rad.
const LARGEST_ANGLE: f64 = 1e6;

/// Largest ratio of a target's mass or inertia to the robot's: the reduced impact matrix has the sum of both, and the
/// joint rates that follow from it have errors of 1e-16 times this ratio, and up to a thousand times that.
const LARGEST_RATIO: f64 = 1e6;

/// What is wanted in place of an angle that is too large.
pub(super) fn wrong_angle(angle: f64) -> Option<String> {
    (angle.abs() > LARGEST_ANGLE).then(|| {
        format!(
            "an angle of at most {LARGEST_ANGLE:e} rad, beyond which 16 digits do not resolve it: without whole turns"
        )
    })
}

/// What is wanted in place of the `mass`, or the `inertia`, of a target that is too heavy for the robot.
pub(super) fn wrong_mass(layout: &Layout, key: &str, found: f64) -> Option<String> {
    let reach = layout.reach_from_base();
    let (mass, gyration) = (layout.mass(), layout.base.radius_of_gyration());
    let (own, unit) = if key == "mass" { (mass, "kg") } else { (mass * reach.max(gyration).powi(2), "kg m²") };
    let most = LARGEST_RATIO * own;
    (found > most).then(|| {
        format!(
            "at most {most:.3e} {unit}, {LARGEST_RATIO:e} times that of the robot, {own:.3e}, whose motion is lost \
                 beside a heavier one"
        )
    })
}
