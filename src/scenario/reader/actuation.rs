//! `torque_limits` and `sample_time`: the actuators of a control law.

use super::joints::Joints;
use crate::diagnostic::{Table, Value};
use crate::simulate::Timing;
use crate::simulate::actuators::Actuation;

/// Largest distance of a sample time from a whole number of steps, in steps: rounding of decimal fractions.
const STEP_TOLERANCE: f64 = 1e-6;

/// Reads the actuation of a phase; `times` are its duration and step.
pub(super) fn actuation(table: &Table<'_>, times: Option<(f64, f64)>, joints: &Joints<'_>) -> Option<Actuation> {
    let torque_limits = table.read_or("torque_limits", None, |value| joints.one_or_each(value).map(Some));
    let steps_per_sample = table.read_or("sample_time", None, |value| steps_per_sample(value, times).map(Some));
    Some(Actuation { torque_limits: torque_limits?, steps_per_sample: steps_per_sample? })
}

fn steps_per_sample(value: &Value<'_>, times: Option<(f64, f64)>) -> Option<u32> {
    let sample_time = value.number()?;
    let (duration, step) = times?;
    #[allow(clippy::cast_precision_loss, reason = "at most 1e8 steps are read")]
    let step = duration / Timing { duration, step, sample: step, ..Timing::default() }.steps() as f64;
    let steps = (sample_time / step).round();
    if sample_time > duration * (1.0 + STEP_TOLERANCE) {
        value.reject(&format!("longer than the phase, expected at most its duration, {duration} s"));
        return None;
    }
    if steps < 1.0 || (sample_time / step - steps).abs() > STEP_TOLERANCE {
        let nearest = steps.max(1.0) * step;
        value
            .reject(&format!("expected a whole number of steps of {step} s, {nearest} s for example; or another step"));
        return None;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e8, whole")]
    Some(steps as u32)
}
