//! The motion after an impact, under the law that a scenario names.

use crate::actuators::drive;
use crate::control::{Control, Free, ProportionalDerivative, Stabilise};
use crate::dynamics::Model;
use crate::event::NoEvents;
use crate::layout::{Arm, Layout};
use crate::scenario::{PostImpact, Settling};
use crate::simulate::{Motion, Phase, Stopped, Timing};
use crate::system::System;
use crate::target::Target;
use crate::trajectory::Standing;

/// Which joints turn balanced reaction wheels: arms of one link of length 0 with its COM on the axis, that hold no
/// target.
#[must_use]
pub fn wheels(layout: &Layout, targets: &[Option<Target<f64>>]) -> Vec<bool> {
    let free = targets.iter().map(Option::is_none).chain(std::iter::repeat(true));
    let arms = layout.arms.iter().zip(free);
    arms.flat_map(|(arm, free)| std::iter::repeat_n(free && is_wheel(arm), arm.links.len())).collect()
}

fn is_wheel(arm: &Arm) -> bool {
    matches!(arm.links.as_slice(), [link] if [link.length, link.com[0], link.com[1]].iter().all(|size| *size == 0.0))
}

/// Runs the merged robot from `start` on; `wheels` as [`wheels`] says.
///
/// # Errors
/// When and why it stopped.
pub fn settle(
    model: &dyn Model<f64>,
    after: &PostImpact,
    wheels: &[bool],
    start: &Motion,
    sample: f64,
    tick: &mut dyn FnMut(),
) -> Result<Phase, Stopped> {
    let (duration, step, integration) = (after.duration, after.step, after.integration);
    let timing = Timing { duration, step, sample, integration };
    let size = 3 + model.joints();
    let (mut mass_matrix, mut bias) = (vec![0.0; size * size], vec![0.0; size]);
    let (mut held, mut damped, mut stabilised);
    let standing = Standing { angles: &start.joint_angles };
    let no_stiffness = vec![0.0; model.joints()];
    let law: &mut dyn Control<f64> = match &after.control {
        Settling::None => &mut Free,
        Settling::Hold { proportional_gain, derivative_gain } => {
            held = ProportionalDerivative { trajectory: standing, proportional_gain, derivative_gain };
            &mut held
        }
        Settling::Damping { derivative_gain } => {
            damped = ProportionalDerivative { trajectory: standing, proportional_gain: &no_stiffness, derivative_gain };
            &mut damped
        }
        Settling::Stabilise { derivative_gain, base_gain, base_torque_limit } => {
            stabilised = Stabilise {
                joint_gain: derivative_gain,
                base_gain: *base_gain,
                wheels,
                base_torque_limit: *base_torque_limit,
                base_torque: None,
                mass_matrix: &mut mass_matrix,
                bias: &mut bias,
            };
            &mut stabilised
        }
    };
    drive(&System::alone(model), law, &after.actuation, start, &timing, &mut NoEvents, tick)
}
