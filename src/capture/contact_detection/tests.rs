//! Contacts within a step that begins in contact, and how many distances they take.

use super::*;
use crate::registry;
use planar_proof::file;
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

/// The crossings of steps one after the other, and how many distances each computed, for a square that turns at 1 rad/s
/// from where its corner is `before` rad past the end effector, and comes from farther away at a speed.
fn crossings(before: f64, [away, speed]: [f64; 2], spans: &[[f64; 2]]) -> Vec<(Option<[f64; 2]>, u64)> {
    let scenario = scenario();
    let initial = &scenario.initial;
    let mut tip = [[0.0; 3]];
    registry::generic(&scenario.layout)
        .end_effector_poses(&initial.base_pose, &initial.joint_angles, &mut tip)
        .expect("poses");
    let pose = [before + FRAC_PI_4 * 3.0, tip[0][1] + 1.2 + away, tip[0][2]];
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
