//! Simulation of a phase under a control law with limited and sampled actuators.
//!
//! # Example
//! ```
//! use planar_capture::control::ProportionalDerivative;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::actuators::{Actuation, drive};
//! use planar_capture::simulate::{Timing, event::NoEvents, system::System};
//! use planar_capture::trajectory::ConstantSetpoint;
//!
//! let (robot, trajectory) = (Model::<f64>::default(), ConstantSetpoint { angles: &[1.0, -1.0, 1.0] });
//! let mut law = ProportionalDerivative { trajectory, proportional_gain: &[49.0; 3], derivative_gain: &[14.0; 3] };
//! let actuation = Actuation { torque_limits: Some(vec![2.0; 3]), steps_per_sample: Some(5) };
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let timing = Timing { duration: 1.0, step: 0.02, sample: 0.1, ..Timing::default() };
//! let system = System::alone(&robot);
//! let phase = drive(&system, &mut law, &actuation, &start, &timing, &mut NoEvents, &mut || ())?;
//! assert_eq!(phase.samples[0].joint_torques, [2.0, -2.0, 2.0]); // of the 49 N m that the law wants
//! assert!(phase.saturation.joints[0] > 0.0);
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

use crate::control::{Control, SampledControl, TorqueLimiter};
use crate::error::Error;
use crate::owned::RobotState;
use crate::simulate::event::Events;
use crate::simulate::system::System;
use crate::simulate::{Phase, PhaseError, Timing, simulate};

/// Limits and sample time of a control law.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Actuation {
    /// The largest torque of each joint in N m, 0 or more; default none.
    pub torque_limits: Option<Vec<f64>>,
    /// How many steps each sample of the law is held for (zero-order hold); default none: the law acts continuously.
    pub steps_per_sample: Option<u32>,
}

/// Simulates one phase as [`simulate()`] does, with torque limits and zero-order hold around the control law.
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
) -> Result<Phase, PhaseError> {
    let mut saturated = vec![false; system.model.joints()];
    let law: &mut dyn Control<f64> = match &actuation.torque_limits {
        Some(torque_limits) => &mut TorqueLimiter { law, torque_limits, saturated: &mut saturated },
        None => law,
    };
    let mut held = vec![0.0; system.model.joints()];
    let law: &mut dyn Control<f64> = match actuation.steps_per_sample {
        Some(steps) => &mut SampledControl::new(law, steps, &mut held),
        None => law,
    };
    if law.has_memory() && law.held_steps().is_none() {
        return Err(PhaseError { time: 0.0, source: Error::ContinuousMemory });
    }
    simulate(system, law, initial, timing, events, tick)
}
