//! When there is another origin, and what it changes of an impact.
#![allow(clippy::float_cmp, reason = "numbers that are copied")]

use super::*;
use crate::registry;
use planar_proof::{assert_close, file, tolerance};

fn scenario(x: f64, y: f64) -> Scenario {
    let text = format!(
        "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.1, 0.1]\nbase_pose = [0.5, {x:?}, {y:?}]\n\
         [approach]\nduration = 1.0\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [0.2, 0.1]\n"
    );
    Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_origin_is_the_base() {
    assert!(Origin::of(&scenario(0.0, 0.0)).is_none());
    for at in [[2.0, 0.0], [0.0, -3.0], [2.0, -3.0]] {
        let scenario = scenario(at[0], at[1]);
        let origin = Origin::of(&scenario).expect("another origin");
        assert_eq!(origin.0, at);
        assert_eq!(origin.relative(&scenario).initial.base_pose, [0.5, 0.0, 0.0]);
    }
}

/// l = l' + r × p, and the linear momentum is the same.
#[test]
fn angular_momentum_is_about_the_inertial_origin() {
    let mut impact = ImpactResult {
        joint_rates_after: Vec::new(),
        base_twist_after: [0.0; 3],
        target_twists_after: Vec::new(),
        impulses: Vec::new(),
        momentum_jump: [0.5, 3.0, -4.0],
        relative_momentum_jump: 0.0,
        kinetic_energy_before: 0.0,
        kinetic_energy_after: 0.0,
    };
    Origin([10.0, 20.0]).impact(&mut impact);
    assert_close("jump", &impact.momentum_jump, &[0.5 - 40.0 - 60.0, 3.0, -4.0], tolerance::POLYNOMIAL);
}

/// The momentum of later impacts, and of the paper's equations, is about the inertial origin too.
#[test]
fn all_impacts_are_about_the_inertial_origin() {
    let scenario = crate::scenario::fixture::two_discs("duration = 0.5\n");
    let model = registry::generic(&scenario.layout);
    let mut study =
        crate::capture::study(&scenario, &|| model.clone_box(), 1.0, &mut crate::capture::Silent).expect("a study");
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    for impact in [&mut capture.impact.exact, capture.impact.paper.as_mut().expect("the paper's")] {
        impact.momentum_jump = [0.5, 3.0, -4.0];
    }
    let later = crate::capture::LaterImpact { time: 0.25, impact: capture.impact.clone() };
    capture.later_impacts = vec![later.clone(), later];
    let moved = Origin([10.0, 20.0]).absolute(study);
    let capture = moved.cases[0].capture.as_ref().expect("a capture");
    assert_eq!(capture.impacts().count(), 3);
    for impact in capture.impacts() {
        for result in [Some(&impact.exact), impact.paper.as_ref()] {
            let jump = result.expect("both").momentum_jump;
            assert_close("jump", &jump, &[0.5 - 40.0 - 60.0, 3.0, -4.0], tolerance::POLYNOMIAL);
        }
    }
}
