//! A robot far from the inertial origin: the same velocities and impulses, and positions as they can be written.

use crate::{run, scenario};
use planar_capture::capture::{CaseResult, Study};
use planar_capture::scenario::{EndEffectorGoal, Scenario};
use planar_proof::{assert_close, tolerance};

/// The scenario with everything moved.
fn moved(name: &str, [x, y]: [f64; 2]) -> Scenario {
    let mut scenario = scenario(name);
    let add = |position: &mut [f64]| {
        position[0] += x;
        position[1] += y;
    };
    add(&mut scenario.initial.base_pose[1..]);
    scenario.targets.iter_mut().filter_map(|target| target.position.as_mut()).for_each(|position| add(position));
    for goal in scenario.approach.final_end_effector_poses.iter_mut().flatten() {
        match goal {
            EndEffectorGoal::Any => {}
            EndEffectorGoal::Position(position) => add(position),
            EndEffectorGoal::Pose(pose) => add(&mut pose[1..]),
        }
    }
    scenario
}

/// Rates, impulses, energies and drifts, which do not depend on the origin.
fn intrinsic(study: &Study) -> Vec<f64> {
    let of_case = |case: &CaseResult| {
        let capture = case.capture.as_ref().expect("a capture");
        let impact = &capture.impact.exact;
        let end = capture.post_impact.end();
        let impulses = impact.impulses.iter().flatten().flatten();
        let twists = impact.base_twist_after.iter().chain(capture.impact.target_twists.iter().flatten());
        let paper = capture.impact.paper.iter().flat_map(|paper| paper.base_twist_after);
        let numbers = impulses.chain(twists).chain(&impact.joint_rates_after).chain(&end.state.joint_angles);
        let drift = capture.post_impact.drift;
        let drifts = [drift.momentum_drift, drift.energy_error, drift.center_of_mass_drift];
        numbers.copied().chain(paper).chain(drifts).chain([impact.kinetic_energy_after]).collect::<Vec<_>>()
    };
    study.cases.iter().flat_map(of_case).collect()
}

/// Where contacts are where the end effectors are, not a bit changes, whatever the distance.
#[test]
fn an_impact_does_not_depend_on_the_distance() {
    for name in ["three_arms", "raina_shah_2017"] {
        let near = run(&scenario(name));
        for far in [[0.0, 1e6], [-3e7, 2e6], [0.0, 1e14], [1e300, -1e300]] {
            let study = run(&moved(name, far));
            assert_eq!(intrinsic(&study), intrinsic(&near), "{name} at {far:?}");
            assert_eq!(study.audit_failures(), Vec::<String>::new(), "{name} at {far:?}");
        }
    }
}

/// Positions and angular momentum are from and about the inertial origin.
#[test]
fn positions_and_angular_momentum_count_from_the_inertial_origin() {
    let far @ [x, y] = [3e6, -1e6];
    let (near, study) = (run(&scenario("raina_shah_2017")), run(&moved("raina_shah_2017", far)));
    // a unit in the last place of 3e6 m
    let unit = 3e6 * f64::EPSILON;
    let at = |pose: [f64; 3]| [pose[0], pose[1] + x, pose[2] + y];
    let phases = |study: &Study| {
        let captures = study.cases.iter().filter_map(|case| case.capture.as_ref());
        std::iter::once(study.approach.clone()).chain(captures.map(|c| c.post_impact.clone())).collect::<Vec<_>>()
    };
    for (found, right) in phases(&study).iter().zip(&phases(&near)) {
        let about_another_origin = found.path.try_for_each(|_| Err(std::io::ErrorKind::Other.into()));
        about_another_origin.unwrap_or_else(|_: std::io::Error| panic!("a path is in no result"));
        for (found, right) in found.samples.iter().zip(&right.samples) {
            assert_close("base", &found.state.base_pose, &at(right.state.base_pose), unit);
            for (found, right) in found.end_effector_poses.iter().zip(&right.end_effector_poses) {
                assert_close("end effector", found, &at(*right), unit);
            }
            for (found, right) in found.bodies.iter().zip(&right.bodies) {
                assert_close("target", &found.pose, &at(right.pose), unit);
            }
            let [px, py] = right.momentum.linear_momentum;
            let angular = right.momentum.angular_momentum + (x * py - y * px);
            assert_close("l", &[found.momentum.angular_momentum], &[angular], 1e-15 * 3e6 * (px.hypot(py) + 1.0));
        }
    }
    for (found, right) in study.cases.iter().zip(&near.cases) {
        for (found, right) in found.targets.iter().zip(&right.targets) {
            assert_close("target at the impact", &found.pose, &at(right.pose), unit);
        }
    }
}

/// Where targets have positions of their own, their distances from the robot lose what double precision cannot write.
#[test]
fn a_detected_contact_is_as_exact_as_its_positions() {
    let near = run(&scenario("elastic_rebound"));
    let study = run(&moved("elastic_rebound", [0.0, 1e6]));
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    // 1.2e-10 m of a position at 1e6 m, over approach speeds of some cm/s
    for (found, right) in study.cases.iter().zip(&near.cases) {
        let duration = |case: &CaseResult| case.approach.as_ref().expect("an approach of its own").duration;
        assert_close("time of contact", &[duration(found)], &[duration(right)], tolerance::FAR_CONTACT);
        let impulses = |case: &CaseResult| {
            let capture = case.capture.as_ref().expect("a capture");
            capture.impact.exact.impulses.iter().flatten().flatten().copied().collect::<Vec<_>>()
        };
        assert_close("impulses", &impulses(found), &impulses(right), tolerance::FAR_CONTACT);
    }
}

/// Goals of end effectors are positions too.
#[test]
fn a_wanted_pose_is_reached() {
    let (near, study) = (run(&scenario("spinning_target")), run(&moved("spinning_target", [0.0, 1e6])));
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    assert_close("impulses and motion", &intrinsic(&study), &intrinsic(&near), tolerance::FAR_CONTACT);
    assert!(study.terminal_errors.iter().flatten().all(|error| error.reached));
}
