//! Momentum, velocity and inertia of robot and held bodies against the motion of each of them.

use super::*;
use crate::registry;
use planar_proof::{assert_close, layout, tolerance};

/// Σ m v over Σ m, and the inertia by whose rate the whole would have its angular momentum as one body.
#[test]
fn the_whole_moves_as_its_bodies() {
    let model = registry::generic(&layout("dual_arm_2r"));
    let state = RobotState {
        base_pose: [0.2, -0.4, 0.7],
        joint_angles: vec![0.4, -0.9, 2.5, 1.2],
        base_twist: [0.3, 0.2, -0.1],
        joint_rates: vec![-1.2, 2.5, 0.7, -3.5],
    };
    let held = [Body { mass: 40.0, inertia: 5.0, pose: [0.3, 3.0, -2.0], twist: [0.4, 0.5, 0.6] }];
    let wheels = [false, false, true, true];
    let found = ResidualMotion::of(&*model, &held, "none", &state, &wheels).expect("a motion");
    let all = bodies(&*model, &state.view(), &held).expect("bodies");
    let sum = |of: &dyn Fn(&Body) -> f64| all.iter().map(of).sum::<f64>();
    let mass = sum(&|body| body.mass);
    let [x, y] = [1, 2].map(|i: usize| sum(&|body| body.mass * body.pose[i]) / mass);
    let [vx, vy] = [1, 2].map(|i: usize| sum(&|body| body.mass * body.twist[i]) / mass);
    assert_close("velocity", &found.velocity, &[vx, vy], tolerance::IDENTITY);
    let spin = sum(&|Body { mass, inertia, pose, twist }| {
        inertia * twist[0] + mass * ((pose[1] - x) * (twist[2] - vy) - (pose[2] - y) * (twist[1] - vx))
    });
    assert_close("momentum", &found.momentum, &[spin, mass * vx, mass * vy], mass * tolerance::IDENTITY);
    let inertia =
        sum(&|Body { mass, inertia, pose, .. }| inertia + mass * ((pose[1] - x).powi(2) + (pose[2] - y).powi(2)));
    assert_close("inertia", &[found.inertia], &[inertia], inertia * tolerance::IDENTITY);
    assert_close("rate", &[found.rigid_rate], &[spin / inertia], tolerance::IDENTITY);
    assert_eq!((found.base_rate.to_bits(), found.largest_joint_rate.to_bits()), (f64::to_bits(0.3), f64::to_bits(2.5)));
    assert_eq!((found.wheel_rates, found.control), (vec![0.7, -3.5], "none"));
}
