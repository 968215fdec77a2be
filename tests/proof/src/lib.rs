//! Fixtures of the tests: random states, an independent reference for contacts, and comparison of
//! numbers. [`tolerance`] has every bound of a comparison, with its reason.
//!
//! It never contains the product, which its own tests and those of the root package depend on.
#![cfg(feature = "fixtures")]
#![allow(
    clippy::must_use_candidate,
    clippy::missing_panics_doc,
    reason = "tests call it: a panic is a test that fails"
)]

pub mod approach;
pub mod linear_time;
pub mod maximal;
pub mod sample;
pub mod tolerance;

use planar_layout::layout::Layout;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

/// Hands every shipped layout to a macro that makes tests of it; the tests say when one is missing.
#[macro_export]
macro_rules! for_every_layout {
    ($tests:ident) => {
        $tests!(asymmetric_wheel boom_7r dual_arm_2r dual_arm_3r single_arm_2r single_arm_3r triple_arm_3r);
    };
}

/// A file of the repository.
pub fn file(name: &str) -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2);
    root.expect("a crate of the workspace is two folders down").join(name)
}

/// A shipped layout.
pub fn layout(name: &str) -> Layout {
    Layout::read(&file(&format!("codegen/layouts/{name}.toml"))).unwrap_or_else(|report| panic!("{report}"))
}

/// A committed JSON file.
pub fn json(name: &str) -> Value {
    let text = std::fs::read_to_string(file(name)).expect("a committed file");
    serde_json::from_str(&text).expect("JSON")
}

/// Result of a command: exit code, standard output, standard error.
pub fn said(output: Output) -> (i32, String, String) {
    let text = |bytes| String::from_utf8(bytes).expect("UTF-8");
    (output.status.code().expect("an exit code"), text(output.stdout), text(output.stderr))
}

/// Largest difference of two lists of equal length.
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
pub fn assert_close(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    let difference = difference(found, expected);
    assert!(difference <= tolerance, "{what}: differs by {difference:e}, bound {tolerance:e}\n{found:?}\n{expected:?}");
}

/// [`assert_close`] with a bound relative to the largest expected entry.
#[track_caller]
pub fn close(what: &str, found: &[f64], expected: &[f64], tolerance: f64) {
    let size = expected.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    assert_close(what, found, expected, tolerance * size);
}
