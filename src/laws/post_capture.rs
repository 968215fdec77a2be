//! Laws of the motion after a capture.

use super::Run;
use crate::control::{ProportionalDerivative, Stabilisation, ZeroTorque};
use crate::dynamics::AnyModel;
use crate::scenario::{PostCaptureControl, Scenario};
use crate::simulate::{Phase, PhaseError, Timing};
use crate::trajectory::ConstantSetpoint;

/// A motion after an impact that a law is to control.
#[derive(Clone, Copy)]
pub struct PostCaptureTask<'a> {
    /// Positions are in the inertial frame.
    pub scenario: &'a Scenario,
    /// The robot with the targets that are parts of its last links; those on pins are beside it, and not in the model.
    pub model: &'a AnyModel<f64>,
    /// Which joints turn balanced reaction wheels.
    pub wheels: &'a [bool],
    /// The joint angles at the capture, rad.
    pub angles: &'a [f64],
    /// From the first impact to the start of this motion, s: a later impact begins another one.
    pub since_impact: f64,
    /// Of this motion.
    pub timing: Timing,
}

/// A law of the motion after a capture. The shipped ones are those of [`PostCaptureControl`]; one of the program's own, which
/// that only names, is not a law by itself.
pub trait PostCaptureLaw {
    /// As it is to be called in results.
    fn name(&self) -> &'static str;

    /// Makes the control for this motion and runs the phase under it, once: every impact begins another motion.
    ///
    /// # Errors
    /// When and why the phase stopped; those of making the control are at time 0.
    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError>;

    /// Whether there are torques at all; without them there is no residual motion to report.
    fn acts(&self) -> bool {
        true
    }
}

impl PostCaptureLaw for PostCaptureControl {
    fn name(&self) -> &'static str {
        Self::name(self)
    }

    fn control(&self, task: &PostCaptureTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        let &PostCaptureTask { model, wheels, angles, .. } = task;
        let size = 3 + model.joints();
        let trajectory = ConstantSetpoint { angles };
        match self {
            Self::None => run(&mut ZeroTorque),
            Self::Hold { proportional_gain, derivative_gain } => {
                run(&mut ProportionalDerivative { trajectory, proportional_gain, derivative_gain })
            }
            Self::Damping { derivative_gain } => {
                let proportional_gain = &vec![0.0; model.joints()];
                run(&mut ProportionalDerivative { trajectory, proportional_gain, derivative_gain })
            }
            Self::Stabilise { derivative_gain, base_gain, base_torque_limit } => run(&mut Stabilisation {
                joint_gain: derivative_gain,
                base_gain: *base_gain,
                wheels,
                base_torque_limit: *base_torque_limit,
                base_torque: None,
                mass_matrix: &mut vec![0.0; size * size],
                bias: &mut vec![0.0; size],
            }),
            Self::Own { .. } => unreachable!("a study takes the law itself, or has no result"),
        }
    }

    fn acts(&self) -> bool {
        *self != Self::None
    }
}
