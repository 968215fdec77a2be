//! The paper's study against an independent model (`tests/reference/independent_model.py`) and the notes' numbers.

use crate::{Silent, run, scenario, summary};
use planar_capture::capture::impact::ContactResult;
use planar_capture::capture::study;
use planar_capture::contact::ContactKind;
use planar_capture::registry::{self, generic};
use planar_capture::simulate::conservation::{AccumulatedInput, ConservationAudit, ConservationErrors};
use planar_capture::state::State;
use planar_proof::{assert_close, json, numbers, tolerance};
use serde_json::Value;

const SCENARIOS: [&str; 3] = ["raina_shah_2017", "raina_shah_2017_exact_tracking", "raina_shah_2017_as_printed"];

/// (what it is, ours, theirs) for every key that the reference has under `path`.
fn compare(path: &str, ours: &Value, reference: &Value, tolerance: f64, compared: &mut usize) {
    if let Value::Object(entries) = reference {
        for (key, value) in entries {
            let mine = ours.get(key).unwrap_or_else(|| panic!("{path}/{key} is not in the summary"));
            compare(&format!("{path}/{key}"), mine, value, tolerance, compared);
        }
    } else {
        let (mine, theirs) = (numbers(ours), numbers(reference));
        *compared += theirs.len();
        assert_close(path, &mine, &theirs, tolerance);
    }
}

#[test]
fn every_number_of_the_summary_agrees_with_an_independent_model() {
    let reference = json("tests/reference/raina_shah_2017.json");
    let references = reference["scenarios"].as_array().expect("scenarios");
    assert_eq!(references.len(), SCENARIOS.len());
    for reference in references {
        let name = reference["scenario"].as_str().expect("a name");
        assert!(SCENARIOS.contains(&name));
        let scenario = scenario(name);
        let study = run(&scenario);
        let designed = study.terminal_rates.as_ref().expect("designed rates");
        let rates = numbers(&reference["designed_joint_rates"]);
        assert_close("designed rates", &designed.joint_rates, &rates, tolerance::APPROACH);
        let ours = summary(&scenario, &study);
        let cases = reference["cases"].as_array().expect("cases");
        assert_eq!(ours["cases"].as_array().map(Vec::len), Some(cases.len()));
        for (case, ours) in cases.iter().zip(ours["cases"].as_array().expect("cases")) {
            assert_eq!(case["name"], ours["name"]);
            let mut compared = 0;
            for part in ["approach", "impact"] {
                compare(&format!("{name}/{part}"), &ours[part], &case[part], tolerance::APPROACH, &mut compared);
            }
            let part = "post_impact";
            compare(&format!("{name}/{part}"), &ours[part], &case[part], tolerance::POST_IMPACT, &mut compared);
            assert!(compared > 100, "only {compared} numbers were compared");
        }
    }
}

#[test]
fn exact_tracking_gives_the_notes_digits() {
    let study = run(&scenario("raina_shah_2017_exact_tracking"));
    let terminal_rates = study.terminal_rates.as_ref().expect("designed rates");
    let rates = [0.014_021_81, -0.124_352_22, 0.096_810_71, 0.014_061_43, -0.124_387_95, 0.096_806_82];
    assert_close("end rates", &terminal_rates.joint_rates, &rates, tolerance::PRINTED_DIGITS);
    let end = study.approach.end();
    let [yaw, x, y] = end.state.base_pose;
    assert_close("yaw, y", &[yaw, y], &[0.687_457_5, 0.019_422_8], 10.0 * tolerance::PRINTED_DIGITS);
    assert_close("x", &[x], &[6.8e-6], 10.0 * tolerance::PRINTED_DIGITS);
    let end_effectors: Vec<f64> = end.end_effector_poses.iter().flat_map(|pose| [pose[1], pose[2]]).collect();
    let expected = [2.009_266_1, -1.396_365_1, -2.009_958_2, 1.434_549_4];
    assert_close("end effectors", &end_effectors, &expected, 10.0 * tolerance::PRINTED_DIGITS);
    // the end effectors have the designed twists
    assert_close("end effector twist 1", &end.end_effector_twists[0], &[0.0, -0.1, 0.0], tolerance::APPROACH);
    assert_close("end effector twist 2", &end.end_effector_twists[1], &[0.0, 0.1, 0.0], tolerance::APPROACH);
}

#[test]
fn impulses_of_the_notes_table() {
    // exact, both contacts, and the literal model's contact 1; corrected eq. (7), cases 1 to 3
    let table = [
        ([0.13814, 0.04558, -0.11306], [0.13816, -0.04563, 0.11321], [0.13817, 0.04538, -0.11608]),
        ([0.02279, 0.17459, -0.09520], [0.02282, -0.17464, 0.09532], [0.02269, 0.17523, -0.08559]),
        ([0.13812, 0.04556, -0.11302], [-0.09251, -0.30367, 0.07747], [0.13795, 0.04545, -0.10340]),
    ];
    let study = run(&scenario("raina_shah_2017_exact_tracking"));
    assert_eq!(study.cases.len(), table.len());
    for (case, (first, second, literal)) in study.cases.iter().zip(table) {
        let impact = &case.capture.as_ref().expect("a capture").impact;
        for (impulse, expected) in [
            (impact.exact.impulses[0], first),
            (impact.exact.impulses[1], second),
            (impact.paper.as_ref().expect("literal").impulses[0], literal),
        ] {
            assert_close(&case.name, &impulse.expect("captured"), &expected, tolerance::PRINTED_IMPULSE);
        }
    }
}

#[test]
fn patterns_that_must_hold() {
    let magnitudes = |name: &str| -> Vec<Vec<f64>> {
        let study = run(&scenario(name));
        let of = |case: &planar_capture::capture::CaseResult| {
            let impact = &case.capture.as_ref().expect("a capture").impact;
            impact.exact.impulse_magnitudes().into_iter().flatten().collect()
        };
        study.cases.iter().map(of).collect()
    };
    let exact = magnitudes("raina_shah_2017_exact_tracking");
    let relative = |a: f64, b: f64| (a - b).abs() / a;
    assert!(relative(exact[0][0], exact[2][0]) < 1e-3, "contact 1 feels the same in cases 1 and 3");
    assert!(relative(exact[0][0], exact[0][1]) < 2e-3 && relative(exact[1][0], exact[1][1]) < 2e-3, "near symmetry");
    let printed = magnitudes("raina_shah_2017_as_printed");
    assert!(printed[1][0] < 0.2 * printed[0][0], "with the printed (7), case 2 is far below case 1");
}

/// A robot that moves on without turning, faster by a part δ: all of it is drift, relative to what it has then, and
/// what was gained without work is an error of the energy.
#[test]
fn the_audit_measures_drift() {
    let model = registry::generated(&scenario("redysim_single_arm_3r").layout).expect("generated code");
    let joint_angles = [0.3, -1.2, 0.7];
    let state = |speed: f64| State {
        base_pose: [0.4, 0.0, 100.0], // far to the side of its path: all bodies turn about the origin the same way
        joint_angles: &joint_angles,
        base_twist: [0.0, speed, 0.0],
        joint_rates: &[0.0; 3],
    };
    for (delta, part) in [(1e-3, 0.0), (0.25, 0.5), (-0.25, 1.0)] {
        let mut audit = ConservationAudit::new(&*model, &state(1.0), &[]).expect("a state");
        let start = audit.momentum(&state(1.0), &[]).expect("a state").kinetic_energy;
        assert_eq!(audit.drift(), ConservationErrors::default(), "nothing strayed yet");
        let gained = start * ((1.0 + delta) * (1.0 + delta) - 1.0);
        let largest = (start + gained).max(start);
        audit
            .record(&state(1.0 + delta), &[], &AccumulatedInput { work: part * gained, ..AccumulatedInput::default() })
            .expect("a state");
        let ConservationErrors { momentum_drift, energy_error, .. } = audit.drift();
        let expected = [delta.abs() / (1.0 + delta).max(1.0), (1.0 - part) * gained.abs() / largest];
        assert_close("drift, error", &[momentum_drift, energy_error], &expected, tolerance::IDENTITY);
    }
}

/// A robot that turns about its COM at the origin, faster by a part δ: its linear momentum stays zero, and all bodies
/// turn the same way, so that the part of its angular momentum is what strays.
#[test]
fn the_audit_measures_angular_momentum_too() {
    let model = registry::generated(&scenario("redysim_single_arm_3r").layout).expect("generated code");
    let joint_angles = [0.3, -1.2, 0.7];
    let (mut inertias, mut poses) = ([[0.0; 2]; 4], [[0.0; 3]; 4]);
    model.body_inertias(&mut inertias).expect("inertias");
    model.body_poses(&[0.4, 0.0, 0.0], &joint_angles, &mut poses).expect("poses");
    let mass: f64 = inertias.iter().map(|[m, _]| m).sum();
    let com = [1, 2].map(|i: usize| inertias.iter().zip(&poses).map(|([m, _], p)| m * p[i]).sum::<f64>() / mass);
    let state = |rate: f64| State {
        base_pose: [0.4, -com[0], -com[1]],
        joint_angles: &joint_angles,
        base_twist: [rate, rate * com[1], -rate * com[0]],
        joint_rates: &[0.0; 3],
    };
    for delta in [0.25, -0.25] {
        let mut audit = ConservationAudit::new(&*model, &state(1.0), &[]).expect("a state");
        audit.record(&state(1.0 + delta), &[], &AccumulatedInput::default()).expect("a state");
        let expected = delta.abs() / (1.0_f64 + delta).max(1.0);
        assert_close("angular drift", &[audit.drift().momentum_drift], &[expected], tolerance::IDENTITY);
    }
}

#[test]
fn every_shipped_study_passes_its_audit() {
    for entry in std::fs::read_dir(planar_proof::file("scenarios")).expect("scenarios") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            continue;
        }
        let name = path.file_stem().and_then(|s| s.to_str()).expect("a name").to_owned();
        let study = run(&scenario(&name));
        assert_eq!(study.audit_failures(), Vec::<String>::new(), "{name}");
        for captured in study.cases.iter().filter_map(|case| case.capture.as_ref()) {
            for impact in captured.impacts() {
                let exact = &impact.exact;
                assert_close(&name, &exact.momentum_jump, &[0.0; 3], tolerance::MOMENTUM_JUMP);
                let gained = exact.kinetic_energy_after / exact.kinetic_energy_before - 1.0;
                assert!(gained < tolerance::ENERGY_OF_AN_IMPACT, "{name} gains {gained}");
            }
            // the paper's equations are about rigid captures: there is no literal result of others
            let rigid = |result: &ContactResult| result.contact.law.kind() == ContactKind::Rigid;
            let contacts = &captured.impact.contacts;
            let of_the_paper = scenario(&name).targets.iter().all(|target| target.contacts.len() == 1);
            assert_eq!(
                captured.impact.paper.is_some(),
                of_the_paper && !contacts.is_empty() && contacts.iter().all(rigid),
                "{name}"
            );
            if let Some(literal) = &captured.impact.paper {
                assert!(literal.relative_momentum_jump > 1e-4, "{name}: the literal model does not conserve momentum");
            }
        }
    }
}

#[test]
fn a_study_is_the_same_with_generic_dynamics() {
    let scenario = scenario("redysim_single_arm_3r");
    let expected = summary(&scenario, &run(&scenario));
    let model = generic(&scenario.layout);
    let found = study(&scenario, &|| model.clone_box(), 0.05, &mut Silent).expect("a study");
    let found = summary(&scenario, &found);
    let end = |summary: &Value, key: &str| numbers(&summary["cases"][0]["approach"][key]);
    for key in ["base_pose", "joint_angles", "base_twist", "joint_rates", "end_effector_poses"] {
        assert_close(key, &end(&found, key), &end(&expected, key), tolerance::SAME_STUDY);
    }
}
