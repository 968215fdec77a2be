//! The `[post_impact]` table: the motion after the capture.

use super::LawNumbers;
use crate::simulate::actuators::Actuation;
use crate::simulate::stepper::Integration;

/// The motion of robot and targets after the capture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PostImpact {
    /// Length in s, greater than 0.
    pub duration: f64,
    /// Time step in s, at most the duration.
    pub step: f64,
    /// The control law of the joints.
    pub control: PostCaptureControl,
    /// Torque limits and sample time of the control law; none of them without a law.
    pub actuation: Actuation,
    /// Integrator and coordinates.
    pub integration: Integration,
}

/// Post-capture control laws.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum PostCaptureControl {
    /// No torques, as in the paper: the default.
    None,
    /// τ = Kp (θ0 − θ) − Kd θ̇, with the joint angles θ0 of the capture.
    Hold {
        /// Kp for each joint in N m/rad, 0 or more.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in N m s/rad, 0 or more.
        derivative_gain: Vec<f64>,
    },
    /// τ = −Kd θ̇.
    Damping {
        /// Kd for each joint in N m s/rad, 0 or more.
        derivative_gain: Vec<f64>,
    },
    /// Joint rates, and the base rate where wheels or a base torque take the momentum, decay as exp(−gain t).
    Stabilise {
        /// For each joint in 1/s, 0 or more.
        derivative_gain: Vec<f64>,
        /// Of the base rate in 1/s, 0 or more.
        base_gain: f64,
        /// Largest torque on the base in N m, 0 or more; `None`, the default, where there is no such actuator.
        base_torque_limit: Option<f64>,
    },
    /// A law that the program has of its own, and hands to the study:
    /// [`RegisteredLaw`](crate::laws::RegisteredLaw).
    Own {
        /// As in the scenario.
        name: &'static str,
        /// Of `[post_impact.law]`.
        numbers: LawNumbers,
    },
}

impl PostCaptureControl {
    /// All shipped laws, without gains.
    pub(crate) const LAWS: &'static [Self] = &[
        Self::None,
        Self::Hold { proportional_gain: Vec::new(), derivative_gain: Vec::new() },
        Self::Damping { derivative_gain: Vec::new() },
        Self::Stabilise { derivative_gain: Vec::new(), base_gain: 0.0, base_torque_limit: None },
    ];

    /// As in a scenario.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Hold { .. } => "hold",
            Self::Damping { .. } => "damping",
            Self::Stabilise { .. } => "stabilise",
            Self::Own { name, .. } => name,
        }
    }
}
