//! A control law behind limited and sampled actuators, of a robot whose joints are watched.

use crate::control::{Control, Limited, Sampled};
use crate::dynamics::Model;
use crate::limits::{Excesses, Watched};
use crate::scenario::Actuation;
use crate::simulate::{Motion, Phase, Stopped, Timing, simulate};

/// Runs one phase under a law whose torques are limited, and sampled, as the scenario says; see [`simulate()`].
///
/// # Errors
/// When and why it stopped.
pub fn drive(
    model: &dyn Model<f64>,
    law: &mut dyn Control<f64>,
    actuation: &Actuation,
    initial: &Motion,
    timing: &Timing,
    tick: &mut dyn FnMut(),
) -> Result<Phase, Stopped> {
    let mut watched = Watched { law, limits: &actuation.joint_limits, excesses: Excesses::default() };
    let law: &mut dyn Control<f64> = &mut watched;
    let mut saturated = vec![false; model.joints()];
    let mut limited;
    let law: &mut dyn Control<f64> = match &actuation.torque_limits {
        Some(torque_limits) => {
            limited = Limited { law, torque_limits, saturated: &mut saturated };
            &mut limited
        }
        None => law,
    };
    let mut held = vec![0.0; model.joints()];
    let phase = match actuation.steps_per_sample {
        Some(steps) => simulate(model, &mut Sampled::new(law, steps, &mut held), initial, timing, tick),
        None => simulate(model, law, initial, timing, tick),
    }?;
    Ok(watched.finish(phase))
}
