//! `torque_limits` and `sample_time`: what stands between a control law and the joints.

use super::joints::Joints;
use crate::diagnostic::{NumberRule, Table, Value};
use crate::simulate::Timing;
use crate::simulate::actuators::Actuation;

const TORQUE_LIMIT: NumberRule = NumberRule::non_negative("a torque limit (or one per joint)", "N m");
const SAMPLE_TIME: NumberRule = NumberRule::positive("a sample time", "s");

/// By how much a sample time may miss a whole number of steps, in steps: rounding of decimal fractions.
const WHOLE: f64 = 1e-6;

impl Actuation {
    pub(super) const KEYS: [&'static str; 2] = ["torque_limits", "sample_time"];

    /// `times` are the duration and the step of the phase.
    pub(super) fn from_table(table: &Table<'_>, times: Option<(f64, f64)>, joints: &Joints<'_>) -> Option<Self> {
        let torque_limits = match table.get("torque_limits") {
            Some(value) => joints.one_or_each(&value, &TORQUE_LIMIT).map(Some),
            None => Some(None),
        };
        let steps_per_sample = match table.get("sample_time") {
            Some(value) => steps_per_sample(&value, times).map(Some),
            None => Some(None),
        };
        Some(Self { torque_limits: torque_limits?, steps_per_sample: steps_per_sample?, joint_limits: Vec::new() })
    }

    /// Notes that there is no law that these could be about.
    pub(super) fn reject(table: &Table<'_>, why: &str) {
        for value in Self::KEYS.iter().filter_map(|key| table.get(key)) {
            value.reject(why);
        }
    }
}

fn steps_per_sample(value: &Value<'_>, times: Option<(f64, f64)>) -> Option<u32> {
    let sample_time = value.number(&SAMPLE_TIME)?;
    let (duration, step) = times?;
    #[allow(clippy::cast_precision_loss, reason = "at most 1e8 steps are read")]
    let step = duration / Timing { duration, step, sample: step, ..Timing::default() }.steps() as f64;
    let steps = (sample_time / step).round();
    if sample_time > duration * (1.0 + WHOLE) {
        value.reject(&format!("longer than the phase, expected at most its duration, {duration} s"));
        return None;
    }
    if steps < 1.0 || (sample_time / step - steps).abs() > WHOLE {
        let nearest = steps.max(1.0) * step;
        value
            .reject(&format!("expected a whole number of steps of {step} s, {nearest} s for example; or another step"));
        return None;
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e8, whole")]
    Some(steps as u32)
}
