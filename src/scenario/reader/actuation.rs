//! `torque_limits` and `sample_time`: the actuators of a control law.

use super::joints::Joints;
use crate::diagnostic::{Table, Value};
use crate::simulate::Timing;
use crate::simulate::actuators::Actuation;

/// Part of the duration by which a sample time may be longer: rounding of decimal fractions.
const ROUNDING: f64 = 1e-6;

/// Reads the actuation of a phase; `times` are its duration and step.
pub(super) fn actuation(table: &Table<'_>, times: Option<(f64, f64)>, joints: &Joints<'_>) -> Option<Actuation> {
    let torque_limits = table.read_or("torque_limits", None, |value| joints.one_or_each(value).map(Some));
    let steps_per_sample = table.read_or("sample_time", None, |value| steps_per_sample(value, times).map(Some));
    Some(Actuation { torque_limits: torque_limits?, steps_per_sample: steps_per_sample? })
}

fn steps_per_sample(value: &Value<'_>, times: Option<(f64, f64)>) -> Option<u32> {
    let sample_time = value.number()?;
    let (duration, step) = times?;
    let timing = Timing::of_steps(duration, step);
    if sample_time > duration * (1.0 + ROUNDING) {
        value.reject(&format!("longer than the phase, expected at most its duration, {duration} s"));
        return None;
    }
    let steps = timing.whole_steps(sample_time);
    if steps.is_none() {
        let step = timing.step_length();
        let nearest = (sample_time / step).round().max(1.0) * step;
        value
            .reject(&format!("expected a whole number of steps of {step} s, {nearest} s for example; or another step"));
    }
    steps
}
