//! Moving pictures: their values are the motion, every animation has as many values as instants, and the tracked one is fresh.

use crate::said;
use planar_proof::file;
use serde_json::Value;
use std::fs;
use tempfile::TempDir;

/// The scenario of the picture in README.md and the arguments that it is made with.
const SHOWN: [&str; 6] = ["animate", "scenarios/stabilised_capture.toml", "--until", "60", "-q", "--out"];

/// The arguments, with the scenario's place in the repository.
fn placed<'a>(arguments: &[&'a str], scenario: &'a str) -> Vec<&'a str> {
    arguments.iter().map(|argument| if *argument == SHOWN[1] { scenario } else { argument }).collect()
}

/// The texts between every `name="` and the next quote.
fn attributes<'a>(svg: &'a str, name: &str) -> Vec<&'a str> {
    let open = format!(" {name}=\"");
    svg.split(open.as_str()).skip(1).filter_map(|rest| rest.split('"').next()).collect()
}

fn numbers(list: &str) -> Vec<f64> {
    list.split([';', ' ']).map(|number| number.parse().expect("a number")).collect()
}

#[test]
fn the_picture_of_the_readme_is_what_is_computed() {
    let (folder, scenario) = (TempDir::new().expect("a folder"), file(SHOWN[1]));
    let out = folder.path().join("capture.svg");
    let arguments =
        [&placed(&SHOWN, scenario.to_str().expect("a path"))[..], &[out.to_str().expect("a path")]].concat();
    assert_eq!(said(&arguments), (0, String::new(), String::new()));
    let svg = fs::read_to_string(&out).expect("a picture");
    let tracked = fs::read_to_string(file("docs/capture.svg")).unwrap_or_default();
    assert!(tracked == svg, "docs/capture.svg is stale; to mend: planar-capture {} docs/capture.svg", SHOWN.join(" "));
    assert!(svg.len() < 100_000, "{} bytes", svg.len());
    // a second one would replace the first
    let (code, _, message) = said(&arguments);
    assert!(code == 2 && message.contains("already exists"), "{message}");
}

/// An arrow at the edge points to a target while that is out of the picture, and at no other time.
#[test]
fn targets_that_leave_the_picture_are_pointed_to() {
    let of = |scenario: &str, more: &[&str]| {
        let scenario = file(&format!("scenarios/{scenario}.toml")).display().to_string();
        let (code, svg, message) = said(&[&["animate", &scenario, "-q", "--seconds", "4"], more].concat());
        assert_eq!((code, message.as_str()), (0, ""));
        svg
    };
    let arrows = |svg: &str| svg.matches("d=\"M0 0l-14 -6v12Z\"").count();
    let late = of("elastic_rebound", &["--case", "too_late"]);
    assert!(arrows(&late) > 0, "the box is far below at the end");
    let line = late.lines().rfind(|line| line.contains("l-14 -6v12Z")).expect("an arrow");
    let (times, values) = (attributes(line, "keyTimes"), attributes(line, "values"));
    assert_eq!(values[0], "0;1;1", "until the end");
    let parts = numbers(times[0]);
    assert!(parts[1] > 0.0 && parts[1] < 0.8, "from some time on: {parts:?}");
    assert_eq!(arrows(&of("stabilised_capture", &[])), 0, "all that is held stays in the picture");
}

/// The ends of a line `x yLx y"`; `None` of another path.
fn line(path: &str) -> Option<Vec<f64>> {
    let (path, _) = path.split_once('"')?;
    let (from, to) = path.split_once('L')?;
    Some([from, to].iter().flat_map(|end| end.split(' ')).map(|number| number.parse().expect("a number")).collect())
}

#[test]
fn every_animation_has_a_value_per_instant() {
    for name in ["stabilised_capture", "spinning_target", "elastic_rebound", "redysim_single_arm_3r"] {
        let scenario = file(&format!("scenarios/{name}.toml"));
        let (code, svg, message) = said(&["animate", scenario.to_str().expect("a path"), "-q", "--seconds", "4"]);
        assert_eq!((code, message.as_str()), (0, ""), "{name}");
        assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count(), "{name}");
        let (times, values) = (attributes(&svg, "keyTimes"), attributes(&svg, "values"));
        assert!(times.len() == values.len() && times.len() >= 6, "{name}: {} animations", times.len());
        for (times, values) in times.into_iter().zip(values) {
            assert_eq!(times.split(';').count(), values.split(';').count(), "{name}");
            let times = numbers(times);
            assert!(times.is_sorted() && times[0] == 0.0 && times[times.len() - 1] <= 1.0, "{name}: {times:?}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{name}");
    }
}

#[test]
fn values_are_those_of_the_motion() {
    let scenario = file("scenarios/raina_shah_2017.toml");
    let scenario = scenario.to_str().expect("a path");
    let folder = TempDir::new().expect("a folder");
    let out = folder.path().join("results");
    let run = ["run", scenario, "-q", "--format", "json", "--out", out.to_str().expect("a path")];
    let summary: Value = serde_json::from_str(&said(&run).1).expect("a summary");
    let at = &summary["cases"][2];
    let (code, svg, _) = said(&["animate", scenario, "-q", "--case", "case3"]);
    assert_eq!(code, 0);
    assert!(svg.contains("case case3"));
    let (values, end) = (attributes(&svg, "values"), &at["post_impact"]);
    let ends: Vec<Vec<f64>> = values.iter().map(|list| numbers(list.rsplit(';').next().expect("a value"))).collect();
    let is_shown = |wanted: &[f64], precision: f64| {
        ends.iter().any(|found| {
            found.len() == wanted.len() && found.iter().zip(wanted).all(|(a, b)| (a - b).abs() < precision)
        })
    };
    let of =
        |key: &str| -> Vec<f64> { end[key].as_array().expect("a list").iter().filter_map(Value::as_f64).collect() };
    let pose = of("base_pose");
    assert!(is_shown(&pose[1..], 1e-4) && is_shown(&[pose[0].to_degrees()], 1e-2), "the base at {pose:?} in {ends:?}");
    for angle in of("joint_angles") {
        assert!(is_shown(&[angle.to_degrees()], 1e-2), "a joint at {angle} rad in {ends:?}");
    }
    let impulses = at["impact"]["exact"]["impulse_magnitudes"].as_array().expect("a list");
    for impulse in impulses.iter().filter_map(Value::as_f64) {
        assert!(svg.contains(&format!(">{impulse:.3} N s<")), "{impulse}");
    }
    // arrows from the end effectors, along the impulses, upwards where y is
    let arrows: Vec<Vec<f64>> = svg.split("class=\"impulse\" d=\"M").skip(1).filter_map(line).collect();
    let vectors = at["impact"]["exact"]["impulses"].as_array().expect("a list");
    assert!(arrows.len() == 2 && vectors.len() == 2, "{arrows:?}");
    for (arrow, vector) in arrows.iter().zip(vectors) {
        let [fx, fy] = [1, 2].map(|i: usize| vector[i].as_f64().expect("a number"));
        let [x, y] = [arrow[2] - arrow[0], arrow[3] - arrow[1]];
        let (cosine, size) = ((x * fx - y * fy) / (x.hypot(y) * fx.hypot(fy)), x.hypot(y));
        // a tenth of a pixel is written
        assert!(cosine > 0.999 && size > 8.0, "{arrow:?} for {vector}");
        assert!(fy.abs() > 0.2 * fx.hypot(fy), "up or down shows: {vector}");
    }
    // the approach alone ends before the base is there
    let (_, until, _) = said(&["animate", scenario, "-q", "--case", "case3", "--until", "19.9"]);
    assert!(until.contains(">15 s<") && !until.contains(">20 s<") && !until.contains("N s<"));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let scenario = file("scenarios/raina_shah_2017.toml");
    let scenario = scenario.to_str().expect("a path");
    for (arguments, wanted) in [
        (["--case", "case4"], "no case `case4`, expected one of `case1`, `case2`, `case3`"),
        (["--seconds", "0.5"], "expected 1 to 120 s"),
        (["--until", "-1"], "expected a time greater than 0 s"),
    ] {
        let (code, out, message) = said(&["animate", scenario, &arguments.join("=")]);
        assert!(code == 2 && out.is_empty() && message.contains(wanted), "{message}");
    }
}

/// An end beyond that of the motion is said, and what is written is the whole motion.
#[test]
fn an_end_beyond_the_motion_is_said() {
    let scenario = file("scenarios/redysim_single_arm_3r.toml").display().to_string();
    let animate = |until: &[&str]| said(&[&["animate", &scenario, "-q", "--seconds", "1"], until].concat());
    let (code, whole, err) = animate(&[]);
    assert_eq!((code, err.as_str()), (0, ""));
    let (code, until, err) = animate(&["--until", "1e4"]);
    assert_eq!((code, until), (0, whole));
    assert!(err.contains("--until 10000.0 s is beyond the end of the motion, ") && err.lines().count() == 1, "{err}");
}
