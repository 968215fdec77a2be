//! The `[approach]` table: how the arms move to the targets.

use crate::simulate::actuators::Actuation;
use crate::simulate::integration::Integration;
use crate::trajectory::TrajectoryKind;
use std::f64::consts::{PI, TAU};

/// A joint trajectory and how it is followed.
#[derive(Clone, Debug, PartialEq)]
pub struct Approach {
    /// Length in s, greater than 0.
    pub duration: f64,
    /// Time step in s, at most the duration; default 0.005.
    pub step: f64,
    /// How long the trajectory takes, in s, less than the duration, for one that ends at rest: what is wanted at its
    /// end stays wanted. `None` where it takes the whole duration, as by default.
    pub trajectory_duration: Option<f64>,
    /// The joint trajectories.
    pub trajectory: TrajectoryKind,
    /// Joint angles wanted at the end, arm by arm, in rad. Where end effector poses are wanted, the first guess of the
    /// angles that give them, by default the initial ones; for resolved motion rate control these, which it does not
    /// look at.
    pub final_joint_angles: Vec<f64>,
    /// What is wanted of the end effectors at the end, one per arm; `None` where joint angles are given.
    pub final_end_effector_poses: Option<Vec<EndEffectorGoal>>,
    /// Rates wanted at the end.
    pub end: FinalRates,
    /// How the trajectory is followed.
    pub tracking: Tracking,
    /// Torque limits and sample time of the control law; none of them for exact tracking.
    pub actuation: Actuation,
    /// By which integrator, in which coordinates.
    pub integration: Integration,
}

/// Where an end effector should be at the end of an approach, inertial frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EndEffectorGoal {
    /// Anywhere.
    Any,
    /// At [x, y] in m, at any yaw.
    Position([f64; 2]),
    /// At [yaw, x, y] in rad, m, m; the yaw up to whole turns.
    Pose([f64; 3]),
}

/// [ω, vx, vy] wanted of an end effector, rad/s, m/s; `None` where any will do.
pub type EndEffectorTwistGoal = [Option<f64>; 3];

/// The rates wanted at the end of an approach.
#[derive(Clone, Debug, PartialEq)]
pub enum FinalRates {
    /// Rest: for a trajectory that ends so.
    Rest,
    /// Joint rates arm by arm, in rad/s.
    JointRates(Vec<f64>),
    /// Twists of the end effectors, one per arm, from which the generalized Jacobian
    /// gives the joint rates.
    EndEffectorTwists(Vec<EndEffectorTwistGoal>),
}

/// How a trajectory is followed.
#[derive(Clone, Debug, PartialEq)]
pub enum Tracking {
    /// Without error, with torques from inverse dynamics; the arms start at rest.
    Exact,
    /// τ = Kp (θd − θ) + Kd (θ̇d − θ̇), the default.
    ProportionalDerivative {
        /// Kp for each joint in N m/rad, 0 or more; default 49.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in N m s/rad, 0 or more; default 14.
        derivative_gain: Vec<f64>,
    },
    /// The end effectors follow straight paths to `final_end_effector_poses`, by feedback of their poses; see
    /// [`ResolvedMotionRate`](crate::control::ResolvedMotionRate).
    ResolvedMotionRate {
        /// K in 1/s, greater than 0; default 2.
        pose_gain: f64,
        /// k in 1/s, greater than 0; default 10.
        rate_gain: f64,
        /// Singular values below this part of the largest are damped, 0 to 1; default 0.04.
        singularity_threshold: f64,
    },
    /// τ = I (θ̈d + Kd (θ̇d − θ̇) + Kp (θd − θ)) + c, by inverse dynamics of the measured state.
    ComputedTorque {
        /// Kp for each joint in 1/s², 0 or more; default 49.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in 1/s, 0 or more; default 14.
        derivative_gain: Vec<f64>,
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
    /// As in a scenario.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::ProportionalDerivative { .. } => "pd",
            Self::ResolvedMotionRate { .. } => "resolved_motion_rate",
            Self::ComputedTorque { .. } => "computed_torque",
        }
    }
}

impl Approach {
    /// How long the trajectory takes, in s.
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

    /// How many numbers are wanted.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Any => 0,
            Self::Position(_) => 2,
            Self::Pose(_) => 3,
        }
    }

    /// Whether nothing is wanted.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// (index in a pose, wanted less found) of what is wanted; the yaw to the nearest turn.
    pub(crate) fn missing(&self, [yaw, x, y]: &[f64; 3]) -> impl Iterator<Item = (usize, f64)> + use<> {
        let turn = |angle: f64| (angle + PI).rem_euclid(TAU) - PI;
        let [turned, right, up] = match self {
            Self::Any => [None; 3],
            Self::Position([to_x, to_y]) => [None, Some(to_x - x), Some(to_y - y)],
            Self::Pose([to_yaw, to_x, to_y]) => [Some(turn(to_yaw - yaw)), Some(to_x - x), Some(to_y - y)],
        };
        [turned, right, up].into_iter().enumerate().filter_map(|(part, missing)| Some((part, missing?)))
    }
}
