//! The motion after an impact under the scenario's post-capture control law.

use crate::capture::assembly::Attachment;
use crate::control::{Control, ProportionalDerivative, Stabilisation, ZeroTorque};
use crate::layout::{Arm, Layout};
use crate::owned::RobotState;
use crate::scenario::{PostCaptureControl, PostImpact};
use crate::simulate::actuators::drive;
use crate::simulate::event::Events;
use crate::simulate::system::System;
use crate::simulate::{Phase, PhaseError, Timing};
use crate::trajectory::ConstantSetpoint;

/// Which joints turn balanced reaction wheels: arms of one link of length 0 with its COM on the axis that hold no
/// target.
#[must_use]
pub fn wheels(layout: &Layout, attachments: &[Attachment]) -> Vec<bool> {
    let arms = layout.arms.iter().enumerate();
    let free = |i: usize| attachments.iter().all(|attachment| attachment.arm != i);
    arms.flat_map(|(i, arm)| std::iter::repeat_n(free(i) && is_wheel(arm), arm.links.len())).collect()
}

fn is_wheel(arm: &Arm) -> bool {
    matches!(arm.links.as_slice(), [link] if [link.length, link.com[0], link.com[1]].iter().all(|size| *size == 0.0))
}

/// A post-capture control law and its parameters.
#[derive(Clone, Copy, Debug)]
pub struct PostCaptureLaw<'a> {
    /// From the scenario.
    pub after: &'a PostImpact,
    /// Which joints turn wheels, see [`wheels`].
    pub wheels: &'a [bool],
    /// Setpoint of the joint angles, rad: those of the capture.
    pub angles: &'a [f64],
}

/// Simulates robot and targets from `start` under the law, up to the duration or an event.
///
/// # Errors
/// When and why it stopped.
pub fn run_post_capture(
    system: &System<'_>,
    PostCaptureLaw { after, wheels, angles }: PostCaptureLaw<'_>,
    start: &RobotState,
    timing: &Timing,
    events: &mut dyn Events,
    tick: &mut dyn FnMut(),
) -> Result<Phase, PhaseError> {
    let model = system.model;
    let size = 3 + model.joints();
    let trajectory = ConstantSetpoint { angles };
    let law: &mut dyn Control<f64> = match &after.control {
        PostCaptureControl::None => &mut ZeroTorque,
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            &mut ProportionalDerivative { trajectory, proportional_gain, derivative_gain }
        }
        PostCaptureControl::Damping { derivative_gain } => {
            &mut ProportionalDerivative { trajectory, proportional_gain: &vec![0.0; model.joints()], derivative_gain }
        }
        PostCaptureControl::Stabilise { derivative_gain, base_gain, base_torque_limit } => &mut Stabilisation {
            joint_gain: derivative_gain,
            base_gain: *base_gain,
            wheels,
            base_torque_limit: *base_torque_limit,
            base_torque: None,
            mass_matrix: &mut vec![0.0; size * size],
            bias: &mut vec![0.0; size],
        },
    };
    drive(system, law, &after.actuation, start, timing, events, tick)
}
