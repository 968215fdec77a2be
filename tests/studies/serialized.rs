//! The feature `serde`: scenarios and results as data of other formats, and numbers of the core from them.

use crate::{run, scenario};
use planar_capture::owned::RobotState;
use planar_capture::state::ActuatorWork;
use planar_capture::target::Target;
use serde_json::{Value, json, to_value};

fn value(data: &impl serde::Serialize) -> Value {
    to_value(data).expect("data without maps whose keys are no texts")
}

/// A scenario has the numbers of its file, and those of the layout that it names.
#[test]
fn a_scenario_is_written_with_its_layout() {
    let written = value(&scenario("large_target"));
    assert_eq!(written["layout"]["base"]["mass"], json!(500.0));
    assert_eq!(written["layout"]["arms"][1]["links"].as_array().map(Vec::len), Some(3));
    assert_eq!(written["clearance"]["on_overlap"], json!("Fail"));
    assert_eq!(written["targets"][0]["outline"]["Polygon"]["corners"].as_array().map(Vec::len), Some(4));
}

/// A study has the numbers of its results, but no path: that is in no result.
#[test]
fn a_study_is_written_with_its_impulses() {
    let study = run(&scenario("large_target"));
    let written = value(&study);
    let capture = study.cases[0].capture.as_ref().expect("it captures");
    let found = &written["cases"][0]["capture"];
    let impulses = &found["impact"]["exact"]["impulses"];
    assert_eq!(
        serde_json::from_value::<Vec<Option<[f64; 3]>>>(impulses.clone()).ok(),
        Some(capture.impact.exact.impulses.clone())
    );
    assert_eq!(found["post_impact"]["samples"].as_array().map(Vec::len), Some(capture.post_impact.samples.len()));
    assert_eq!(found["post_impact"].get("path"), None);
    assert_eq!(written["cases"][0]["clearance"]["overlaps"], json!([]));
}

/// Numbers of the core are read again bit by bit.
#[test]
fn numbers_are_read_again() {
    let state = RobotState {
        base_pose: [0.1, 1.0 / 3.0, -2e-300],
        joint_angles: vec![std::f64::consts::PI, -0.0],
        base_twist: [1e300, 0.2, 0.3],
        joint_rates: vec![0.4, 0.5],
    };
    assert_eq!(serde_json::from_value::<RobotState>(value(&state)).ok(), Some(state));
    let target = Target { mass: 10.0, inertia: 1.0, contact: [0.0, 0.1 + 0.2], twist: [0.2, 0.0, 0.0] };
    assert_eq!(serde_json::from_value::<Target<f64>>(value(&target)).ok(), Some(target));
    let work = ActuatorWork::<f64>::default();
    assert_eq!(serde_json::from_value::<ActuatorWork<f64>>(value(&work)).ok(), Some(work));
}
