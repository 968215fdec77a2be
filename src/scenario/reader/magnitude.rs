//! Distances, sizes and masses that 16 digits resolve beside the robot's.

use crate::diagnostic::{Table, Value};
use crate::layout::Layout;
use crate::outline::Outline;

/// Largest distance over the robot's reach: double precision then resolves 1e-7 of the reach.
const FARTHEST: f64 = 1e9;

/// Largest outline of a target over the robot's reach: every motion of a larger one moves its rim by more than the
/// robot.
const LARGEST: f64 = 1e6;

/// Rejects a position [x, y] where its digits do not resolve the robot.
pub(super) fn check_distance(value: &Value<'_>, [x, y]: [f64; 2], layout: Option<&Layout>) {
    let reach = reach(layout);
    let (distance, limit) = (libm::hypot(x, y), FARTHEST * reach);
    if reach > 0.0 && distance > limit {
        value.reject(&format!(
            "{distance:.3e} m from the inertial origin, where 16 digits do not resolve positions of the robot, expected at \
             most {limit:.3e} m (1e9 times its reach of {reach:.3} m): count positions from a nearer origin"
        ));
    }
}

/// Rejects a contact point [rx, ry] as far from its target's COM as no outline is.
pub(super) fn check_contact(value: &Value<'_>, [x, y]: [f64; 2], layout: Option<&Layout>) -> Option<[f64; 2]> {
    let (distance, reach) = (libm::hypot(x, y), reach(layout));
    let most = LARGEST * reach;
    if reach > 0.0 && distance > most {
        value.reject(&format!(
            "{distance:.3e} m from the COM, expected at most {most:.3e} m (1e6 times the robot's reach of {reach:.3} m)"
        ));
        return None;
    }
    Some([x, y])
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

/// Smallest and largest ratio of mass or inertia to the robot's: impacts have the sum of both.
const RATIOS: [f64; 2] = [1e-15, 1e12];

/// Whether a target's `mass`, or its `inertia`, is comparable with that of the robot; rejects it otherwise.
pub(super) fn check_mass(table: &Table<'_>, key: &str, found: f64, layout: Option<&Layout>) -> bool {
    let reach = reach(layout);
    let (arm, unit) = if key == "mass" { (1.0, "kg") } else { (reach * reach, "kg m²") };
    let own = layout.map_or(0.0, Layout::mass) * arm;
    let [least, most] = RATIOS.map(|ratio| ratio * own);
    let is_fine = own == 0.0 || (least..=most).contains(&found);
    if let Some(value) = table.get(key).filter(|_| !is_fine) {
        value.reject(&format!(
            "expected {least:.1e} to {most:.1e} {unit}, 1e-15 to 1e12 times that of the robot, {own:.3e}"
        ));
    }
    is_fine
}

/// Of the robot's end effectors from its base's COM, m; 0 for one without arms.
fn reach(layout: Option<&Layout>) -> f64 {
    layout.map_or(0.0, Layout::reach_from_base)
}

#[cfg(test)]
mod tests {
    use crate::registry;
    use crate::scenario::Scenario;

    /// Of `single_arm_2r`: kg, and m from its base's COM.
    const ROBOT: [f64; 2] = [210.0, 1.9];

    fn is_fine(mass: f64, inertia: f64) -> bool {
        let text = format!(
            "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.4, -0.9]\n[approach]\nduration = 1.0\n\
             trajectory = \"cycloidal\"\nfinal_joint_angles = [0.4, -0.9]\n[[target]]\nname = \"disc\"\narm = \"arm1\"\n\
             mass = {mass:e}\ninertia = {inertia:e}\ncontact = [0.0, 0.5]\nradius = 0.5\n[post_impact]\nduration = 1.0\n"
        );
        match Scenario::parse(&text, "it.toml", "".as_ref(), registry::SHIPPED) {
            Ok(_) => true,
            Err(report) => {
                let said = report.to_string();
                assert!(said.contains("1e-15 to 1e12 times that of the robot"), "{said}");
                false
            }
        }
    }

    #[test]
    fn masses_and_inertias_are_accepted_up_to_their_bounds() {
        let [mass, reach] = ROBOT;
        let inertia = mass * reach * reach;
        for (bound, inside, beyond) in [(1e12, 0.999, 1.001), (1e-15, 1.001, 0.999)] {
            let found = [inside, beyond].map(|part| is_fine(part * bound * mass, 0.5 * inertia));
            assert_eq!(found, [true, false], "mass, {bound}");
            let found = [inside, beyond].map(|part| is_fine(0.5 * mass, part * bound * inertia));
            assert_eq!(found, [true, false], "inertia, {bound}");
        }
    }
}
