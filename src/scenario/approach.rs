//! The `[approach]` table: the trajectory of the arms and its tracking.

use super::LawNumbers;
use crate::simulate::actuators::Actuation;
use crate::simulate::stepper::Integration;
use crate::trajectory::TrajectoryKind;
use std::f64::consts::{PI, TAU};

/// A trajectory, its final state and its tracking law.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Approach {
    /// Length in s, greater than 0.
    pub duration: f64,
    /// Time step in s, at most the duration.
    pub step: f64,
    /// Duration of a trajectory that ends at rest before the phase does, s; its final state is then the setpoint.
    /// `None`, the default, where the trajectory takes the whole phase.
    pub trajectory_duration: Option<f64>,
    /// The joint trajectories.
    pub trajectory: TrajectoryKind,
    /// Final joint angles arm by arm, rad. Where end effector poses are given, the first guess of the inverse
    /// kinematics, by default the initial angles. Not used by resolved motion rate control.
    pub final_joint_angles: Vec<f64>,
    /// Final poses of the end effectors, one per arm; `None` where joint angles are given.
    pub final_end_effector_poses: Option<Vec<EndEffectorGoal>>,
    /// Final rates.
    pub end: FinalRates,
    /// The tracking law.
    pub tracking: Tracking,
    /// Torque limits and sample time of the control law; none of them for exact tracking.
    pub actuation: Actuation,
    /// Integrator and coordinates.
    pub integration: Integration,
}

/// The desired pose of an end effector at the end of an approach, inertial frame.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum EndEffectorGoal {
    /// Anywhere.
    Any,
    /// At [x, y] in m, at any yaw.
    Position([f64; 2]),
    /// At [yaw, x, y] in rad, m, m; the yaw up to whole turns.
    Pose([f64; 3]),
}

/// Desired [ω, vx, vy] of an end effector, rad/s, m/s; `None` for any value.
pub type EndEffectorTwistGoal = [Option<f64>; 3];

/// The desired rates at the end of an approach.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum FinalRates {
    /// Rest, for trajectories that end at rest.
    Rest,
    /// Joint rates arm by arm, in rad/s.
    JointRates(Vec<f64>),
    /// Twists of the end effectors, one per arm, from which the generalized Jacobian
    /// gives the joint rates.
    EndEffectorTwists(Vec<EndEffectorTwistGoal>),
}

/// Tracking laws.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Tracking {
    /// Without error, with torques from inverse dynamics; the arms start at rest.
    InverseDynamics,
    /// τ = Kp (θd − θ) + Kd (θ̇d − θ̇), the default.
    ProportionalDerivative {
        /// Kp for each joint in N m/rad, 0 or more.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in N m s/rad, 0 or more.
        derivative_gain: Vec<f64>,
    },
    /// The end effectors follow straight paths to `final_end_effector_poses`, by feedback of their poses; see
    /// [`ResolvedMotionRate`](crate::control::ResolvedMotionRate).
    ResolvedMotionRate {
        /// K in 1/s, greater than 0.
        pose_gain: f64,
        /// k in 1/s, greater than 0.
        rate_gain: f64,
        /// Singular values below this part of the largest are damped, 0 to 1.
        singularity_threshold: f64,
    },
    /// τ = I (θ̈d + Kd (θ̇d − θ̇) + Kp (θd − θ)) + c, by inverse dynamics of the measured state.
    ComputedTorque {
        /// Kp for each joint in 1/s², 0 or more.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in 1/s, 0 or more.
        derivative_gain: Vec<f64>,
    },
    /// A law that the program has of its own, and hands to the study:
    /// [`RegisteredLaw`](crate::laws::RegisteredLaw).
    Own {
        /// As in the scenario.
        name: &'static str,
        /// Of `[approach.law]`.
        numbers: LawNumbers,
    },
}

impl FinalRates {
    /// Whether all given rates or twists are zero.
    #[must_use]
    pub fn is_rest(&self) -> bool {
        match self {
            Self::Rest => true,
            Self::JointRates(rates) => rates.iter().all(|rate| *rate == 0.0),
            Self::EndEffectorTwists(twists) => twists.as_flattened().iter().flatten().all(|part| *part == 0.0),
        }
    }
}

impl Tracking {
    /// All shipped laws, without gains.
    pub(crate) const LAWS: &'static [Self] = &[
        Self::ProportionalDerivative { proportional_gain: Vec::new(), derivative_gain: Vec::new() },
        Self::InverseDynamics,
        Self::ComputedTorque { proportional_gain: Vec::new(), derivative_gain: Vec::new() },
        Self::ResolvedMotionRate { pose_gain: 0.0, rate_gain: 0.0, singularity_threshold: 0.0 },
    ];

    /// As in a scenario.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::InverseDynamics => "exact",
            Self::ProportionalDerivative { .. } => "pd",
            Self::ResolvedMotionRate { .. } => "resolved_motion_rate",
            Self::ComputedTorque { .. } => "computed_torque",
            Self::Own { name, .. } => name,
        }
    }
}

impl Approach {
    /// Duration of the trajectory, s.
    #[must_use]
    pub fn trajectory_time(&self) -> f64 {
        self.trajectory_duration.unwrap_or(self.duration)
    }
}

impl EndEffectorGoal {
    /// [x, y] in m; `None` for any position.
    #[must_use]
    pub fn position(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Any => None,
            Self::Position([x, y]) | Self::Pose([_, x, y]) => Some([x, y]),
        }
    }

    /// The number of given coordinates.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Any => 0,
            Self::Position(_) => 2,
            Self::Pose(_) => 3,
        }
    }

    /// Whether no coordinate is given.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// (index in a pose, desired less given value) of each given coordinate; the yaw up to whole turns.
    pub(crate) fn errors(&self, [yaw, x, y]: &[f64; 3]) -> impl Iterator<Item = (usize, f64)> + use<> {
        let turn = |angle: f64| (angle + PI).rem_euclid(TAU) - PI;
        let errors = match self {
            Self::Any => [None; 3],
            Self::Position([to_x, to_y]) => [None, Some(to_x - x), Some(to_y - y)],
            Self::Pose([to_yaw, to_x, to_y]) => [Some(turn(to_yaw - yaw)), Some(to_x - x), Some(to_y - y)],
        };
        errors.into_iter().enumerate().filter_map(|(part, error)| Some((part, error?)))
    }
}
