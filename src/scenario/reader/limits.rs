//! The `[limits]` table: how far and how fast joints may turn.

use super::MOST_ANGLE;
use super::joints::{Joints, check_length};
use crate::diagnostic::{NumberRule, Table, Value, every};
use crate::owned::RobotState;
use crate::simulate::limits::JointLimits;

pub(super) const KEYS: [&str; 2] = ["joint_angles", "joint_rates"];

const RATE: NumberRule = NumberRule::positive("a largest joint rate (or one per joint)", "rad/s");
const PAIR: [NumberRule; 2] =
    [NumberRule::any("low", "rad").not_degrees(MOST_ANGLE), NumberRule::any("high", "rad").not_degrees(MOST_ANGLE)];

/// One per joint.
pub(super) fn from_table(table: &Table<'_>, joints: &Joints<'_>) -> Option<Vec<JointLimits>> {
    let angles = match table.get("joint_angles") {
        Some(value) => angles(&value, joints),
        None => Some(joints.repeat(0.0).iter().map(|_| None).collect()),
    };
    let rates = match table.get("joint_rates") {
        Some(value) => joints.one_or_each(&value, &RATE).map(|rates| rates.into_iter().map(Some).collect()),
        None => Some(joints.repeat(0.0).iter().map(|_| None).collect::<Vec<_>>()),
    };
    let layout = joints.layout?;
    let limits = angles?.into_iter().zip(rates?).enumerate();
    Some(limits.map(|(i, (angles, rate))| JointLimits { name: layout.joint_name(i), angles, rate }).collect())
}

/// One pair for all joints, or one or `[]` for each.
fn angles(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<Option<[f64; 2]>>> {
    let wanted =
        format!("[low, high] in rad, or a list of {} (each [low, high], or [] for any angle)", joints.one_each());
    let items = value.items(&wanted)?;
    if !items.iter().any(Value::is_array) {
        let both = pair(value)?;
        return Some(joints.repeat(0.0).iter().map(|_| Some(both)).collect());
    }
    check_length(value, items.len(), joints.layout.map(crate::layout::Layout::joints), &wanted)?;
    every(items.iter().map(|item| match item.items("[low, high] in rad, or []")?.len() {
        0 => Some(None),
        _ => pair(item).map(Some),
    }))
}

fn pair(value: &Value<'_>) -> Option<[f64; 2]> {
    let [low, high] = value.vector(&PAIR)?;
    if low >= high {
        value.reject("the lower limit comes first, expected [low, high] with low < high");
        return None;
    }
    Some([low, high])
}

/// Notes what of the initial state is beyond its limits.
pub(super) fn check_initial(table: &Table<'_>, initial: &RobotState, limits: &[JointLimits]) {
    let beyond_angle = |joint: &JointLimits, value| {
        let [low, high] = joint.angles?;
        joint.angle_beyond(value).map(|_| format!("outside the limits of {}, {low} to {high} rad", joint.name))
    };
    let beyond_rate = |joint: &JointLimits, value| {
        let limit = joint.rate_beyond(value)?.abs();
        Some(format!("faster than {} may turn, {limit} rad/s", joint.name))
    };
    reject_first(table, "joint_angles", &initial.joint_angles, limits, beyond_angle);
    reject_first(table, "joint_rates", &initial.joint_rates, limits, beyond_rate);
}

fn reject_first(
    table: &Table<'_>,
    key: &str,
    values: &[f64],
    limits: &[JointLimits],
    why: impl Fn(&JointLimits, f64) -> Option<String>,
) {
    let found = limits.iter().zip(values).enumerate().find_map(|(i, (joint, value))| Some((i, why(joint, *value)?)));
    let items = table.get(key).and_then(|value| value.items("numbers"));
    if let (Some((index, why)), Some(items)) = (found, items)
        && let Some(item) = items.get(index)
    {
        item.reject(&format!("{why} (`limits.{key}`)"));
    }
}
