//! Numbers of the summary, the table and the report against what they are made of.

use crate::{Silent, command, data_of, report, run, scenario, summary};
use planar_capture::capture::clearance::LeastDistance;
use planar_capture::capture::residual_motion::ResidualMotion;
use planar_capture::capture::{CaseResult, Study, study};
use planar_capture::output::console::table;
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_capture::scenario::{Detection, PostCaptureControl, Scenario};
use planar_capture::simulate::Sample;
use planar_capture::simulate::limits::{LimitViolation, LimitViolations};
use planar_capture::simulate::system::Body;
use planar_proof::{assert_close, file, layout, said, tolerance};
use serde_json::{Value, json};
use tempfile::TempDir;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is a number"))
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

/// The mean force of a contact is its impulse over the duration of the contact: in the summary, and in the table.
#[test]
fn the_mean_force_is_the_impulse_over_the_duration() {
    let scenario = scenario("spinning_target");
    let duration = scenario.contact.duration.expect("a duration");
    assert!((duration - 1.0).abs() > 0.1, "another one than 1 s");
    let value = summary(&scenario, &run(&scenario));
    let mut impulses = Vec::new();
    for case in value["cases"].as_array().expect("cases") {
        for contact in case["impact"]["contacts"].as_array().expect("contacts") {
            let (force, impulse) = (numbers(&contact["mean_force"]), numbers(&contact["impulse"]));
            assert_close("force × time", &force.iter().map(|f| f * duration).collect::<Vec<_>>(), &impulse, 1e-12);
            impulses.push(impulse[1].hypot(impulse[2]));
        }
    }
    let folder = TempDir::new().expect("a folder");
    let path = file("scenarios/spinning_target.toml");
    let run = command().arg("run").arg(path).arg("--out").arg(folder.path().join("out")).output();
    let (code, table, _) = said(run.expect("it runs"));
    assert_eq!(code, 0);
    let (_, table) = table.split_once("mean force [N]\n").expect("a column");
    for (impulse, row) in impulses.iter().zip(table.lines()) {
        let force: f64 = row.split_whitespace().last().expect("a last column").parse().expect("a force");
        // three decimals of it
        assert_close(row, &[force], &[impulse / duration], 6e-4);
    }
}

/// The base's work is what the change of energy leaves of the joints' work.
#[test]
fn the_base_work_completes_the_energy_balance() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.post_impact.as_mut().expect("a capture").control =
        PostCaptureControl::Stabilise { derivative_gain: vec![0.5; 6], base_gain: 0.5, base_torque_limit: Some(1e3) };
    let study = run(&scenario);
    let value = summary(&scenario, &study);
    for (case, value) in study.cases.iter().zip(value["cases"].as_array().expect("cases")) {
        let phase = &case.capture.as_ref().expect("a capture").post_impact;
        let energy = phase.end().momentum.kinetic_energy - phase.samples[0].momentum.kinetic_energy;
        let work = number(&value["post_impact"]["base_work"]);
        assert!(work.abs() > 1e-6, "{work} J");
        assert_close("ΔE", &[phase.end().work.joint_work + work], &[energy], tolerance::TIME_SERIES);
    }
}

/// A robot that is stabilised by joints and base.
fn stabilised() -> (Scenario, Study) {
    let mut scenario = scenario("stabilised_capture");
    scenario.post_impact.as_mut().expect("a capture").duration = 10.0;
    let study = run(&scenario);
    (scenario, study)
}

/// Torques at the base alone change the angular momentum of all bodies: what they take is what it has lost.
#[test]
fn the_table_says_what_the_base_torque_takes() {
    let (scenario, study) = stabilised();
    let table = table(&scenario, &study);
    let taken = table.split("base torque: ").skip(1).map(|rest| rest.split_whitespace().next().expect("a number"));
    let taken: Vec<f64> = taken.map(|text| text.parse().expect("a number")).collect();
    let lost = study.cases.iter().map(|case| {
        let samples = &case.capture.as_ref().expect("a capture").post_impact.samples;
        let [start, end] = [&samples[0], &samples[samples.len() - 1]].map(|sample| sample.momentum.angular_momentum);
        start - end
    });
    let lost: Vec<f64> = lost.collect();
    assert!(lost.iter().any(|lost| lost.abs() > 0.1), "{lost:?}");
    // six decimals of it
    assert_close("taken", &taken, &lost, 6e-7);
}

/// The cells of the residual motion are under their own heads.
#[test]
fn the_table_says_the_residual_motion() {
    let (scenario, study) = stabilised();
    let table = table(&scenario, &study);
    let (_, rows) = table.split_once("Residual motion").expect("a table");
    let mut lines = rows.lines().skip(1);
    let heads = lines.next().expect("heads");
    let at = |head: &str| heads.find(head).unwrap_or_else(|| panic!("{head} in `{heads}`"));
    assert!(at("base rate") < at("l/I") && at("l/I") < at("joint rates") && at("joint rates") < at("l [N m s]"));
    let mut rows = lines.filter(|line| line.split_whitespace().count() == 7);
    for case in &study.cases {
        let residual = case.capture.as_ref().and_then(|it| it.residual_motion.as_ref()).expect("a motion");
        let row = rows.next().expect("one per case");
        let cells: Vec<f64> = row.split_whitespace().skip(1).map(|cell| cell.parse().expect("a number")).collect();
        let rates = [residual.base_rate, residual.rigid_rate];
        assert!((rates[0] - rates[1]).abs() > 1e-5, "{rates:?} differ in the table");
        assert_close("rates", &cells[..2], &rates, 6e-7);
        assert_close("joint rates", &cells[2..3], &[residual.largest_joint_rate], 0.06 * residual.largest_joint_rate);
        assert_close("momentum", &cells[3..], &residual.momentum, 6e-7);
    }
}

/// The report's poses and twists of targets are theirs, sample by sample.
#[test]
fn the_reports_targets_move_as_they_do() {
    let (scenario, study) = stabilised();
    let data = report_data(&scenario, &study);
    for (case, data) in study.cases.iter().zip(data["cases"].as_array().expect("cases")) {
        let capture = case.capture.as_ref().expect("a capture");
        let columns = |key: &str, target: usize, part: usize| numbers(&data["post_impact"][key][target][part]);
        for target in 0..scenario.targets.len() {
            for part in 0..3 {
                let of = |vector: fn(&Body) -> [f64; 3]| {
                    capture.targets.iter().map(|bodies| vector(&bodies[target])[part]).collect::<Vec<_>>()
                };
                let (poses, twists) = (of(|body| body.pose), of(|body| body.twist));
                let sizes = [&poses, &twists].map(|all| all.iter().fold(0.0_f64, |most, x| most.max(x.abs())));
                assert!(twists.iter().any(|x| x.abs() > 1e-4), "{twists:?}");
                // six digits are written
                assert_close("poses", &columns("targets", target, part), &poses, 1e-5 * sizes[0]);
                assert_close("twists", &columns("target_twists", target, part), &twists, 1e-5 * sizes[1]);
            }
        }
    }
}

/// A loop of two rigid contacts opens in the report where one of them turns, too.
#[test]
fn the_reports_openings_have_rotations() {
    let mut scenario = scenario("large_target");
    scenario.post_impact.as_mut().expect("a capture").duration = 1.0;
    let mut study = run(&scenario);
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    let turned = capture.targets.len() / 2;
    let before = report_data(&scenario, &study);
    study.cases[0].capture.as_mut().expect("a capture").targets[turned][0].pose[0] += 1e-3;
    let after = report_data(&scenario, &study);
    let open = |data: &Value| {
        let holds = &data["cases"][0]["post_impact"]["holds"];
        let columns: Vec<f64> =
            holds.as_array().expect("a list").iter().map(|hold| number(&hold["open"][turned])).collect();
        columns.into_iter().fold(0.0, f64::max)
    };
    assert!(open(&before) < 1e-9, "{}", open(&before));
    // closed from the first sample after the impact on
    let holds = before["cases"][0]["post_impact"]["holds"].as_array().expect("a list");
    assert!(!holds.is_empty() && holds.iter().all(|hold| hold["open"][0] == 0.0), "{:?}", holds[0]["open"][0]);
    assert_close("the turn", &[open(&after)], &[1e-3], 1e-5);
}

/// In the report the work of a phase is that of all actuators, which the energy of all bodies has gained.
#[test]
fn the_reports_work_is_that_of_joints_and_base() {
    let (scenario, study) = stabilised();
    let data = report_data(&scenario, &study);
    for (case, data) in study.cases.iter().zip(data["cases"].as_array().expect("cases")) {
        let phase = &case.capture.as_ref().expect("a capture").post_impact;
        let gained = phase.end().momentum.kinetic_energy - phase.samples[0].momentum.kinetic_energy;
        let of_base = phase.end().work.base_work;
        let work = numbers(&data["post_impact"]["work"]);
        assert!(of_base.abs() > 1e-3 * gained.abs(), "{of_base} J of {gained} J");
        // six digits are written
        assert_close("work", &work[work.len() - 1..], &[gained], 1e-5 * gained.abs());
    }
}

/// An end effector and a target close at a positive speed, which the impulse of a bounce is the multiple of.
#[test]
fn the_reports_closing_speeds_give_the_impulses() {
    let mut scenario = scenario("elastic_rebound");
    // each target has its own restitution
    scenario.cases[1].restitutions = vec![0.9, 0.2];
    let data = report_data(&scenario, &run(&scenario));
    let (mut seen, mut of_targets) = (0, [0; 2]);
    for (case, given) in data["cases"].as_array().expect("cases").iter().zip(&scenario.cases) {
        for impact in case["impacts"].as_array().expect("impacts") {
            let [contact] = &impact["contacts"].as_array().expect("contacts")[..] else { continue };
            let [speed, index] = ["closing_speed", "impulse_index"].map(|key| number(&contact[key]));
            let target = usize::from(contact["target"] == 1);
            let restitution = given.restitutions[target];
            assert_eq!(number(&contact["restitution"]).to_bits(), restitution.to_bits());
            let impulse = numbers(&contact["impulse"]);
            let expected = impulse[1].hypot(impulse[2]);
            let found = index * speed * (1.0 + restitution);
            assert_close("impulse", &[found], &[expected], tolerance::SAME_IMPACT * expected);
            seen += 1;
            of_targets[target] += 1;
        }
    }
    assert!(seen > 2 && of_targets.iter().all(|count| *count > 0), "{seen} single contacts, {of_targets:?}");
}

/// Two arms that meet one target, each with its own kind of contact, of which one is found by detection and the other at the
/// same time.
#[test]
fn detected_contacts_have_the_kinds_of_their_arms() {
    let mut scenario = scenario("large_target");
    scenario.cases.retain(|case| case.name == "rigid_and_pin");
    scenario.contact.detection = Detection::Event;
    scenario.targets[0].position = Some([0.4, 3.05]);
    scenario.targets[0].yaw = -0.6;
    let summary = summary(&scenario, &run(&scenario));
    let case = &summary["cases"][0];
    let later = case["post_impact"]["impacts"].as_array().into_iter().flatten();
    let contacts =
        std::iter::once(&case["impact"]).chain(later).filter_map(|impact| impact["contacts"].as_array()).flatten();
    let words = |contact: &Value| ["arm", "kind"].map(|key| contact[key].as_str().expect("a word").to_owned());
    let mut found: Vec<_> = contacts.map(words).collect();
    found.sort();
    assert_eq!(found, [["arm1", "rigid"], ["arm2", "pin"]]);
}

/// The arm that is too late for the box is named with it, whichever target is the first in the file.
#[test]
fn what_is_not_met_has_its_name_whatever_the_order() {
    let mut scenario = scenario("elastic_rebound");
    scenario.cases.retain(|case| case.name == "too_late");
    let closest = |scenario: &Scenario| summary(scenario, &run(scenario))["cases"][0]["closest"].clone();
    let before = closest(&scenario);
    scenario.targets.reverse();
    let case = &mut scenario.cases[0];
    case.target_twists.reverse();
    case.kinds.reverse();
    case.restitutions.reverse();
    case.printed_impulses.reverse();
    let after = closest(&scenario);
    for found in [&before, &after] {
        let [pair] = &found.as_array().expect("a list")[..] else { panic!("{found}") };
        assert_eq!((&pair["target"], &pair["arm"]), (&"box".into(), &"arm2".into()));
    }
    let of = |found: &Value, key: &str| number(&found[0][key]);
    assert_close("distance", &[of(&after, "distance")], &[of(&before, "distance")], tolerance::CLEARANCE);
}

/// The summary's first overlap is the earliest of those that it lists.
#[test]
fn the_first_overlap_is_the_earliest() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    let value = summary(&scenario, &run(&scenario));
    let clearance = &value["cases"][0]["clearance"];
    let begins: Vec<f64> =
        clearance["overlaps"].as_array().expect("a list").iter().map(|overlap| number(&overlap["from"])).collect();
    let [earliest, latest] = [begins.iter().copied().reduce(f64::min), begins.iter().copied().reduce(f64::max)];
    assert!(earliest < latest, "{begins:?}");
    assert_eq!(clearance["first_overlap"].as_f64(), earliest);
}

/// Actuators are watched at every step, whatever is sampled.
#[test]
fn saturation_does_not_depend_on_the_samples() {
    let scenario = scenario("stabilised_capture");
    let model = registry::generated(&scenario.layout).expect("generated code");
    let step = scenario.post_impact.as_ref().expect("a capture").step;
    let [every_step, ends] = [step, 1e3].map(|sample| {
        let study = study(&scenario, &|| model.clone_box(), sample, &mut Silent).expect("a study");
        let of = |case: &CaseResult| case.capture.as_ref().expect("a capture").post_impact.saturation.clone();
        study.cases.iter().map(of).collect::<Vec<_>>()
    });
    assert!(every_step.iter().any(|saturation| saturation.base > 1.0), "{every_step:?}");
    assert_eq!(every_step, ends);
}

/// Wheels are listed by themselves: they keep turning.
#[test]
fn the_largest_joint_rate_is_of_the_joints_without_wheels() {
    let layout = layout("asymmetric_wheel");
    let model = registry::generic(&layout);
    let count = layout.joints();
    let rates: Vec<f64> = [0.1, -0.3, 0.2, -5.0, 0.05, 7.0].into_iter().cycle().take(count).collect();
    let wheels: Vec<bool> = rates.iter().map(|rate| rate.abs() > 1.0).collect();
    let state = RobotState {
        base_pose: [0.0; 3],
        joint_angles: vec![0.2; count],
        base_twist: [0.0; 3],
        joint_rates: rates.clone(),
    };
    let found = ResidualMotion::of(&*model, &[], "none", &state, &wheels).expect("a motion");
    assert_close("largest", &[found.largest_joint_rate], &[0.3], 0.0);
    assert_eq!(found.wheel_rates, rates.iter().copied().filter(|rate| rate.abs() > 1.0).collect::<Vec<_>>());
}

/// A bounce has no tangential impulse: its magnitude is index × closing speed × (1 + restitution).
#[test]
fn the_impulse_index_of_a_bounce_gives_its_impulse() {
    let study = run(&scenario("elastic_rebound"));
    let mut seen = 0;
    for case in &study.cases {
        let Some(capture) = &case.capture else { continue };
        for impact in capture.impacts() {
            let [contact] = impact.contacts.as_slice() else { continue };
            let ([nx, ny], restitution) = contact.contact.law.bounce().expect("a bounce");
            let [_, vx, vy] = contact.response.relative_twist;
            let index = contact.response.impulse_index.expect("an index");
            let closing = (vx * nx + vy * ny).abs();
            let tangential = (vx * ny - vy * nx).abs();
            assert!(tangential > 0.01 * closing, "an oblique one: {vx} {vy} along {nx} {ny}");
            let [_, fx, fy] = contact.impulse;
            let expected = index * closing * (1.0 + restitution);
            assert_close("impulse", &[fx.hypot(fy)], &[expected], tolerance::SAME_IMPACT * expected);
            seen += 1;
        }
    }
    assert!(seen > 2, "{seen} single contacts");
}

/// The frames that the report draws carry the end effectors to their poses, mount angles included.
#[test]
fn the_reports_frames_end_at_the_end_effectors() {
    let scenario = scenario("three_arms");
    assert!(scenario.layout.arms.iter().any(|arm| arm.mount_angle.abs() > 0.1));
    let data = report_data(&scenario, &run(&scenario));
    let (layout, phase) = (&data["parts"][0]["layout"], &data["parts"][0]["approach"]);
    let (frames, times) = (layout["frames"].as_array().expect("frames"), phase["time"].as_array().expect("times"));
    for i in (0..times.len()).step_by(50) {
        let now = |column: &Value| number(&column[i]);
        let base = [0, 1, 2].map(|part| now(&phase["base_pose"][part]));
        let mut poses = vec![base];
        let mut ends = Vec::new();
        for (k, frame) in frames.iter().enumerate().skip(1) {
            let parent = frame["parent"].as_u64().expect("a parent");
            let [yaw, x, y] = poses[usize::try_from(parent).expect("small")];
            let pose = numbers(&frame["pose"]);
            let turn = frame["joint"]
                .as_u64()
                .map_or(0.0, |joint| now(&phase["joint_angles"][usize::try_from(joint).expect("small")]));
            let (sin, cos) = yaw.sin_cos();
            poses.push([yaw + pose[0] + turn, x + cos * pose[1] - sin * pose[2], y + sin * pose[1] + cos * pose[2]]);
            if frame["joint"].is_null() {
                ends.push(poses[k]);
            }
        }
        for (end, columns) in ends.iter().zip(phase["end_effectors"].as_array().expect("arms")) {
            let expected = [0, 1, 2].map(|part| now(&columns[part]));
            let turns = ((end[0] - expected[0]) / std::f64::consts::TAU).round();
            let found = [end[0] - turns * std::f64::consts::TAU, end[1], end[2]];
            // six digits are written
            assert_close("end effector", &found, &expected, 1e-4);
        }
        assert_eq!(ends.len(), scenario.layout.arms.len());
    }
}

/// The keys of the summary have the numbers of the study whose names they bear.
#[test]
fn the_summary_has_the_numbers_of_its_keys() {
    let (scenario, mut study) = stabilised();
    let violation = |joint: &str, value: f64| LimitViolation { joint: joint.to_owned(), time: 0.5, value, limit: 0.25 };
    study.approach.limit_violations = Some(LimitViolations {
        joint_angle: Some(violation("joint 1", 0.75)),
        joint_rate: Some(violation("joint 2", -0.5)),
    });
    let expected_limits = json!({
        "joint_angle": {"joint": "joint 1", "time": 0.5, "value": 0.75, "limit": 0.25},
        "joint_rate": {"joint": "joint 2", "time": 0.5, "value": -0.5, "limit": 0.25},
    });
    let value = summary(&scenario, &study);
    for (case, value) in study.cases.iter().zip(value["cases"].as_array().expect("cases")) {
        assert_eq!(value["approach"]["limits"], expected_limits);
        let capture = case.capture.as_ref().expect("a capture");
        let residual = capture.residual_motion.as_ref().expect("a motion");
        let remainder = &value["post_impact"]["remainder"];
        for (key, wanted) in [
            ("rigid_rate", &[residual.rigid_rate][..]),
            ("base_rate", &[residual.base_rate]),
            ("largest_joint_rate", &[residual.largest_joint_rate]),
            ("inertia", &[residual.inertia]),
            ("momentum", &residual.momentum),
            ("velocity", &residual.velocity),
            ("wheel_rates", &residual.wheel_rates),
        ] {
            let found =
                if remainder[key].is_array() { numbers(&remainder[key]) } else { vec![number(&remainder[key])] };
            assert_eq!(found, wanted, "{key}");
        }
        for (result, value) in
            capture.impact.contacts.iter().zip(value["impact"]["contacts"].as_array().expect("contacts"))
        {
            let response = &result.response;
            let optional = |numbers: Option<Vec<f64>>| numbers.map_or(Value::Null, Value::from);
            for (key, wanted) in [
                ("offset", json!(result.contact.offset)),
                ("miss", json!(result.contact.miss)),
                ("impulse", json!(result.impulse)),
                ("relative_twist", json!(response.relative_twist)),
                ("direction", optional(response.direction.map(|direction| direction.to_vec()))),
                ("effective_masses", optional(response.effective_masses.map(|masses| masses.to_vec()))),
                ("impulse_index", json!(response.impulse_index)),
            ] {
                assert_eq!(value[key], wanted, "{key}");
            }
            let [vx, vy] = [response.relative_twist[1], response.relative_twist[2]];
            // of a contact that does not bounce the direction is that of the relative velocity
            if let Some([x, y]) = response.direction {
                assert_close("direction", &[x * vx.hypot(vy), y * vx.hypot(vy)], &[vx, vy], 1e-12);
            }
        }
    }
}

/// An overlap begins before it ends, and the least distance besides planned contacts is none of theirs.
#[test]
fn the_summary_tells_overlaps_and_planned_contacts_apart() {
    let scenario = scenario("elastic_rebound");
    let study = run(&scenario);
    let value = summary(&scenario, &study);
    let mut overlaps = 0;
    for (case, value) in study.cases.iter().zip(value["cases"].as_array().expect("cases")) {
        let (found, clearance) = (&value["clearance"], &case.clearance);
        let least = |value: &Value| [number(&value["least_distance"]), number(&value["time"])];
        let of = |least: Option<&LeastDistance>| least.map(|least| [least.distance, least.time]);
        assert_eq!(Some(least(found)), of(clearance.least.as_ref()));
        let besides = &found["besides_contacts"];
        assert_eq!((!besides.is_null()).then(|| least(besides)), of(clearance.besides_contacts.as_ref()));
        for (overlap, value) in clearance.overlaps.iter().zip(found["overlaps"].as_array().expect("a list")) {
            let [from, to, depth] = ["from", "to", "depth"].map(|key| number(&value[key]));
            assert!(from < to && depth > 0.0, "{value}");
            assert_eq!(([from, to], depth), (overlap.span, overlap.depth));
            assert_eq!(value["default_outline"].as_bool(), Some(overlap.is_default), "{value}");
            overlaps += 1;
        }
        let first = clearance.overlaps.first().map_or(Value::Null, |overlap| json!(overlap.span[0]));
        assert_eq!(found["first_overlap"], first);
    }
    let differ = |case: &CaseResult| case.clearance.least != case.clearance.besides_contacts;
    assert!(study.cases.iter().any(differ) && overlaps > 0, "{overlaps} overlaps");
}

/// An approach that a contact ends stands in the summary with its own end, not with that of the approach without contacts.
#[test]
fn the_summary_has_the_approach_of_each_case() {
    let scenario = scenario("elastic_rebound");
    let study = run(&scenario);
    let value = summary(&scenario, &study);
    let mut ended = 0;
    for (case, value) in study.cases.iter().zip(value["cases"].as_array().expect("cases")) {
        let (own, found) = (case.approach.as_ref().expect("an approach of its own"), &value["approach"]);
        let end = own.end();
        assert_eq!(number(&found["duration"]).to_bits(), own.duration.to_bits());
        assert_eq!(numbers(&found["base_pose"]), end.state.base_pose);
        assert_eq!(numbers(&found["joint_rates"]), end.state.joint_rates);
        assert_eq!(numbers(&found["end_effector_twists"][0]), end.end_effector_twists[0]);
        ended += usize::from(own.duration < study.approach.duration);
    }
    assert!(ended > 0, "a contact ends an approach");
}

/// What few studies have stands in the summary as it is: later impacts since the first one, penetrations however small, and every part of
/// a missed goal.
#[test]
fn the_summary_has_what_few_studies_have() {
    let scenario = scenario("elastic_rebound");
    let mut study = run(&scenario);
    let capture = study.cases[0].capture.as_mut().expect("a capture");
    capture.penetration = 1e-9;
    let times: Vec<f64> = capture.later_impacts.iter().map(|later| later.time).collect();
    let value = summary(&scenario, &study);
    let after = &value["cases"][0]["post_impact"];
    assert_eq!(after["penetration"].as_f64(), Some(1e-9));
    let found = after["impacts"].as_array().expect("later impacts").iter().map(|later| number(&later["time"]));
    assert_eq!(found.collect::<Vec<_>>(), times);
    assert!(!times.is_empty());

    let scenario = crate::scenario("resolved_motion_rate");
    let study = run(&scenario);
    let value = summary(&scenario, &study);
    let missed = value["cases"][0]["approach"]["missed"].as_array().expect("a list").clone();
    assert_eq!(missed.len(), study.terminal_errors.len());
    for (found, error) in missed.iter().zip(&study.terminal_errors) {
        let parts = &error.as_ref().expect("a goal").parts;
        assert_eq!(&numbers(found), parts);
        assert!(parts.len() == 2 && (parts[0] - parts[1]).abs() > 1e-12, "{parts:?}");
    }
}

/// The columns of the report are those of the samples: joints, end effectors and momentum.
#[test]
fn the_reports_columns_are_those_of_the_samples() {
    let (scenario, study) = stabilised();
    let data = report_data(&scenario, &study);
    let phases = std::iter::once((&study.approach, &data["parts"][0]["approach"]));
    let after = study.cases.iter().zip(data["cases"].as_array().expect("cases"));
    let after =
        after.map(|(case, data)| (&case.capture.as_ref().expect("a capture").post_impact, &data["post_impact"]));
    let phases: Vec<_> = phases.filter(|(_, data)| !data.is_null()).chain(after).collect();
    assert!(!phases.is_empty());
    for (phase, data) in phases {
        let column = |what: &str, found: &Value, value: &dyn Fn(&Sample) -> f64| {
            let wanted: Vec<f64> = phase.samples.iter().map(value).collect();
            let size = wanted.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            // six digits are written
            assert_close(what, &numbers(found), &wanted, 1e-5 * size);
        };
        for joint in 0..scenario.layout.joints() {
            column("angles", &data["joint_angles"][joint], &|sample| sample.state.joint_angles[joint]);
            column("rates", &data["joint_rates"][joint], &|sample| sample.state.joint_rates[joint]);
            column("torques", &data["joint_torques"][joint], &|sample| sample.joint_torques[joint]);
        }
        for part in 0..3 {
            column("pose", &data["base_pose"][part], &|sample| sample.state.base_pose[part]);
            column("twist", &data["base_twist"][part], &|sample| sample.state.base_twist[part]);
            for arm in 0..scenario.layout.arms.len() {
                column("end effector", &data["end_effectors"][arm][part], &|sample| {
                    sample.end_effector_poses[arm][part]
                });
            }
        }
        for part in 0..2 {
            column("momentum", &data["linear_momentum"][part], &|sample| sample.momentum.linear_momentum[part]);
        }
        column("angular momentum", &data["angular_momentum"], &|sample| sample.momentum.angular_momentum);
        column("energy", &data["kinetic_energy"], &|sample| sample.momentum.kinetic_energy);
    }
}

/// Grasps that do not close are listed as such, and distances of detected contacts fall to zero where one is made.
#[test]
fn the_report_says_which_contacts_are_made() {
    let missed = scenario("missed_grasp");
    let data = report_data(&missed, &run(&missed));
    let open = |case: usize| -> Vec<[u64; 2]> {
        let open = data["cases"][case]["open"].as_array().expect("a list").iter();
        open.map(|one| ["target", "arm"].map(|key| one[key].as_u64().expect("an index"))).collect()
    };
    assert_eq!([open(0), open(1), open(2)], [vec![], vec![[1, 1]], vec![[0, 0], [1, 1]]]);

    let rebound = scenario("elastic_rebound");
    let study = run(&rebound);
    let data = report_data(&rebound, &study);
    let mut met = 0;
    for (case, data) in study.cases.iter().zip(data["cases"].as_array().expect("cases")) {
        let before = case.approach(&study).samples.len();
        let contacts = case.capture.iter().flat_map(|capture| &capture.impact.contacts).map(|result| result.contact);
        for contact in contacts {
            let distances = data["distances"].as_array().expect("a list");
            let is_its_own = |one: &&Value| one["target"] == contact.target && one["arm"] == contact.arm;
            let distance = numbers(&distances.iter().find(is_its_own).expect("one")["distance"]);
            assert!(
                distance[0] > 0.1 && distance[before - 1].abs() < 1e-5,
                "{} m, {} m",
                distance[0],
                distance[before - 1]
            );
            met += 1;
        }
    }
    assert!(met > 1, "{met} contacts");
}

/// A browser ends the data where they end, whatever names are in them.
#[test]
fn the_reports_data_have_no_elements() {
    let mut scenario = scenario("raina_shah_2017");
    scenario.cases.truncate(1);
    let mut study = run(&scenario);
    let name = "<!-- <script> </script>";
    (scenario.cases[0].name, study.cases[0].name) = (name.to_owned(), name.to_owned());
    let page = report(&scenario, &study);
    let (_, rest) = page.split_once("id=\"data\">").expect("data");
    let (data, _) = rest.split_once("</script>").expect("an end");
    assert!(!data.contains('<') && data.contains("\\u003c!-- \\u003cscript>"));
    assert_eq!(data_of(&page)["cases"][0]["name"], name);
}

/// The data that the report's programs read.
fn report_data(scenario: &Scenario, study: &Study) -> Value {
    data_of(&report(scenario, study))
}
