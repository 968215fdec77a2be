//! The velocity of an end effector relative to its contact point, and the direction of the effective masses.

use super::*;
use crate::contact::ContactLaw;
use crate::registry;
use planar_proof::{assert_close, layout, tolerance};

fn of(twist: [f64; 3], law: ContactLaw<f64>) -> (ContactResponse, [f64; 3]) {
    moving([0.0; 2], twist, law)
}

/// Of a robot that has a velocity beside its own.
fn moving([vx, vy]: [f64; 2], twist: [f64; 3], law: ContactLaw<f64>) -> (ContactResponse, [f64; 3]) {
    let model = registry::generic(&layout("single_arm_2r"));
    let state = RobotState {
        base_pose: [0.2, -0.4, 0.7],
        joint_angles: vec![0.4, -0.9],
        base_twist: [0.3, 0.2 + vx, -0.1 + vy],
        joint_rates: vec![-1.2, 2.5],
    };
    let mut end_effectors = [[0.0; 3]];
    model.end_effector_twists(&state.view(), &mut end_effectors).expect("twists");
    let target = Body { mass: 4.0, inertia: 0.5, pose: [0.3, 1.0, 2.0], twist };
    let touch = ImpactContact { target: 0, arm: 0, law, offset: [0.3, -0.2], miss: 0.0 };
    (response(&*model, &state, &target, &touch).expect("a response"), end_effectors[0])
}

/// A target that turns with ω has the velocity v + ω (−ry, rx) at r.
#[test]
fn velocities_are_of_the_contact_point() {
    let (found, [omega, x, y]) = of([0.5, 1.0, 2.0], ContactLaw::Rigid);
    let relative = [omega - 0.5, x - 1.1, y - 2.15];
    assert_close("relative twist", &found.relative_twist, &relative, tolerance::POLYNOMIAL);
    let speed = relative[1].hypot(relative[2]);
    let direction = found.direction.expect("it moves");
    assert_close("direction", &direction, &[relative[1] / speed, relative[2] / speed], tolerance::POLYNOMIAL);
    let bounce = ContactLaw::Bounce { normal: [0.6, 0.8], restitution: 0.5 };
    assert_eq!(of([0.5, 1.0, 2.0], bounce).0.direction, Some([0.6, 0.8]));
}

/// Without a relative velocity there is no direction, and nothing along it.
#[test]
fn a_contact_at_rest_has_no_direction() {
    let (_, [_, x, y]) = of([0.0; 3], ContactLaw::Rigid);
    let (found, _) = of([0.0, x, y], ContactLaw::Rigid);
    assert_eq!((found.direction, found.effective_masses, found.impulse_index), (None, None, None));
    // what an integration leaves is none, and a slow approach is one
    let (found, _) = of([0.0, x + 1e-10, y - 3e-10], ContactLaw::Rigid);
    assert_eq!((found.direction, found.effective_masses, found.impulse_index), (None, None, None));
    let (found, _) = of([0.0, x + 3e-5, y - 4e-5], ContactLaw::Rigid);
    let direction = found.direction.expect("a direction");
    assert!((direction[0] + 0.6).abs() < 1e-9 && (direction[1] - 0.8).abs() < 1e-9, "{direction:?}");
}

/// The speed of an orbit, which robot and target have together, does not hide a millimetre per second between them.
#[test]
fn a_common_velocity_hides_no_direction() {
    let orbit = [4500.0, 6000.0];
    let (_, [_, x, y]) = moving(orbit, [0.0; 3], ContactLaw::Rigid);
    let (found, _) = moving(orbit, [0.0, x + 6e-4, y - 8e-4], ContactLaw::Rigid);
    let direction = found.direction.expect("a direction");
    // 7.5 km/s are rounded to 1e-12 m/s
    assert!((direction[0] + 0.6).abs() < 1e-8 && (direction[1] - 0.8).abs() < 1e-8, "{direction:?}");
}

/// Along a direction n the target has at its contact point the mass of 1/m = 1/M + (r × n)²/I, and both bodies that of the
/// sum of the reciprocals, which is what stops a bounce.
#[test]
fn masses_are_those_at_the_contact_point() {
    let (found, _) = of([0.5, 1.0, 2.0], ContactLaw::Bounce { normal: [0.6, 0.8], restitution: 0.5 });
    let [robot, target, both] = found.effective_masses.expect("a direction");
    let lever: f64 = 0.3 * 0.8 + 0.2 * 0.6;
    assert_close("target", &[target], &[1.0 / (0.25 + lever * lever / 0.5)], tolerance::POLYNOMIAL);
    assert_close("both", &[both], &[1.0 / (1.0 / robot + 1.0 / target)], tolerance::POLYNOMIAL);
    assert_close("index", &[found.impulse_index.expect("a direction")], &[both], tolerance::POLYNOMIAL);
}
