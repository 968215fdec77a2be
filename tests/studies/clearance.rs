//! Clearance and contacts do not depend on steps or samples, and agree with positions computed from samples.

use crate::{Silent, run, scenario};
use planar_capture::capture::{Study, study};
use planar_capture::outline::Outline;
use planar_capture::registry;
use planar_capture::scenario::Scenario;
use planar_capture::simulate::system::Body;
use planar_proof::{assert_close, file, tolerance};
use std::f64::consts::TAU;

const ONE_ARM: &str = "[0.4, -0.9, 0.5]";
const TWO_ARMS: &str = "[0.698, -1.571, 1.047, 2.444, 1.571, -1.047]";

/// A robot at rest, with targets that pass it.
fn at_rest(layout: &str, angles: &str, step: f64, targets: &str) -> Scenario {
    let text = format!(
        "name = \"at_rest\"\nlayout = \"{layout}\"\n[initial]\njoint_angles = {angles}\n\
         [approach]\nduration = 20.0\nstep = {step}\ntrajectory = \"cycloidal\"\ntracking = \"exact\"\n\
         final_joint_angles = {angles}\n[contact]\ndetection = \"event\"\n{targets}\n\
         [post_impact]\nduration = 1.0\nstep = {step}\n"
    );
    Scenario::parse(&text, "at_rest.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
}

fn run_sampled(scenario: &Scenario, sample: f64) -> Study {
    let model = registry::generated(&scenario.layout).expect("generated code");
    study(scenario, &|| model.clone_box(), sample, &mut Silent).unwrap_or_else(|e| panic!("{e}"))
}

/// The captured spheres of the paper's case 3 are inside each other: centres 0.197 m apart at 64 s.
#[test]
fn the_captured_spheres_of_the_paper_overlap() {
    let scenario = scenario("raina_shah_2017");
    let result = run(&scenario);
    let case = &result.cases[2];
    let captured = case.capture.as_ref().expect("a capture");
    let start = result.approach.duration;
    let distance = |targets: &[Body]| {
        let [a, b] = [targets[0].pose, targets[1].pose];
        (a[1] - b[1]).hypot(a[2] - b[2]) - 1.0
    };
    let samples = captured.post_impact.samples.iter().zip(&captured.targets);
    let distances: Vec<(f64, f64)> = samples.map(|(now, targets)| (start + now.time, distance(targets))).collect();
    let (time, least) = distances.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).expect("samples");
    let bodies = ["targets/target1", "targets/target2"];
    let overlap = case.clearance.overlaps.iter().find(|overlap| overlap.bodies == bodies).expect("an overlap");
    // between the samples, 0.05 s apart, the distance of spheres with 0.1 m/s bends by less than 1e-5 m
    assert!(overlap.depth >= -least - tolerance::CLEARANCE && overlap.depth < -least + 1e-5, "{overlap:?}, {least}");
    let found = case.clearance.least.as_ref().expect("pairs");
    assert_eq!(found.bodies, bodies);
    assert!((found.time - time).abs() < 0.05 && (found.distance + overlap.depth).abs() < tolerance::CLEARANCE);
    let entered = distances.iter().find(|(_, distance)| *distance < 0.0).expect("an overlap").0;
    assert!((entered - 0.05..=entered).contains(&overlap.span[0]), "{entered}: {overlap:?}");
    assert!(!overlap.is_default && result.audit_failures().is_empty(), "overlaps are reported by default");
}

/// Two bars of 1 mm pass through each other at 0.6 m/s, 3.3 ms long: found with steps of 0.1 s and rows every 5 s.
#[test]
fn thin_bars_do_not_pass_silently() {
    let bar = |name: &str, arm: &str, x: f64, v: f64| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nkind = \"none\"\nmass = 1.0\ninertia = 0.1\n\
             polygon = [[-0.0005, -0.5], [0.0005, -0.5], [0.0005, 0.5], [-0.0005, 0.5]]\n\
             position = [{x}, 30.0]\ntwist = [0.0, {v}, 0.0]\n"
        )
    };
    let text = bar("first", "arm1", 0.0, 0.0) + &bar("second", "arm2", 6.0123, -0.6);
    let span = |step: f64| {
        let result = run_sampled(&at_rest("dual_arm_3r", TWO_ARMS, step, &text), 5.0);
        let overlap = result.cases[0].clearance.overlaps.first().expect("an overlap").clone();
        assert_eq!(overlap.bodies, ["targets/first", "targets/second"]);
        overlap.span
    };
    let (touch, part) = ((6.0123 - 0.001) / 0.6, (6.0123 + 0.001) / 0.6);
    for step in [0.1, 0.005] {
        let [from, to] = span(step);
        assert!((from - touch).abs() < 1e-8 && (to - part).abs() < 1e-8, "{step}: {from} {to}, not {touch} {part}");
    }
}

/// A rod of 1.6 m × 0.01 m that turns ten times a second drifts towards an end effector at rest: it is met at the same
/// time with a turn per step and with 1,000 steps per turn, the time at which a dense search finds the first contact.
#[test]
fn a_fast_rod_is_met_whatever_the_step() {
    let arm = scenario("redysim_single_arm_3r").layout.arms[0].name.clone();
    let layout = scenario("redysim_single_arm_3r").layout;
    let model = registry::generated(&layout).expect("generated code");
    let mut poses = [[0.0; 3]];
    model.end_effector_poses(&[0.0; 3], &[0.4, -0.9, 0.5], &mut poses).expect("poses");
    let [_, x, y] = poses[0];
    let (omega, speed, away) = (62.8, 0.1, 1.35);
    let rod = "[[-0.8, -0.005], [0.8, -0.005], [0.8, 0.005], [-0.8, 0.005]]";
    let target = format!(
        "[[target]]\nname = \"rod\"\narm = \"{arm}\"\nmass = 5.0\ninertia = 1.1\npolygon = {rod}\n\
         position = [{}, {y}]\ntwist = [{omega}, {}, 0.0]\n",
        x + away,
        -speed
    );
    let outline =
        Outline::polygon(vec![[-0.8, -0.005], [0.8, -0.005], [0.8, 0.005], [-0.8, 0.005]]).expect("a rectangle");
    let distance = |time: f64| {
        let (sin, cos) = (omega * time).sin_cos();
        let from = [speed * time - away, 0.0];
        outline.signed_distance([cos * from[0] + sin * from[1], cos * from[1] - sin * from[0]]).distance
    };
    // no contact before the end of the rod can reach: then every 2 µs
    let mut time = (away - 0.8 - 0.02) / speed;
    while distance(time) > 0.0 {
        time += 2e-6;
        assert!(time < 20.0);
    }
    for step in [0.1, 0.02, 0.0001] {
        let found = run_sampled(&at_rest("single_arm_3r", ONE_ARM, step, &target), 5.0);
        let met = found.cases[0].approach.as_ref().expect("an approach").event.expect("the rod is met").1;
        assert!(met <= time && met > time - 3e-6, "step {step}: {met}, not {time}");
    }
}

/// A bar that spins touches a wall for moments and is apart in between by less than it is long: the overlap begins at the
/// first touch, where `on_overlap = "stop"` ends the case, too.
#[test]
fn overlaps_begin_at_the_first_of_many_touches() {
    let (half_length, half_width, spin, speed, start) = (4e-3, 4e-4, 1256.0, 0.1, 0.05);
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x * half_length, y * half_width]);
    let target = |name: &str, arm: &str, outline: &[[f64; 2]], x: f64, twist: [f64; 3]| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nkind = \"none\"\nmass = 1.0\ninertia = 0.1\npolygon = {outline:?}\n\
             yaw = 0.0\nposition = [{x:?}, 30.0]\ntwist = {twist:?}\n"
        )
    };
    let wall = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
    let text = target("bar", "arm1", &corners, -0.5 - start, [spin, speed, 0.0])
        + &target("wall", "arm2", &wall, 0.0, [0.0; 3]);
    // how deep a corner is in the face of the wall
    let depth = |time: f64| {
        let (sine, cosine) = (spin * time).sin_cos();
        let farthest = corners.iter().map(|[x, y]| cosine * x - sine * y).fold(0.0, f64::max);
        farthest + speed * time - start
    };
    let times = || (0..10_000_000).map(|i| 0.45 + 1e-8 * f64::from(i));
    let first = times().find(|time| depth(*time) > 1e-6).expect("a touch");
    let touch =
        first - (0..1_000_000).map(|i| 1e-8 * f64::from(i)).find(|back| depth(first - back) <= 0.0).expect("a start");
    for rule in ["report", "stop"] {
        let text = format!("{text}[clearance]\non_overlap = \"{rule}\"");
        let result = run_sampled(&at_rest("dual_arm_3r", TWO_ARMS, 0.1, &text), 5.0);
        let case = &result.cases[0];
        let overlap = case.clearance.overlaps.first();
        let began = if rule == "stop" { case.stopped } else { overlap.map(|overlap| overlap.span[0]) };
        assert!(began.is_some_and(|began| (began - touch).abs() < 1e-6), "{rule}: {began:?}, not {touch}");
    }
}

/// `on_overlap = "stop"` ends the case at the first touch of given outlines; `ignore` takes a pair out.
#[test]
fn rules_of_overlaps() {
    let text = std::fs::read_to_string(file("scenarios/raina_shah_2017.toml")).expect("a scenario");
    let read = |rules: &str| {
        let text = format!("{text}\n[clearance]\n{rules}\n");
        Scenario::parse(&text, "rules.toml", &file("scenarios"), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"))
    };
    // in the approach; then, without the end effectors that reach their targets from within, after the impact
    let contacts = "ignore = [[\"arms/arm1/link3\", \"targets/target1\"], [\"targets/target2\", \"arms/arm2/link3\"]]";
    for ignored in ["", contacts] {
        let report = run(&read(ignored));
        let stopped = run(&read(&format!("on_overlap = \"stop\"\n{ignored}")));
        for (free, case) in report.cases.iter().zip(&stopped.cases) {
            let first = free.clearance.overlaps.first().expect("an overlap");
            assert_eq!(case.stopped, Some(first.span[0]));
            let after = case.capture.as_ref().map_or(0.0, |captured| captured.post_impact.duration);
            assert_eq!(after > 0.0, !ignored.is_empty());
            let end = case.approach(&stopped).duration + after;
            if ignored.is_empty() {
                // the targets have moved until then
                let left = free.approach(&report).duration - end;
                for (now, at_contact) in case.targets.iter().zip(&free.targets) {
                    let expected: [f64; 3] = std::array::from_fn(|k| at_contact.pose[k] - left * at_contact.twist[k]);
                    assert_close("pose", &now.pose, &expected, tolerance::REACHED);
                }
            }
            assert!((end - first.span[0]).abs() < 1e-9, "{}: {end}, not {first:?}", case.name);
            // nothing of what would have come
            assert!(case.clearance.overlaps.iter().all(|overlap| overlap.span[1] <= first.span[0]), "{}", case.name);
            let failures = stopped.audit_failures();
            assert!(failures.iter().any(|failure| failure.starts_with(&format!("{}: `", case.name))), "{failures:?}");
        }
    }
    let failing = run(&read("on_overlap = \"fail\""));
    let failures = failing.audit_failures();
    for case in &failing.cases {
        let (all, of_case) = (case.clearance.failures().count(), format!("{}: ", case.name));
        let (named, more) = (failures.iter().filter(|failure| failure.contains("` overlap ")), all - 10);
        assert_eq!(named.filter(|failure| failure.starts_with(&of_case)).count(), 10, "of {all}");
        assert!(failures.contains(&format!("{of_case}{more} more overlaps, all in the summary")), "{failures:?}");
    }
    let ignored = run(&read("ignore = [[\"targets/target2\", \"targets/target1\"]]"));
    let is_of_targets = |result: &Study| {
        let overlaps = &result.cases[2].clearance.overlaps;
        overlaps.iter().any(|overlap| overlap.bodies.iter().all(|body| body.starts_with("targets/")))
    };
    assert!(is_of_targets(&failing) && !is_of_targets(&ignored));
}

/// Where bodies are inside each other from the start `"stop"` ends the case there, with one row.
#[test]
fn overlaps_at_the_start_stop_the_case_there() {
    let square = |name: &str, arm: &str, x: f64, spin: f64| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nkind = \"none\"\nmass = 1.0\ninertia = 0.1\n\
             polygon = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]\nposition = [{x}, 0.0]\n\
             twist = [{spin}, 0.0, 0.0]\n"
        )
    };
    let both = square("first", "arm1", 30.0, 1.0) + &square("second", "arm2", 30.1, 0.0);
    for (rule, rows) in [("report", 5), ("stop", 1)] {
        let text = format!("{both}[clearance]\non_overlap = \"{rule}\"");
        let study = run_sampled(&at_rest("dual_arm_3r", TWO_ARMS, 0.1, &text), 5.0);
        let case = &study.cases[0];
        let approach = case.approach.as_ref().expect("its own");
        let stopped = (rule == "stop").then_some(0.0);
        assert_eq!((case.stopped, approach.samples.len()), (stopped, rows), "{rule}");
        assert_eq!((approach.duration.to_bits() == 0, case.clearance.overlaps.len()), (rule == "stop", 1), "{rule}");
        // how deep they are is known, too
        let least = case.clearance.least.as_ref().expect("a distance");
        assert!(least.distance < -0.05 && least.bodies.iter().all(|body| body.starts_with("targets/")), "{least:?}");
    }
}

/// An overlap that begins with an impact, before it or after it by rounding, stops the case there; without the rule the
/// motion goes on.
#[test]
fn an_overlap_at_an_impact_stops_the_case_there() {
    let target = |name: &str, (arm, kind): (&str, &str), [x, y]: [f64; 2], speed: f64| {
        format!(
            "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nkind = \"{kind}\"\nmass = 1.0\ninertia = 0.1\n\
             polygon = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]\nposition = [{x}, {y}]\n\
             twist = [0.0, 0.0, {speed}]\n"
        )
    };
    // the ball comes to the end effector from above, and the other to the ball, faster
    let run_with = |[x, y]: [f64; 2], gap: f64, rule: &str| {
        let ball = target("ball", ("arm1", "rigid"), [x, y + 2.1], -0.2);
        let other = target("other", ("arm2", "none"), [x, y + 2.3 + gap], -0.3);
        let text = format!("{ball}{other}[clearance]\non_overlap = \"{rule}\"");
        run_sampled(&at_rest("dual_arm_3r", TWO_ARMS, 0.1, &text), 5.0)
    };
    let passing = run_with([30.0, 0.0], 9.0, "report");
    let [_, x, y] = passing.cases[0].approach(&passing).end().end_effector_poses[0];
    let far = run_with([x, y], 9.0, "report");
    let impact = far.cases[0].approach(&far).duration;
    assert!(far.cases[0].capture.is_some() && (impact - 10.0).abs() < 1e-5, "at {impact} s");
    for shift in [-1e-9, -1e-13, 0.0, 1e-13, 1e-9] {
        let gap = 0.1 * (impact + shift);
        let free = run_with([x, y], gap, "report");
        assert!(free.cases[0].stopped.is_none() && free.cases[0].capture.is_some(), "{shift}");
        let stopped = run_with([x, y], gap, "stop");
        let case = &stopped.cases[0];
        let end = case.stopped.expect("an overlap");
        assert!((end - impact).abs() < 1e-7, "{shift}: {end}, not {impact}");
        let after = case.capture.as_ref().map_or(0.0, |captured| captured.post_impact.duration);
        assert!((case.approach(&stopped).duration + after - end).abs() < 1e-12, "{shift}");
        let [overlap] = &case.clearance.overlaps[..] else { panic!("{shift}: {:?}", case.clearance.overlaps) };
        assert_eq!(overlap.bodies, ["targets/ball", "targets/other"], "{shift}");
    }
}

/// A wheel of a hundred teeth that turns beside a robot with one like it: their circles show that they are apart.
#[test]
fn turning_wheels_apart_cost_little() {
    let wheel: Vec<[f64; 2]> = (0..200)
        .map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / 200.0).sin_cos();
            let radius = if k % 2 == 0 { 0.8 } else { 1.0 };
            [radius * cos, radius * sin]
        })
        .collect();
    let target = format!(
        "[[target]]\nname = \"wheel\"\narm = \"arm1\"\nkind = \"none\"\nmass = 10.0\ninertia = 1.0\npolygon = {wheel:?}\n\
         position = [-3.0, -3.0]\ntwist = [1.0, 0.0, 0.0]\n"
    );
    let mut scenario = at_rest("single_arm_3r", ONE_ARM, 0.01, &target);
    scenario.layout.base.outline = Some(Outline::polygon(wheel).expect("a wheel"));
    scenario.approach.duration = 200.0;
    scenario.cases[0].kinds[0][0] = None;
    let result = run_sampled(&scenario, 5.0);
    let clearance = &result.cases[0].clearance;
    let least = clearance.least.as_ref().expect("a pair");
    assert!(least.distance > 0.0 && clearance.evaluations < 100_000, "{least:?}, {}", clearance.evaluations);
}

/// Distances are bounded in proportion to the time; where they are used up, the error says by which bodies.
#[test]
fn the_most_distances_are_for_a_time() {
    let rod = |x: f64| {
        format!(
            "[[target]]\nname = \"rod\"\narm = \"arm1\"\nkind = \"none\"\nmass = 5.0\ninertia = 1.1\n\
             polygon = [[-1.5, -0.005], [1.5, -0.005], [1.5, 0.005], [-1.5, 0.005]]\nposition = [{x}, 0.0]\n\
             twist = [3.0, 0.0, 0.0]\n"
        )
    };
    let of = |duration: f64, max_distances: u64| {
        let mut scenario = at_rest("single_arm_3r", ONE_ARM, 0.01, &rod(3.5));
        (scenario.approach.duration, scenario.clearance.max_distances) = (duration, max_distances);
        scenario
    };
    let model = registry::generated(&of(1.0, 1).layout).expect("generated code");
    let run = |scenario: &Scenario| study(scenario, &|| model.clone_box(), 5.0, &mut Silent);
    let short = run(&of(100.0, u64::MAX)).expect("a study").cases[0].clearance.evaluations;
    let (fits, too_few) = (of(400.0, short + short / 4), of(400.0, short / 2));
    assert!(run(&fits).expect("as many in proportion").cases[0].clearance.evaluations > 2 * short);
    let error = run(&too_few).expect_err("half as many");
    let message = error.to_string();
    assert!(message.contains("`targets/rod`") && message.contains("was not computed to the end"), "{message}");
    assert_eq!(error.key(&too_few).path, "target[0].twist");
}

/// Where the path is wrong, its step is the reason for too many distances.
#[test]
fn a_rough_path_is_shown_at_its_step() {
    let key = |step: f64| {
        let mut scenario = scenario("raina_shah_2017");
        scenario.clearance.max_distances = 10;
        scenario.approach.step = step;
        let model = registry::generated(&scenario.layout).expect("generated code");
        let error = study(&scenario, &|| model.clone_box(), 1.0, &mut Silent).expect_err("ten distances");
        // a valid simulation, which is not shown to pass
        assert!(error.is_breakdown(), "{error}");
        (error.key(&scenario).path, error.to_string())
    };
    let (path, text) = key(0.14);
    assert!(path == "approach.step" && text.contains("the path is wrong by"), "{path} {text}");
    let (path, text) = key(0.005);
    assert!(path != "approach.step" && text.contains("the clearance was not computed"), "{path} {text}");
}
