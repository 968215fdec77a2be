//! Contacts within a step that begins in contact, of outlines that are not convex, and how many distances they take.

use super::*;
use crate::control::ZeroTorque;
use crate::outline::Outline;
use crate::registry;
use crate::simulate::system::System;
use crate::simulate::{Timing, simulate};
use planar_proof::{assert_close, file, tolerance};
use std::f64::consts::FRAC_PI_4;

/// A robot at rest whose first end effector is 1.2 m from the centre of a square of 2 m.
fn scenario() -> Scenario {
    let text = "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.1, 0.1]\n[approach]\nduration = 9.0\n\
                trajectory = \"cycloidal\"\nfinal_joint_angles = [0.1, 0.1]\ntracking = \"exact\"\n[contact]\n\
                detection = \"event\"\n[[target]]\nname = \"square\"\narm = \"arm1\"\nmass = 1.0\ninertia = 1.0\n\
                polygon = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]\nposition = [9.0, 9.0]\n\
                [post_impact]\nduration = 1.0\nstep = 0.1\n";
    Scenario::parse(text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

/// The pose of its end effector.
fn tip(scenario: &Scenario) -> [f64; 3] {
    let (initial, mut tip) = (&scenario.initial, [[0.0; 3]]);
    let model = registry::generic(&scenario.layout);
    model.end_effector_poses(&initial.base_pose, &initial.joint_angles, &mut tip).expect("poses");
    tip[0]
}

/// The crossings of steps one after the other, and how many distances each computed, for a square that turns at 1 rad/s
/// from where its corner is `before` rad past the end effector, and comes from farther away at a speed.
fn crossings(before: f64, [away, speed]: [f64; 2], spans: &[[f64; 2]]) -> Vec<(Option<[f64; 2]>, u64)> {
    let scenario = scenario();
    let (initial, [_, x, y]) = (&scenario.initial, tip(&scenario));
    let pose = [before + FRAC_PI_4 * 3.0, x + 1.2 + away, y];
    let targets = [Body { mass: 1.0, inertia: 1.0, pose, twist: [1.0, -speed, 0.0] }];
    let pair = ContactPair { target: 0, contact: 0, arm: 0 };
    let mut detection = ContactDetection::new(&scenario, TargetMotion::Free(&targets), vec![pair]);
    let (positions, rates) = ([&initial.base_pose[..], &initial.joint_angles].concat(), [0.0; 5]);
    let ends = [&positions[..], &rates];
    let mut search = |span: &[f64; 2]| {
        let counted = detection.evaluations();
        let found = detection.crossings(&PathInterval { span: *span, start: ends, end: ends }).expect("crossings");
        (found[0], detection.evaluations() - counted)
    };
    spans.iter().map(&mut search).collect()
}

/// The end effector is inside for φ rad about each corner, then outside, a quarter of a turn in all.
#[test]
fn a_contact_ends_before_it_begins_again() {
    let inside = FRAC_PI_4 - f64::acos(1.0 / 1.2);
    // the corner is where the end effector is 0.01 rad before it leaves the square
    let leaves = 0.01;
    let touches = leaves + 2.0 * f64::acos(1.0 / 1.2);
    let start = inside - leaves;
    for offset in [0.0, 2.0] {
        let step = [[offset, offset + touches + 0.1]];
        let (found, count) = crossings(start - offset, [0.0; 2], &step)[0];
        let [from, to] = found.expect("a contact");
        assert!(from >= offset + leaves && from < offset + touches, "{from}");
        assert!((offset + touches - 1e-12..offset + touches + 0.1 + 1e-12).contains(&to), "{to}");
        assert!(count > 1);
        // all of the step in contact; then outside to the end of the next
        let steps = [[offset, offset + 0.5 * leaves], [offset + 0.5 * leaves, offset + 0.5 * touches]];
        for (found, _) in crossings(start - offset, [0.0; 2], &steps) {
            assert_eq!(found, None);
        }
    }
}

/// Far away, one distance is enough for many steps.
#[test]
fn far_targets_cost_nothing() {
    let found = crossings(0.0, [50.0, 0.0], &[[0.0, 1.0], [1.0, 2.0], [2.0, 3.0]]);
    assert!(found.iter().all(|(crossing, _)| crossing.is_none()));
    let counts: Vec<_> = found.iter().map(|(_, count)| *count).collect();
    assert!(counts[0] > 1 && counts[1..] == [0, 0], "{counts:?}");
}

/// A square that is 30 m away at first is met in the second of two long steps.
#[test]
fn long_steps_miss_no_contact() {
    let found = crossings(0.0, [30.0, 1.0], &[[0.0, 20.0], [20.0, 40.0]]);
    let [(None, _), (Some([from, to]), _)] = found[..] else { panic!("{found:?}") };
    // where a side or a corner is between 1 m and 1.42 m from the centre
    assert!((20.0..40.0).contains(&from) && to > 30.0 - 0.3 && to <= 40.0, "{from} {to}");
}

/// When the end effector of a robot at rest meets a moving target, within one step, for an outline that is listed from each of its
/// corners.
fn contacts_of<const N: usize>(corners: [[f64; 2]; N], [yaw, x, y]: [f64; 3], twist: [f64; 3], end: f64) -> [f64; N] {
    std::array::from_fn(|first| {
        let (mut scenario, mut corners) = (scenario(), corners.to_vec());
        corners.rotate_left(first);
        scenario.targets[0].outline = Outline::polygon(corners).expect("a polygon");
        let robot = registry::generic(&scenario.layout);
        let [_, tip_x, tip_y] = tip(&scenario);
        let targets = [Body { mass: 1.0, inertia: 1.0, pose: [yaw, tip_x + x, tip_y + y], twist }];
        let pair = ContactPair { target: 0, contact: 0, arm: 0 };
        let mut contacts = ContactDetection::new(&scenario, TargetMotion::Free(&targets), vec![pair]);
        let timing = Timing { duration: end, step: end, sample: end, ..Timing::default() };
        let (system, start) = (System::alone(&*robot), &scenario.initial);
        let phase = simulate(&system, &mut ZeroTorque, start, &timing, &mut contacts, &mut || ()).expect("a phase");
        phase.event.map_or(f64::NAN, |(_, time)| time)
    })
}

/// A block at the centre with a bar of 2 m that sweeps over an end effector 1.5 m from the centre, and is past it at the end of
/// the step: whichever convex part is the first, the bar's reach decides how fast points may be.
#[test]
fn the_farthest_part_of_an_outline_bounds_its_speed() {
    let corners =
        [[-0.5, -0.5], [0.0, -0.5], [0.0, -0.1], [2.0, -0.1], [2.0, 0.1], [0.0, 0.1], [0.0, 0.5], [-0.5, 0.5]];
    let (distance, rate, before): (f64, f64, f64) = (1.5, 0.5, 2.0);
    // the angle of the end effector in the target's axes falls to that of the leading edge there
    let expected = (before - f64::asin(0.1 / distance)) / rate;
    for time in contacts_of(corners, [-before, -distance, 0.0], [rate, 0.0, 0.0], (before + 1.0) / rate) {
        assert!((time - expected).abs() < tolerance::EVENT_TIME, "{time}, not {expected}");
    }
}

/// Both legs of a U pass the end effector in one step, from either side: the contact is that with the first of them.
#[test]
fn the_first_part_that_is_met_makes_the_contact() {
    let [outer, inner] = [0.55, 0.45];
    let corners = [
        [-outer, -1.0],
        [outer, -1.0],
        [outer, 1.0],
        [inner, 1.0],
        [inner, -0.9],
        [-inner, -0.9],
        [-inner, 1.0],
        [-outer, 1.0],
    ];
    for side in [-1.0, 1.0] {
        let expected = (3.0 - outer) / 0.5;
        for time in contacts_of(corners, [0.0, side * 3.0, 0.0], [0.0, -side * 0.5, 0.0], 12.0) {
            assert!((time - expected).abs() < tolerance::EVENT_TIME, "from {side}: {time}, not {expected}");
        }
    }
}

/// The normal at an end effector is that of the side it is beside, in inertial axes, at every yaw of the target.
#[test]
fn normals_are_in_inertial_axes() {
    let scenario = scenario();
    for (yaw, [along, across]) in [(0.0_f64, [1.0, 0.0]), (0.5, [1.0, 0.0]), (-1.3, [0.0, -1.0]), (2.8, [-1.0, 0.0])] {
        let (sin, cos) = yaw.sin_cos();
        let outward = [cos * along - sin * across, sin * along + cos * across];
        let body = Body { mass: 1.0, inertia: 1.0, pose: [yaw, 3.0, -2.0], twist: [0.0; 3] };
        let tip = [0.7, 3.0 + 1.2 * outward[0], -2.0 + 1.2 * outward[1]];
        let (distance, normal) = signed_distance(&scenario, 0, &body, &tip);
        assert_close("distance", &[distance], &[0.2], tolerance::POLYNOMIAL);
        assert_close("normal", &normal, &outward, tolerance::POLYNOMIAL);
    }
}
