//! The `[limits]` table: ranges of joint angles and largest joint rates.

use super::joints::Joints;
use crate::diagnostic::{Table, Value, every};
use crate::owned::RobotState;
use crate::simulate::limits::JointLimits;

/// One per joint.
pub(super) fn joint_limits(table: &Table<'_>, joints: &Joints<'_>) -> Option<Vec<JointLimits>> {
    let angles = table.read_or("joint_angles", joints.repeat(None), |value| angles(value, joints));
    let rates = table.read_or("joint_rates", joints.repeat(None), |value| rates(value, joints));
    let layout = joints.layout?;
    let limits = angles?.into_iter().zip(rates?).enumerate();
    Some(limits.map(|(i, (angles, rate))| JointLimits { name: layout.joint_name(i), angles, rate }).collect())
}

/// One range for all joints, or one or `[]` for each.
fn angles(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<Option<[f64; 2]>>> {
    let expected =
        format!("[low, high] in rad, or a list of {} (each [low, high], or [] for any angle)", joints.one_each());
    let items = value.items(&expected)?;
    if !items.iter().any(Value::is_array) {
        return range(value).map(|range| joints.repeat(Some(range)));
    }
    joints.check_length(value, items.len(), &expected)?;
    every(items.iter().map(|item| match item.items("[low, high] in rad, or []")?.len() {
        0 => Some(None),
        _ => range(item).map(Some),
    }))
}

/// One largest rate for all joints, or one or `[]` for each.
fn rates(value: &Value<'_>, joints: &Joints<'_>) -> Option<Vec<Option<f64>>> {
    if !value.is_array() {
        return value.number().map(|rate| joints.repeat(Some(rate)));
    }
    let expected = format!("{}, [] for any rate", joints.one_each());
    let items = value.items(&expected)?;
    joints.check_length(value, items.len(), &expected)?;
    let is_none = |item: &Value<'_>| item.is_array() && item.items(&expected).is_some_and(|inner| inner.is_empty());
    // another list is no number
    every(items.iter().map(|item| if is_none(item) { Some(None) } else { item.number().map(Some) }))
}

fn range(value: &Value<'_>) -> Option<[f64; 2]> {
    let [low, high] = value.vector()?;
    if low >= high {
        value.reject("the lower limit comes first, expected [low, high] with low < high");
        return None;
    }
    Some([low, high])
}

/// Rejects the first joint angle and the first joint rate of the initial state that is beyond its limit.
pub(super) fn check_initial(table: &Table<'_>, initial: &RobotState, limits: &[JointLimits]) {
    let angle = |joint: &JointLimits, value| {
        let [low, high] = joint.angles?;
        joint.angle_beyond(value).map(|_| format!("outside the limits of {}, {low} to {high} rad", joint.name))
    };
    let rate = |joint: &JointLimits, value| {
        let limit = joint.rate_beyond(value)?.abs();
        Some(format!("faster than {} may turn, {limit} rad/s", joint.name))
    };
    reject_first(table, "joint_angles", &initial.joint_angles, limits, angle);
    reject_first(table, "joint_rates", &initial.joint_rates, limits, rate);
}

fn reject_first(
    table: &Table<'_>,
    key: &str,
    values: &[f64],
    limits: &[JointLimits],
    violation: impl Fn(&JointLimits, f64) -> Option<String>,
) {
    let Some(items) = table.get(key).and_then(|value| value.items("numbers")) else { return };
    let mut violations = items.iter().zip(limits.iter().zip(values));
    if let Some((item, why)) = violations.find_map(|(item, (joint, value))| Some((item, violation(joint, *value)?))) {
        item.reject(&format!("{why} (`limits.{key}`)"));
    }
}
