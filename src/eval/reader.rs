//! Reads one state from its JSON text.

use super::magnitude::{wrong_angle, wrong_mass};
use super::places::Places;
use crate::diagnostic::{NumberRule, excerpt, listing, nearest};
use crate::evaluation::EvaluationInput;
use crate::layout::Layout;
use crate::owned::RobotState;
use crate::target::Target;
use serde_json::{Map, Value};

const STATE: [&str; 8] = [
    "base_pose",
    "joint_angles",
    "base_twist",
    "joint_rates",
    "joint_torques",
    "base_wrench",
    "end_effector_wrenches",
    "targets",
];
const TARGET: [&str; 4] = ["mass", "inertia", "contact", "twist"];

const POSE: &str = "[yaw, x, y] in rad, m, m";
const TWIST: &str = "[ω, vx, vy] in rad/s, m/s, m/s";
const WRENCH: &str = "[n, fx, fy] in N m, N, N";
const CONTACT: &str = "[rx, ry] in m";
const MASS: NumberRule = NumberRule::positive("a mass", "kg");
const INERTIA: NumberRule = NumberRule::positive("a moment of inertia", "kg m²");

/// An invalid value: its path and the message.
struct InvalidValue {
    path: String,
    message: String,
}

type Read<T> = Result<T, InvalidValue>;

/// Reads a state of a robot.
///
/// # Errors
/// The number of lines before the invalid value, and a message with key, value and what is expected.
pub fn read(text: &[u8], layout: &Layout) -> Result<EvaluationInput, (usize, String)> {
    let tree: Value = serde_json::from_slice(text).map_err(|error| not_json(text, &error))?;
    let places = Places::of(text);
    // the parsed tree has only the last value of a key
    if let Some((path, offset)) = places.repeated() {
        return Err((lines_before(text, offset), format!("`{}` is given twice, expected once", excerpt(&path))));
    }
    instant(&tree, layout).map_err(|error| {
        let offset = places.offset(&error.path).unwrap_or(0);
        (lines_before(text, offset), error.message)
    })
}

fn instant(tree: &Value, layout: &Layout) -> Read<EvaluationInput> {
    let (joints, arms) = (layout.joints(), layout.arms.len());
    let state = object(tree, "", "the state", &STATE)?;
    let required = |key: &str, wanted: &str| required(state, "", key, wanted);
    let optional = |key: &str| state.get(key).filter(|value| !value.is_null());
    let of_joints = |unit: &str| format!("{joints} numbers in {unit}, one per joint");
    let triple = |key: &str, form: &str| vector(required(key, form)?, key, form);
    let list = |key: &str, unit: &str| numbers(required(key, &of_joints(unit))?, key, joints, &of_joints(unit));
    let torques = optional("joint_torques").map(|value| numbers(value, "joint_torques", joints, &of_joints("N m")));
    let base_wrench = optional("base_wrench").map(|value| vector(value, "base_wrench", WRENCH));
    let wrenches = optional("end_effector_wrenches").map(|value| {
        let wanted = format!("{arms} wrenches {WRENCH}, one per arm");
        items(value, "end_effector_wrenches", arms, &wanted)?
            .map(|(path, value)| vector(value, &path, WRENCH))
            .collect::<Read<Vec<_>>>()
    });
    let targets = optional("targets").map(|value| {
        let wanted = format!("{arms} targets, one per arm, `null` for an arm that captures nothing");
        items(value, "targets", arms, &wanted)?
            .map(|(path, value)| if value.is_null() { Ok(None) } else { target(value, &path, layout).map(Some) })
            .collect::<Read<Vec<_>>>()
    });
    Ok(EvaluationInput {
        state: RobotState {
            base_pose: angles(triple("base_pose", POSE)?, 1, state, "base_pose")?,
            joint_angles: angles(list("joint_angles", "rad")?, joints, state, "joint_angles")?,
            base_twist: triple("base_twist", TWIST)?,
            joint_rates: list("joint_rates", "rad/s")?,
        },
        joint_torques: torques.transpose()?.unwrap_or_else(|| vec![0.0; joints]),
        base_wrench: base_wrench.transpose()?,
        end_effector_wrenches: wrenches.transpose()?,
        targets: targets.transpose()?.unwrap_or_else(|| vec![None; arms]),
    })
}

/// The numbers, the first of which are angles.
fn angles<T: AsRef<[f64]>>(numbers: T, count: usize, state: &Map<String, Value>, key: &str) -> Read<T> {
    let mut angles = numbers.as_ref().iter().take(count).enumerate();
    match angles.find_map(|(index, angle)| Some((index, wrong_angle(*angle)?))) {
        Some((index, wanted)) => Err(expected(&format!("{key}[{index}]"), &state[key][index], &wanted)),
        None => Ok(numbers),
    }
}

fn target(value: &Value, path: &str, layout: &Layout) -> Read<Target<f64>> {
    let table = object(value, path, "a target", &TARGET)?;
    let amount = |key: &str, quantity: &NumberRule| {
        let wanted = quantity.to_string();
        let (value, path) = (required(table, path, key, &wanted)?, join(path, key));
        let number = number(value, &path, &wanted)?;
        let wanted = if number > 0.0 { wrong_mass(layout, key, number) } else { Some(wanted) };
        wanted.map_or(Ok(number), |wanted| Err(expected(&path, value, &wanted)))
    };
    Ok(Target {
        mass: amount("mass", &MASS)?,
        inertia: amount("inertia", &INERTIA)?,
        contact: vector(required(table, path, "contact", CONTACT)?, &join(path, "contact"), CONTACT)?,
        twist: vector(required(table, path, "twist", TWIST)?, &join(path, "twist"), TWIST)?,
    })
}

/// The path of a key of the object at `path`; the state has the empty path.
fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// The value of a key that an object must have.
fn required<'a>(object: &'a Map<String, Value>, path: &str, key: &str, wanted: &str) -> Read<&'a Value> {
    let missing = || format!("missing key `{}`, expected {wanted}", join(path, key));
    object.get(key).ok_or_else(|| InvalidValue { path: path.to_owned(), message: missing() })
}

/// An object without other keys.
fn object<'a>(value: &'a Value, path: &str, what: &str, keys: &[&str]) -> Read<&'a Map<String, Value>> {
    let Value::Object(map) = value else {
        let wanted = format!("an object with {}", listing(keys, "and"));
        return Err(if path.is_empty() {
            InvalidValue { path: String::new(), message: format!("{what} is {}, expected {wanted}", excerpt_of(value)) }
        } else {
            expected(path, value, &wanted)
        });
    };
    let Some((key, value)) = map.iter().find(|(key, _)| !keys.contains(&key.as_str())) else { return Ok(map) };
    let missing = keys.iter().copied().filter(|known| !map.contains_key(*known));
    let hint = match nearest(key, missing).or_else(|| nearest(key, keys.iter().copied())) {
        Some(known) => format!("did you mean `{known}`?"),
        None => format!("keys of {what}: {}", listing(keys, "and")),
    };
    let path = join(path, key);
    Err(InvalidValue { message: format!("unknown key `{}` ({}); {hint}", excerpt(&path), excerpt_of(value)), path })
}

/// The elements of an array of the expected length, with their paths.
fn items<'a>(
    value: &'a Value,
    path: &str,
    count: usize,
    wanted: &str,
) -> Read<impl Iterator<Item = (String, &'a Value)>> {
    let error = || expected(path, value, wanted);
    let list = value.as_array().ok_or_else(error)?;
    if list.len() != count {
        return Err(expected(path, value, &format!("{wanted} (it has {})", list.len())));
    }
    let path = path.to_owned();
    Ok(list.iter().enumerate().map(move |(index, value)| (format!("{path}[{index}]"), value)))
}

fn numbers(value: &Value, path: &str, count: usize, wanted: &str) -> Read<Vec<f64>> {
    items(value, path, count, wanted)?.map(|(path, value)| number(value, &path, "a number")).collect()
}

fn vector<const N: usize>(value: &Value, path: &str, form: &str) -> Read<[f64; N]> {
    let mut vector = [0.0; N];
    vector.copy_from_slice(&numbers(value, path, N, form)?);
    Ok(vector)
}

fn number(value: &Value, path: &str, wanted: &str) -> Read<f64> {
    value.as_f64().filter(|number| number.is_finite()).ok_or_else(|| expected(path, value, wanted))
}

fn expected(path: &str, value: &Value, wanted: &str) -> InvalidValue {
    InvalidValue { path: path.to_owned(), message: format!("`{path}` is {}, expected {wanted}", excerpt_of(value)) }
}

fn excerpt_of(value: &Value) -> String {
    excerpt(&value.to_string())
}

fn lines_before(text: &[u8], offset: usize) -> usize {
    text.iter().take(offset).filter(|byte| **byte == b'\n').count()
}

/// The error of a text that is not JSON, or has a number too large for 64 bits.
fn not_json(text: &[u8], error: &serde_json::Error) -> (usize, String) {
    let lines = error.line().saturating_sub(1);
    let start = text.split_inclusive(|byte| *byte == b'\n').take(lines).map(<[u8]>::len).sum::<usize>();
    let offset = start + error.column();
    let before = Places::of(text).last_before(offset);
    let what = error.to_string();
    // without the line, which the parser counts from the start of the state
    let what = what.split(" at line ").next().unwrap_or_default();
    let message = match before {
        Some((path, place)) if !path.is_empty() => {
            let rest = text.get(place..).unwrap_or_default();
            let length = rest.iter().position(|b| b",]} \t\r\n".contains(b)).unwrap_or(rest.len());
            let value = String::from_utf8_lossy(rest.get(..length).unwrap_or_default()).into_owned();
            if what == "number out of range" {
                format!("`{}` is {}, expected a finite number that fits in 64 bits", excerpt(&path), excerpt(&value))
            } else {
                format!("not JSON: {what}, near `{}` ({})", excerpt(&path), excerpt(&value))
            }
        }
        _ => format!("not JSON: {what}"),
    };
    (lines, message)
}
