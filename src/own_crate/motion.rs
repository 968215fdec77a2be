//! The first scenario of a robot: a short motion of all its joints.

use crate::layout::{Arm, Layout};
use std::f64::consts::PI;
use std::fmt::Write;

/// By how much the first and the other joints move, rad.
const MOTION: [f64; 2] = [-0.3, 0.4];

/// The scenario's text.
pub(super) fn scenario(layout: &Layout) -> String {
    let name = &layout.name;
    let start: Vec<Vec<f64>> = layout.arms.iter().enumerate().map(|(i, arm)| bent(arm, side(i))).collect();
    let end: Vec<Vec<f64>> = start.iter().enumerate().map(|(i, angles)| moved(angles, side(i))).collect();
    let (start, end) = (list(&start), list(&end));
    let mut text = String::new();
    writeln!(
        text,
        "# A first motion of {name}: every joint turns, from rest to rest; the free base turns with them.\n\
         #\n\
         #     cargo run --release -- run scenarios/first.toml --report\n\n\
         name = \"first\"\n\
         layout = \"../layouts/{name}.toml\" # or by its name, \"{name}\": then the one that is compiled in\n\n\
         [initial]\n\
         joint_angles = [{start}] # rad, arm by arm\n\n\
         [approach]\n\
         duration = 10.0 # s\n\
         trajectory = \"cycloidal\"\n\
         final_joint_angles = [{end}]\n\
         tracking = \"computed_torque\" # gains in 1/s\u{b2} and 1/s, for a robot of any size"
    )
    .expect("writing to a String does not fail");
    text
}

/// Neighbouring arms bend to different sides.
fn side(arm: usize) -> f64 {
    if arm.is_multiple_of(2) { 1.0 } else { -1.0 }
}

/// An arm bent like an elbow, that points away from the base.
fn bent(arm: &Arm, side: f64) -> Vec<f64> {
    let [x, y] = arm.mount;
    let outwards = libm::atan2(y, x) - arm.mount_angle;
    let outwards = outwards - 2.0 * PI * (outwards / (2.0 * PI)).round();
    let angle = |joint: usize| match joint {
        0 => outwards + 0.6 * side,
        joint => 0.9 * side * if joint % 2 == 1 { -1.0 } else { 1.0 },
    };
    (0..arm.links.len()).map(angle).collect()
}

fn moved(angles: &[f64], side: f64) -> Vec<f64> {
    angles.iter().enumerate().map(|(joint, angle)| angle + side * MOTION[joint.min(1)]).collect()
}

fn list(angles: &[Vec<f64>]) -> String {
    angles.iter().flatten().map(|angle| format!("{:?}", (1e3 * angle).round() / 1e3)).collect::<Vec<_>>().join(", ")
}
