//! Laws of the approach.

use super::EndEffectorFeedback;
use super::Run;
use crate::control::{ComputedTorque, InverseDynamics, ProportionalDerivative};
use crate::dynamics::AnyModel;
use crate::scenario::{Scenario, Tracking};
use crate::simulate::{Phase, PhaseError, Timing};
use crate::trajectory::AnyTrajectory;

/// An approach that a law is to track.
#[derive(Clone, Copy)]
pub struct TrackingTask<'a> {
    /// Positions are in the inertial frame. Where final joint angles were designed, it has them.
    pub scenario: &'a Scenario,
    /// The robot without targets.
    pub model: &'a AnyModel<f64>,
    /// The desired motion of the joints, with the final rates that were designed. Resolved motion rate control has none: the
    /// joints follow the end effectors.
    pub trajectory: AnyTrajectory<'a, f64>,
    /// Of the phase.
    pub timing: Timing,
}

/// A law that tracks an approach. The shipped ones are those of [`Tracking`]; one of the program's own, which that only
/// names, is not a law by itself.
pub trait TrackingLaw {
    /// As it is to be called in results.
    fn name(&self) -> &'static str;

    /// Makes the control for this approach and runs the phase under it, once: a study may have several approaches, each
    /// of which begins anew.
    ///
    /// # Errors
    /// When and why the phase stopped; those of making the control are at time 0.
    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError>;

    /// Whether joints begin with the initial rates of the trajectory, instead of those of the scenario.
    fn starts_on_trajectory(&self) -> bool {
        false
    }
}

impl TrackingLaw for Tracking {
    fn name(&self) -> &'static str {
        Self::name(self)
    }

    fn track(&self, task: &TrackingTask<'_>, run: Run<'_>) -> Result<Phase, PhaseError> {
        let &TrackingTask { model, trajectory, .. } = task;
        let joints = model.joints();
        let generalized_inertia = || vec![0.0; joints * joints];
        let generalized_jacobian = || vec![0.0; 3 * model.arms() * joints];
        match self {
            Self::InverseDynamics => run(&mut InverseDynamics {
                trajectory,
                generalized_inertia: &mut generalized_inertia(),
                generalized_bias: &mut vec![0.0; joints],
                generalized_jacobian: &mut generalized_jacobian(),
            }),
            Self::ProportionalDerivative { proportional_gain, derivative_gain } => {
                run(&mut ProportionalDerivative { trajectory, proportional_gain, derivative_gain })
            }
            Self::ComputedTorque { proportional_gain, derivative_gain } => run(&mut ComputedTorque {
                trajectory,
                proportional_gain,
                derivative_gain,
                generalized_inertia: &mut generalized_inertia(),
                generalized_bias: &mut vec![0.0; joints],
                generalized_jacobian: &mut generalized_jacobian(),
            }),
            Self::Own { .. } => unreachable!("a study takes the law itself, or has no result"),
            Self::ResolvedMotionRate { pose_gain, rate_gain, singularity_threshold } => {
                let mut end_effectors = EndEffectorFeedback::new(model, task.scenario)?;
                run(&mut end_effectors.law([*pose_gain, *rate_gain], *singularity_threshold))
            }
        }
    }

    fn starts_on_trajectory(&self) -> bool {
        matches!(self, Self::InverseDynamics)
    }
}
