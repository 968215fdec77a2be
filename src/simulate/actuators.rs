//! A control law behind limited and sampled actuators, of a robot whose joints are watched.

use crate::control::{Control, Limited, Sampled};
use crate::owned::RobotState;
use crate::scenario::Actuation;
use crate::simulate::event::Events;
use crate::simulate::limits::{Excesses, Watched};
use crate::simulate::system::System;
use crate::simulate::{Phase, Stopped, Timing, simulate};

/// Runs one phase under a law whose torques are limited, and sampled, as the scenario says; see [`simulate()`].
///
/// # Errors
/// When and why it stopped.
pub fn drive(
    system: &System<'_>,
    law: &mut dyn Control<f64>,
    actuation: &Actuation,
    initial: &RobotState,
    timing: &Timing,
    events: &mut dyn Events,
    tick: &mut dyn FnMut(),
) -> Result<Phase, Stopped> {
    let mut watched = Watched { law, limits: &actuation.joint_limits, excesses: Excesses::default() };
    let law: &mut dyn Control<f64> = &mut watched;
    let mut saturated = vec![false; system.model.joints()];
    let mut limited;
    let law: &mut dyn Control<f64> = match &actuation.torque_limits {
        Some(torque_limits) => {
            limited = Limited { law, torque_limits, saturated: &mut saturated };
            &mut limited
        }
        None => law,
    };
    let mut held = vec![0.0; system.model.joints()];
    let phase = match actuation.steps_per_sample {
        Some(steps) => simulate(system, &mut Sampled::new(law, steps, &mut held), initial, timing, events, tick),
        None => simulate(system, law, initial, timing, events, tick),
    }?;
    Ok(watched.finish(phase))
}
