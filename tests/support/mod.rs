//! What several tests share. Every bound of a comparison stands in [`tolerance`], with its reason.
#![allow(dead_code, reason = "each test binary uses its own part")]

pub mod tolerance;

use planar_capture::models;
use planar_capture::scenario::Scenario;
use planar_capture::study::{Observer, Study, study};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A file of the repository.
pub fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// A shipped scenario.
pub fn scenario(name: &str) -> Scenario {
    let path = file(&format!("scenarios/{name}.toml"));
    Scenario::read(&path, models::SHIPPED).unwrap_or_else(|report| panic!("{report}"))
}

/// Runs a scenario with generated code.
pub fn run(scenario: &Scenario) -> Study {
    let model = models::generated(&scenario.layout).expect("a shipped layout has generated code");
    study(scenario, &|| model.clone_box(), 0.05, &mut Silent).unwrap_or_else(|e| panic!("{}: {e}", scenario.name))
}

/// Nobody watches.
pub struct Silent;

impl Observer for Silent {
    fn begin(&mut self, _: &str, _: u64) {}
    fn step(&mut self) {}
}

/// A committed JSON file.
pub fn json(name: &str) -> Value {
    let text = std::fs::read_to_string(file(name)).expect("a committed file");
    serde_json::from_str(&text).expect("JSON")
}

/// Largest difference of two lists, after checking that they are as long.
pub fn difference(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).fold(0.0, |most, (a, b)| if (a - b).abs() <= most { most } else { (a - b).abs() })
}

/// All numbers of a JSON value, depth first; a `null` in a list is skipped.
pub fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Number(n) => vec![n.as_f64().expect("a float")],
        Value::Array(items) => items.iter().flat_map(numbers).collect(),
        _ => vec![],
    }
}

/// Fails with the name, the difference and the bound.
#[track_caller]
pub fn assert_close(what: &str, found: &[f64], wanted: &[f64], tolerance: f64) {
    let difference = difference(found, wanted);
    assert!(difference <= tolerance, "{what}: differs by {difference:e}, bound {tolerance:e}\n{found:?}\n{wanted:?}");
}
