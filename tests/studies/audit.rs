//! The audit of the centre of mass and of joint limits.

use crate::command;
use crate::{run, scenario, summary};
use planar_capture::capture::clearance::ClosestApproach;
use planar_capture::capture::impact::ImpactResult;
use planar_capture::capture::{CaptureResult, LaterImpact, Study};
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_capture::scenario::{OnOverlap, PostCaptureControl, Scenario, Tracking};
use planar_capture::simulate::Phase;
use planar_capture::simulate::conservation::{AccumulatedInput, ConservationAudit, ConservationErrors};
use planar_capture::simulate::limits::{JointLimits, LimitViolation, LimitViolations};
use planar_capture::simulate::system::Body;
use planar_capture::state::State;
use planar_proof::{assert_close, file, said, tolerance};
use std::fs;
use tempfile::TempDir;

/// The drift is the distance of the centre of mass from its uniform motion, over the robot's extent.
#[test]
fn the_drift_of_the_centre_of_mass_is_measured() {
    let layout = scenario("redysim_single_arm_3r").layout;
    let model = registry::generated(&layout).expect("generated code");
    let joint_angles = [0.3, -1.2, 0.7];
    let state = |x: f64, y: f64| State {
        base_pose: [0.4, x, y],
        joint_angles: &joint_angles,
        base_twist: [0.0, 0.5, -0.2],
        joint_rates: &[0.0; 3],
    };
    let (mut inertias, mut poses) = ([[0.0; 2]; 4], [[0.0; 3]; 4]);
    model.body_inertias(&mut inertias).expect("inertias");
    model.body_poses(&[0.4, 0.0, 0.0], &joint_angles, &mut poses).expect("poses");
    let mass: f64 = inertias.iter().map(|[m, _]| m).sum();
    let com = [1, 2].map(|i: usize| inertias.iter().zip(&poses).map(|([m, _], p)| m * p[i]).sum::<f64>() / mass);
    let extent = poses.iter().map(|p| (p[1] - com[0]).hypot(p[2] - com[1])).fold(0.0, f64::max);
    let mut audit = ConservationAudit::new(&*model, &state(1.0, 2.0), &[]).expect("a state");
    let later = AccumulatedInput { time: 10.0, ..AccumulatedInput::default() };
    audit.record(&state(6.0, 0.0), &[], &later).expect("a state");
    assert_close("on its way", &[audit.drift().center_of_mass_drift], &[0.0], tolerance::IDENTITY);
    audit.record(&state(6.003, -0.004), &[], &later).expect("a state");
    assert_close("beside it", &[audit.drift().center_of_mass_drift], &[0.005 / extent], tolerance::IDENTITY);
}

/// A common velocity of all bodies is no motion relative to each other: with and without it the audit finds the same, in
/// canonical variables with a pin, too, whose momenta would lose digits with every step.
#[test]
fn a_drift_costs_no_digits() {
    let study = |integrator: &str, velocity: f64| {
        let text = format!(
            "name = \"it\"\nlayout = \"dual_arm_3r\"\n[initial]\njoint_angles = [0.698, -1.571, 1.047, 2.444, 1.571, -1.047]\n\
             base_twist = [0.0, {velocity:?}, 0.0]\n[approach]\nduration = 20.0\nintegrator = \"{integrator}\"\nstep = 0.02\n\
             trajectory = \"quintic\"\nfinal_joint_angles = [-0.524, -1.393, -0.035, 2.618, -1.393, -0.035]\nfinal_joint_rates = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]\n\
             tracking = \"computed_torque\"\nproportional_gain = 4.0\nderivative_gain = 4.0\n[[target]]\nname = \"it\"\n\
             arm = \"arm1\"\nkind = \"pin\"\nmass = 10.0\ninertia = 1.0\ncontact = [0.0, 0.5]\nradius = 0.5\n\
             twist = [0.2, {velocity:?}, 0.1]\n[post_impact]\nduration = 20.0\nintegrator = \"{integrator}\"\nstep = 0.005\n"
        );
        run(&Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}")))
    };
    let after = |study: &Study| study.cases[0].capture.as_ref().expect("a capture").post_impact.clone();
    for integrator in ["gauss_legendre", "rk4"] {
        let joints = |study: &Study| after(study).end().state.joint_angles.clone();
        let still = study(integrator, 0.0);
        for velocity in [10.0, 7500.0] {
            let found = study(integrator, velocity);
            assert_eq!(found.audit_failures(), Vec::<String>::new(), "{integrator}");
            let drift = |study: &Study| after(study).drift.worse(&study.approach.drift);
            let (moving, resting) = (drift(&found), drift(&still));
            assert!(
                moving.momentum_drift < 1.01 * resting.momentum_drift + 1e-10,
                "{integrator}: {moving:?} {resting:?}"
            );
            assert!(moving.center_of_mass_drift < resting.center_of_mass_drift + 1e-10, "{integrator}: {moving:?}");
            assert_close(integrator, &joints(&found), &joints(&still), tolerance::REACHED);
        }
    }
}

/// A free body counts with its mass, and is part of the extent.
#[test]
fn free_bodies_count_in_the_centre_of_mass() {
    let layout = scenario("redysim_single_arm_3r").layout;
    let model = registry::generated(&layout).expect("generated code");
    let joint_angles = [0.3, -1.2, 0.7];
    let state =
        State { base_pose: [0.0; 3], joint_angles: &joint_angles, base_twist: [0.0; 3], joint_rates: &[0.0; 3] };
    let (mut inertias, mut poses) = ([[0.0; 2]; 4], [[0.0; 3]; 4]);
    model.body_inertias(&mut inertias).expect("inertias");
    model.body_poses(&[0.0; 3], &joint_angles, &mut poses).expect("poses");
    let body = |y: f64| Body { mass: 40.0, inertia: 2.0, pose: [0.0, 100.0, y], twist: [0.0, 0.0, 0.3] };
    let mass: f64 = 40.0 + inertias.iter().map(|[m, _]| m).sum::<f64>();
    let com = [1, 2].map(|i: usize| {
        let robot: f64 = inertias.iter().zip(&poses).map(|([m, _], p)| m * p[i]).sum();
        (robot + 40.0 * body(0.0).pose[i]) / mass
    });
    let mut audit = ConservationAudit::new(&*model, &state, &[body(0.0)]).expect("a state");
    let later = AccumulatedInput { time: 2.0, ..AccumulatedInput::default() };
    audit.record(&state, &[body(0.6)], &later).expect("a state");
    assert_close("on its way", &[audit.drift().center_of_mass_drift], &[0.0], tolerance::IDENTITY);
    audit.record(&state, &[body(0.7)], &later).expect("a state");
    let extent = (100.0 - com[0]).hypot(0.7 - com[1] - 40.0 * 0.7 / mass);
    assert_close(
        "beside it",
        &[audit.drift().center_of_mass_drift],
        &[40.0 * 0.1 / mass / extent],
        tolerance::IDENTITY,
    );
}

/// Of two consecutive phases the larger violation is kept, at its time since the start of the first.
#[test]
fn limit_violations_of_consecutive_phases() {
    let violation = |value, time| Some(LimitViolation { joint: "joint 1 of arm".to_owned(), time, value, limit: 1.0 });
    let first = LimitViolations { joint_angle: violation(1.5, 2.0), joint_rate: None };
    let second = LimitViolations { joint_angle: violation(1.2, 3.0), joint_rate: violation(1.1, 0.5) };
    let both = LimitViolations { joint_angle: violation(1.5, 2.0), joint_rate: violation(1.1, 10.5) };
    assert_eq!(first.clone().then(second.clone(), 10.0), both);
    assert_eq!(
        second.then(first, 10.0),
        LimitViolations { joint_angle: violation(1.5, 12.0), joint_rate: violation(1.1, 0.5) }
    );
}

/// All moves along one line through the origin: the angular momentum is that of rounding, which is no drift.
#[test]
fn motion_along_a_line_has_no_drift() {
    let text = "name = \"head_on\"\nlayout = \"dual_arm_2r\"\n[initial]\njoint_angles = [0.0, 0.0, 3.141592653589793, 0.0]\n\
                [approach]\nduration = 1.0\ntrajectory = \"quintic\"\ntracking = \"exact\"\n\
                final_joint_angles = [0.0, 0.0, 3.141592653589793, 0.0]\nfinal_joint_rates = [0.0, 0.0, 0.0, 0.0]\n\
                [[target]]\nname = \"t\"\narm = \"arm1\"\nmass = 20.0\ninertia = 1.0\nradius = 0.3\ncontact = [-0.3, 0.0]\n\
                twist = [0.0, -0.1, 0.0]\n[post_impact]\nduration = 5.0\n";
    let scenario = Scenario::parse(text, "it.toml", "".as_ref(), registry::SHIPPED);
    let study = run(&scenario.unwrap_or_else(|report| panic!("{report}")));
    assert_eq!(study.audit_failures(), Vec::<String>::new());
}

/// A drift of the centre of mass beyond its bound is an objection.
#[test]
fn a_drift_of_the_centre_of_mass_is_an_objection() {
    let mut study = run(&scenario("redysim_single_arm_3r"));
    assert!(study.approach.drift.center_of_mass_drift < 1e-12, "{:?}", study.approach.drift);
    study.approach.drift.center_of_mass_drift = 1.1e-9;
    let failures = study.audit_failures();
    assert!(
        matches!(failures.as_slice(), [one] if one.contains("approach: centre-of-mass drift 1.10e-9")),
        "{failures:?}"
    );
    study.approach.drift.center_of_mass_drift = f64::NAN;
    assert_eq!(study.audit_failures().len(), 1);
}

/// Sets a number of a study.
type Change = fn(&mut Study, f64);

/// Every number that the audit judges: a little over its bound, which the book states, or not a number, it is one objection; a little under, none.
#[test]
fn every_audited_number_has_its_bound() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    let mut study = run(&scenario);
    let first = capture(&mut study).impact.clone();
    capture(&mut study).later_impacts = vec![LaterImpact { time: 1.0, impact: first }];
    assert_eq!(study.audit_failures(), Vec::<String>::new());
    let numbers: [(&str, f64, Change); 16] = [
        ("approach: momentum drift", 1e-9, |s, x| s.approach.drift.momentum_drift = x),
        ("approach: energy error", 1e-6, |s, x| s.approach.drift.energy_error = x),
        ("post-impact: momentum drift", 1e-9, |s, x| capture(s).post_impact.drift.momentum_drift = x),
        ("post-impact: energy error", 1e-6, |s, x| capture(s).post_impact.drift.energy_error = x),
        ("centre-of-mass drift", 1e-9, |s, x| capture(s).post_impact.drift.center_of_mass_drift = x),
        ("approach: path error", 1e-4, |s, x| s.approach.path_error = x),
        ("post-impact: path error", 1e-4, |s, x| capture(s).post_impact.path_error = x),
        ("approach: opening of", 1e-10, |s, x| s.approach.constraint_errors[0] = x),
        ("post-impact: opening of", 1e-10, |s, x| capture(s).post_impact.constraint_errors[0] = x),
        ("post-impact: rate of opening of", 1e-10, |s, x| capture(s).post_impact.constraint_errors[1] = x),
        ("changes the momentum", 1e-9, |s, x| capture(s).impact.exact.relative_momentum_jump = x),
        ("changes the momentum", 1e-9, |s, x| {
            capture(s).later_impacts[0].impact.exact.relative_momentum_jump = x;
        }),
        ("raises the kinetic energy", 1e-9, |s, x| raise_energy(&mut capture(s).impact.exact, x)),
        ("raises the kinetic energy", 1e-9, |s, x| {
            raise_energy(&mut capture(s).later_impacts[0].impact.exact, x);
        }),
        ("inside a target", 1e-6, |s, x| capture(s).penetration = x),
        ("inside a target", 1e-6, |s, x| {
            // no impact either: the pair never meets
            s.cases[0].capture = None;
            s.cases[0].closest = vec![ClosestApproach { target: 0, arm: 0, distance: -x, time: 1.0 }];
        }),
    ];
    for (what, bound, change) in numbers {
        let failures = |value: f64| {
            let mut study = study.clone();
            change(&mut study, value);
            study.audit_failures()
        };
        assert_eq!(failures(0.99 * bound), Vec::<String>::new(), "{what}");
        for value in [1.01 * bound, f64::INFINITY, f64::NAN] {
            let found = failures(value);
            assert!(matches!(found.as_slice(), [one] if one.contains(what)), "{what} of {value}: {found:?}");
        }
    }
}

fn capture(study: &mut Study) -> &mut CaptureResult {
    study.cases[0].capture.as_mut().expect("a capture")
}

fn raise_energy(impact: &mut ImpactResult, part: f64) {
    impact.kinetic_energy_after = impact.kinetic_energy_before * (1.0 + part);
}

/// A number that is not one stays in every largest error.
#[test]
fn what_is_not_a_number_stays_in_the_largest() {
    let layout = scenario("redysim_single_arm_3r").layout;
    let model = registry::generated(&layout).expect("generated code");
    let state = State {
        base_pose: [0.0; 3],
        joint_angles: &[0.3, -1.2, 0.7],
        base_twist: [0.1, 0.2, 0.3],
        joint_rates: &[0.1; 3],
    };
    let drift = |input: AccumulatedInput| {
        let mut audit = ConservationAudit::new(&*model, &state, &[]).expect("a state");
        audit.record(&state, &[], &input).expect("a state");
        audit.record(&state, &[], &AccumulatedInput::default()).expect("a state");
        audit.drift()
    };
    let none = AccumulatedInput::default();
    assert!(drift(AccumulatedInput { work: f64::NAN, ..none }).energy_error.is_nan());
    assert!(drift(AccumulatedInput { time: f64::NAN, ..none }).center_of_mass_drift.is_nan());
    for place in 0..3 {
        let mut impulse = [0.0; 3];
        impulse[place] = f64::NAN;
        assert!(drift(AccumulatedInput { impulse, ..none }).momentum_drift.is_nan(), "{place}");
    }
    let fine = ConservationErrors::default();
    let bad = ConservationErrors { momentum_drift: f64::NAN, energy_error: f64::NAN, center_of_mass_drift: f64::NAN };
    for both in [fine.worse(&bad), bad.worse(&fine)] {
        let errors = [both.momentum_drift, both.energy_error, both.center_of_mass_drift];
        assert!(errors.iter().all(|error| error.is_nan()), "{errors:?}");
    }
    let mut phase = run(&scenario("redysim_single_arm_3r")).approach;
    phase.constraint_errors = [f64::NAN, 0.0];
    phase.singularity_margin = Some(f64::NAN);
    let fine = Phase { constraint_errors: [0.0; 2], singularity_margin: Some(0.5), ..phase.clone() };
    for both in [fine.clone().then(phase.clone()), phase.then(fine)] {
        assert!(both.constraint_errors[0].is_nan() && both.singularity_margin.is_some_and(f64::is_nan));
    }
    let limits = JointLimits { angles: Some([-1.0, 1.0]), rate: Some(1.0), ..JointLimits::default() };
    assert!(limits.angle_beyond(f64::NAN).is_some() && limits.rate_beyond(f64::NAN).is_some());
    assert!(limits.angle_beyond(0.0).is_none() && limits.rate_beyond(-1.0).is_none());
}

fn limited(layout: &Layout, angles: [f64; 2], rate: f64) -> Vec<JointLimits> {
    let limits = |i| JointLimits { name: layout.joint_name(i), angles: Some(angles), rate: Some(rate) };
    (0..layout.joints()).map(limits).collect()
}

/// Largest violation over the samples, one per step: (joint, time, value).
fn worst(phase: &Phase, values: impl Fn(usize) -> Vec<f64>, beyond: impl Fn(f64) -> f64) -> (usize, f64, f64) {
    let mut worst = (0, 0.0, 0.0);
    let mut most = 0.0;
    for (i, sample) in phase.samples.iter().enumerate() {
        for (joint, value) in values(i).into_iter().enumerate() {
            if beyond(value) > most {
                (most, worst) = (beyond(value), (joint, sample.time, value));
            }
        }
    }
    worst
}

/// In every kind of phase the reported violation is the largest of the time series, or one between two of its rows.
#[test]
fn the_largest_limit_violation_is_found() {
    let mut studies = Vec::new();
    for (name, tracking) in [
        ("raina_shah_2017", None),
        ("raina_shah_2017", Some(Tracking::InverseDynamics)),
        ("resolved_motion_rate", None),
        ("stabilised_capture", None),
    ] {
        let mut scenario = scenario(name);
        scenario.approach.step = 0.05;
        scenario.cases.truncate(1);
        scenario.approach.actuation.steps_per_sample = scenario.approach.actuation.steps_per_sample.map(|_| 1);
        scenario.approach.tracking = tracking.unwrap_or(scenario.approach.tracking);
        let limits = limited(&scenario.layout, [-1.45, 2.5], 0.12);
        scenario.joint_limits = limits;
        scenario.post_impact.as_mut().expect("a capture").step = 0.05;
        let study = run(&scenario);
        studies.push((scenario, study));
    }
    let mut seen = 0;
    for (scenario, study) in &studies {
        let captured = study.cases[0].capture.as_ref().expect("a capture");
        for phase in [&study.approach, &captured.post_impact] {
            let limit_violations = phase.limit_violations.as_ref().expect("limits");
            let angles = |i: usize| phase.samples[i].state.joint_angles.clone();
            let rates = |i: usize| phase.samples[i].state.joint_rates.clone();
            let checks = [
                (&limit_violations.joint_angle, worst(phase, angles, |x| (x - 2.5).max(-1.45 - x))),
                (&limit_violations.joint_rate, worst(phase, rates, |x| x.abs() - 0.12)),
            ];
            for (found, (joint, time, value)) in checks {
                let Some(LimitViolation { joint: name, time: at, value: found, limit }) = found else {
                    assert!(value.abs() <= 0.0, "{}: an excess that was not found", scenario.name);
                    continue;
                };
                seen += 1;
                assert_eq!(name, &scenario.layout.joint_name(joint), "{}", scenario.name);
                // between two of the samples, which are a step apart, it can be larger
                assert!((at - time).abs() <= 0.05, "{}: at {at} s, sampled at {time} s", scenario.name);
                let larger = found.abs() - value.abs();
                assert!((0.0..1e-3).contains(&larger), "{}: {found}, sampled {value}", scenario.name);
                assert!([-1.45, 2.5, -0.12, 0.12].contains(limit) && limit.signum() == found.signum(), "{limit}");
            }
        }
        assert!(study.audit_failures().iter().any(|failure| failure.contains("beyond its limit of")));
    }
    assert!(seen > 10, "{seen} excesses");
    let (scenario, study) = &studies[0];
    let value = summary(scenario, study);
    let violation = &value["cases"][0]["approach"]["limits"]["joint_angle"];
    let expected = study.approach.limit_violations.as_ref().and_then(|e| e.joint_angle.as_ref()).expect("an excess");
    assert_eq!(
        (violation["joint"].as_str(), violation["time"].as_f64()),
        (Some(expected.joint.as_str()), Some(expected.time))
    );
    assert_eq!(
        (violation["value"].as_f64(), violation["limit"].as_f64()),
        (Some(expected.value), Some(expected.limit))
    );
}

/// Read from a file: one pair or one per joint, and none where none is given.
#[test]
fn limits_are_read_joint_by_joint() {
    let text = fs::read_to_string(file("scenarios/redysim_single_arm_3r.toml")).expect("a scenario");
    let read = |limits: &str| -> Vec<JointLimits> {
        let text = text.replace("[approach]", &format!("{limits}\n[approach]"));
        let scenario = Scenario::parse(&text, "it.toml", std::path::Path::new(""), registry::SHIPPED);
        scenario.unwrap_or_else(|report| panic!("{report}")).joint_limits
    };
    assert_eq!(read(""), []);
    let found = read("[limits]\njoint_angles = [[-2, 2.0], [], [-1.6, 1.3]]\njoint_rates = 0.2");
    assert_eq!(found.iter().map(|l| l.angles).collect::<Vec<_>>(), [Some([-2.0, 2.0]), None, Some([-1.6, 1.3])]);
    assert!(found.iter().all(|limit| limit.rate == Some(0.2)));
    let found = read("[limits]\njoint_angles = [-3, 3]");
    assert!(found.iter().all(|limit| limit.angles == Some([-3.0, 3.0]) && limit.rate.is_none()));
    assert_eq!(found[2].name, "joint 3 of arm1");
    let found = read("[limits]\njoint_rates = [0.1, 0.2, 0.3]");
    assert_eq!(found[1], JointLimits { name: "joint 2 of arm1".to_owned(), angles: None, rate: Some(0.2) });
}

/// The table says whether both phases keep the limits; a violation gives exit code 1.
#[test]
fn the_exit_code_says_that_a_limit_was_exceeded() {
    let folder = TempDir::new().expect("a folder");
    let run = |limits: &str| {
        let text = fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
        let path = folder.path().join("it.toml");
        fs::write(&path, text.replace("[approach] #", &format!("{limits}\n[approach] #"))).expect("written");
        let mut command = command();
        command.args(["run", "--dynamics", "generated"]).arg(&path).arg("--out").arg(folder.path().join("out"));
        said(command.output().expect("it runs"))
    };
    let (code, out, err) = run("[limits]\njoint_angles = [-6, 6]\njoint_rates = 2");
    assert_eq!((code, err.as_str()), (0, ""), "{err}");
    assert_eq!(out.matches("all joints within their limits").count(), 4, "{out}");
    let (code, out, err) = run("[limits]\njoint_rates = [2, 0.1, 2, 2, 2, 2]");
    assert_eq!(code, 1);
    assert!(
        err.contains("audit: approach: joint 2 of arm1 turns with")
            && err.contains(" rad/s at ")
            && err.contains(" s, beyond its limit of -0.1 rad/s"),
        "{err}"
    );
    assert!(out.contains("joint 2 of arm1 turns with"), "{out}");
    let (code, _, err) = run("[limits]\njoint_angles = [[], [-1.5, 1.5], [], [], [], []]");
    assert_eq!(code, 2);
    assert!(err.contains("`initial.joint_angles[1]` is -1.571: outside the limits of joint 2 of arm1, -1.5"), "{err}");
    assert!(err.contains("(`limits.joint_angles`)") && err.contains("it.toml:12:"), "{err}");
}

/// Ten overlaps of a case are named; the others are counted, be it one.
#[test]
fn overlaps_beyond_the_tenth_are_counted() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    scenario.clearance.on_overlap = OnOverlap::Fail;
    let mut study = run(&scenario);
    let overlap = study.cases[0].clearance.failures().next().expect("an overlap").clone();
    for (number, expected) in [
        (10, None),
        (11, Some("case1: 1 more overlap, all in the summary")),
        (13, Some("case1: 3 more overlaps, all in the summary")),
    ] {
        study.cases[0].clearance.overlaps = vec![overlap.clone(); number];
        let failures = study.audit_failures();
        let more: Vec<_> = failures.iter().filter(|failure| failure.contains(" more ")).map(String::as_str).collect();
        assert_eq!(more, expected.into_iter().collect::<Vec<_>>());
        assert_eq!(failures.iter().filter(|failure| failure.contains(&overlap.sentence())).count(), 10);
    }
}

/// Limits do not change the motion.
#[test]
fn limits_are_monitored_and_not_enforced() {
    let mut scenario = scenario("stabilised_capture");
    scenario.cases.truncate(1);
    let free = run(&scenario);
    scenario.joint_limits = limited(&scenario.layout, [-0.1, 0.1], 0.01);
    let after = scenario.post_impact.as_ref().expect("a capture");
    assert!(matches!(after.control, PostCaptureControl::Stabilise { .. }));
    let monitored = run(&scenario);
    assert_eq!(free.approach.samples, monitored.approach.samples);
    let of = |study: &Study| study.cases[0].capture.as_ref().expect("one").post_impact.samples.clone();
    assert_eq!(of(&free), of(&monitored));
    assert!(free.approach.limit_violations.is_none() && monitored.approach.limit_violations.is_some());
}
