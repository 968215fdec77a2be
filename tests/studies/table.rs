//! The table that `run` prints, word by word, against numbers that are set.

use crate::{run, scenario};
use planar_capture::capture::Study;
use planar_capture::output::console::table;
use planar_capture::scenario::{OnOverlap, Scenario};

/// The first case of a shipped scenario.
fn first_case(name: &str) -> (Scenario, Study) {
    let mut scenario = scenario(name);
    scenario.cases.truncate(1);
    if let Some(after) = &mut scenario.post_impact {
        after.duration = after.duration.min(2.0);
    }
    let study = run(&scenario);
    (scenario, study)
}

/// The words of a text: lines are broken where they are full.
fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Least distances in m: with a power of ten where six decimals would show nothing.
#[test]
fn least_distances_are_in_metres() {
    let (scenario, mut study) = first_case("raina_shah_2017");
    let clearance = &mut study.cases[0].clearance;
    clearance.overlaps.clear();
    let least = clearance.besides_contacts.clone().expect("a distance");
    for (distance, expected) in
        [(0.25, "0.250000"), (-0.0125, "-0.012500"), (1e-5, "0.000010"), (-9.9e-6, "-9.90e-6"), (3.456e-9, "3.46e-9")]
    {
        let mut shown = least.clone();
        (shown.distance, shown.time) = (distance, 1.5);
        study.cases[0].clearance.besides_contacts = Some(shown);
        let table = table(&scenario, &study);
        let (_, rows) = table.split_once("Least distance of bodies").expect("a table");
        let row = rows.lines().find(|line| line.contains("case1")).expect("a row");
        let [a, b] = &least.bodies;
        assert_eq!(words(row), format!("case1 {expected} 1.500 {a} and {b}"), "{rows}");
    }
}

/// Three overlaps are printed; the others are counted.
#[test]
fn overlaps_that_are_left_out_are_counted() {
    let (scenario, mut study) = first_case("raina_shah_2017");
    let mut overlap = study.cases[0].clearance.overlaps.first().expect("an overlap").clone();
    overlap.span = [1.0, 2.0];
    for (count, expected) in [
        (3, None),
        (4, Some("and a later overlap, see summary.json")),
        (5, Some("and 2 later overlaps, see summary.json")),
        (14, Some("and 11 later overlaps, see summary.json")),
    ] {
        study.cases[0].clearance.overlaps = vec![overlap.clone(); count];
        let table = table(&scenario, &study);
        assert_eq!(words(&table).matches(&overlap.sentence()).count(), 3, "{table}");
        assert_eq!(table.lines().map(str::trim).find(|line| line.starts_with("and ")), expected, "{table}");
    }
}

/// Times at torque limits stand with the phase that has them.
#[test]
fn each_phase_has_its_own_times_at_limits() {
    let (scenario, mut study) = first_case("raina_shah_2017");
    study.approach.saturation.joints = vec![0.0; 6];
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    capture.post_impact.saturation.joints = vec![0.0, 0.25, 0.0, 0.0, 0.0, 0.0];
    let table = table(&scenario, &study);
    let (before, after) = table.split_once("After the impact").expect("a heading");
    assert!(words(before).contains("joint torques never at their limits"), "{before}");
    assert!(words(after).contains("joint torques at their limits: joint 2 of arm1 for 0.250 s"), "{after}");
}

/// Printed impulses stand beside those of their own target.
#[test]
fn each_target_has_its_own_printed_impulse() {
    let (mut scenario, study) = first_case("raina_shah_2017");
    scenario.cases[0].printed_impulses = vec![Some(0.125), Some(0.375)];
    let table = table(&scenario, &study);
    for (target, expected) in [("target1", "0.1250"), ("target2", "0.3750")] {
        let row = table.lines().find(|line| line.contains("case1") && line.contains(target)).expect("a row");
        assert!(row.trim_end().ends_with(expected), "{row}");
    }
}

/// The place of a contact point is the target's and the point's, in both coordinates.
#[test]
fn a_contact_point_is_hit_where_it_is() {
    let (mut scenario, study) = first_case("raina_shah_2017");
    let poses = &study.approach.end().end_effector_poses;
    let target = &mut scenario.targets[0];
    let point = [0.25, -0.5];
    let touch = &mut target.contacts[0];
    touch.point = point;
    let [_, x, y] = poses[touch.arm];
    for (miss, expected) in
        [([0.0, 0.0], "target1: hit"), ([0.03, 0.04], "target1: missed by 0.0500 m"), ([0.0, 4e-5], "target1: hit")]
    {
        scenario.targets[0].position = Some([x - point[0] - miss[0], y - point[1] - miss[1]]);
        let table = table(&scenario, &study);
        assert!(table.lines().any(|line| line.trim_end().ends_with(expected)), "no `{expected}` in\n{table}");
    }
}

/// An end effector that meets nothing: which one, which target, how far and when.
#[test]
fn what_is_not_met_is_named_with_its_distance_and_time() {
    let mut scenario = scenario("elastic_rebound");
    scenario.cases.retain(|case| case.name == "too_late");
    let mut study = run(&scenario);
    let [pair] = &mut study.cases[0].closest[..] else { panic!("{:?}", study.cases[0].closest) };
    (pair.distance, pair.time) = (0.125, 31.5);
    let table = words(&table(&scenario, &study));
    let expected = "too_late: the end effector of arm2 never meets box; the smallest distance is 0.1250 m, at 31.50 s";
    assert!(table.contains(expected), "{table}");
    assert!(!table.contains("no impact"), "the other is met\n{table}");
}

/// What a study says to compute after an impact that there is not.
#[test]
fn a_case_without_an_impact_says_so() {
    let mut scenario = scenario("elastic_rebound");
    scenario.cases.truncate(1);
    scenario.approach.duration = 1.0;
    let study = run(&scenario);
    let said = format!("{}: no impact, and so no motion after it", scenario.cases[0].name);
    assert!(words(&table(&scenario, &study)).contains(&said));
    scenario.post_impact = None;
    assert!(!words(&table(&scenario, &study)).contains(&said), "nothing is missing");
}

/// Overlaps of default outlines, where those of given ones would fail the run.
#[test]
fn overlaps_of_default_outlines_are_said_to_fail_nothing() {
    let (scenario, mut study) = first_case("raina_shah_2017");
    let said = "overlaps of default outlines are reported alone (clearance.on_overlap)";
    for (rule, is_default, expected) in [
        (OnOverlap::Report, true, false),
        (OnOverlap::Fail, false, false),
        (OnOverlap::Fail, true, true),
        (OnOverlap::Stop, true, true),
    ] {
        let clearance = &mut study.cases[0].clearance;
        clearance.on_overlap = rule;
        clearance.overlaps.iter_mut().for_each(|overlap| overlap.is_default = is_default);
        assert!(!clearance.overlaps.is_empty());
        assert_eq!(words(&table(&scenario, &study)).contains(said), expected, "{rule:?}, {is_default}");
    }
}

/// Wheels by themselves, and the base torque's own time at its limit.
#[test]
fn wheels_and_base_torque_have_their_own_lines() {
    let (scenario, mut study) = first_case("stabilised_capture");
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    capture.residual_motion.as_mut().expect("a motion").wheel_rates = vec![0.25, -12.5];
    capture.post_impact.saturation.base = 1.25;
    capture.post_impact.saturation.joints.iter_mut().for_each(|time| *time = 0.5);
    let table = words(&table(&scenario, &study));
    assert!(table.contains("wheels turn at 0.250000, -12.500000 rad/s"), "{table}");
    assert!(table.contains("J of work, 1.250 s at its limit"), "{table}");
}

/// How many joints there are for what is prescribed.
#[test]
fn spare_and_missing_joints_are_counted() {
    let (scenario, mut study) = first_case("spinning_target");
    for (spare, expected) in [
        (0, "as many joints as prescribed coordinates"),
        (2, "2 more joints than prescribed coordinates: smallest steps"),
        (-3, "3 more prescribed coordinates than joints, which happen to agree"),
    ] {
        study.inverse_kinematics.as_mut().expect("a design").spare_joints = spare;
        let table = words(&table(&scenario, &study));
        assert!(table.contains(&format!("; {expected}")), "no `{expected}` in\n{table}");
    }
}
