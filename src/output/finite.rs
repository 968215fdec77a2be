//! Numbers of a result that are not finite. JSON has none of them: serde writes `null`, which elsewhere says that there
//! is no such thing.
//!
//! # Example
//! ```
//! use planar_capture::output::finite::finite;
//! use serde_json::json;
//!
//! // no number is NaN in JSON
//! let overflow = json!({"cases": [{"name": "case1", "kinetic_energy": f64::NAN}]});
//! assert_eq!(finite(overflow).expect_err("not a number").path, "cases[0].kinetic_energy");
//! // there is no solution by the paper's equations: that is no overflow
//! assert!(finite(json!({"paper": null, "momentum": [0.0, 1.5, 0.0]})).is_ok());
//! ```

use serde_json::Value;

/// Keys whose value may be `null`.
const ABSENT: &[&str] = &[
    "paper",
    "direction",
    "effective_masses",
    "impulse_index",
    "joint_angle",
    "joint_rate",
    "clearance",
    "besides_contacts",
    "first_overlap",
];
/// Keys of lists whose entries, one per arm, may be `null`.
const ABSENT_ARM: &[&str] = &["impulses", "impulse_magnitudes", "missed", "target_twists_after"];

/// A number that is NaN or infinite.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{path}` of the results is not a finite number: the motion, or a quantity of it, is beyond the range of numbers; nothing \
     was written"
)]
pub struct NotFinite {
    /// Where it would stand: `cases[0].impact.exact.momentum_jump[0]`.
    pub path: String,
}

/// The value, if all its numbers are finite.
///
/// # Errors
/// The first that is not.
pub fn finite(value: Value) -> Result<Value, NotFinite> {
    match first_null(&value) {
        Some(path) => Err(NotFinite { path: path.trim_start_matches('.').to_owned() }),
        None => Ok(value),
    }
}

/// Path of the first `null` that stands for a number.
fn first_null(value: &Value) -> Option<String> {
    let in_list = |(i, item): (usize, &Value)| first_null(item).map(|path| format!("[{i}]{path}"));
    match value {
        Value::Null => Some(String::new()),
        Value::Array(items) => items.iter().enumerate().find_map(in_list),
        Value::Object(entries) => entries.iter().find_map(|(key, item)| {
            let path = match item {
                Value::Null if ABSENT.contains(&key.as_str()) => None,
                Value::Array(arms) if ABSENT_ARM.contains(&key.as_str()) => {
                    arms.iter().enumerate().filter(|(_, arm)| !arm.is_null()).find_map(in_list)
                }
                item => first_null(item),
            };
            path.map(|path| format!(".{key}{path}"))
        }),
        Value::Bool(_) | Value::Number(_) | Value::String(_) => None,
    }
}
