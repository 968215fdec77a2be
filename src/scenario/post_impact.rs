//! The `[post_impact]` table: what follows the capture.

use super::actuation::Actuation;
use super::duration_and_step;
use super::integration;
use super::joints::Joints;
use crate::diagnostic::{NumberRule, Table};
use crate::simulate::integration::Integration;

const STIFFNESS: NumberRule = NumberRule::non_negative("a proportional gain (or one per joint)", "N m/rad");
const DAMPING: NumberRule = NumberRule::non_negative("a derivative gain (or one per joint)", "N m s/rad");
const JOINT_DECAY: NumberRule =
    NumberRule::non_negative("a derivative gain of stabilisation (or one per joint)", "1/s");
const BASE_DECAY: NumberRule = NumberRule::non_negative("a gain of the base rate", "1/s");
const BASE_TORQUE: NumberRule = NumberRule::non_negative("a limit of the torque on the base", "N m");

/// The motion of robot and targets, as one, after the capture.
#[derive(Clone, Debug, PartialEq)]
pub struct PostImpact {
    /// Length in s, greater than 0.
    pub duration: f64,
    /// Time step in s, at most the duration; default 0.005.
    pub step: f64,
    /// What the joints do.
    pub control: PostCaptureControl,
    /// Torque limits and sample time of the control law; none of them without a law.
    pub actuation: Actuation,
    /// By which integrator, in which coordinates.
    pub integration: Integration,
}

/// What the joints do after a capture.
#[derive(Clone, Debug, PartialEq)]
pub enum PostCaptureControl {
    /// Nothing, as in the paper: the default.
    None,
    /// τ = Kp (θ0 − θ) − Kd θ̇: they keep the angles θ0 of the capture.
    Hold {
        /// Kp for each joint in N m/rad, 0 or more; default 49.
        proportional_gain: Vec<f64>,
        /// Kd for each joint in N m s/rad, 0 or more; default 14.
        derivative_gain: Vec<f64>,
    },
    /// τ = −Kd θ̇: they lose their rates.
    Damping {
        /// Kd for each joint in N m s/rad, 0 or more; default 7.
        derivative_gain: Vec<f64>,
    },
    /// Joint rates, and the base rate where wheels or a base torque take the momentum, decay as exp(−gain t).
    Stabilise {
        /// For each joint in 1/s, 0 or more; default 0.5.
        derivative_gain: Vec<f64>,
        /// Of the base rate in 1/s, 0 or more; default 0.5.
        base_gain: f64,
        /// Largest torque on the base in N m, 0 or more; `None`, the default, where there is no such actuator.
        base_torque_limit: Option<f64>,
    },
}

impl PostCaptureControl {
    /// As in a scenario.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Hold { .. } => "hold",
            Self::Damping { .. } => "damping",
            Self::Stabilise { .. } => "stabilise",
        }
    }

    fn from_table(table: &Table<'_>, joints: &Joints<'_>) -> Option<Self> {
        let choice = match table.get("control") {
            Some(value) => value.choice(&Choice::ALL)?,
            None => Choice::None,
        };
        choice.reject_others(table);
        let gain = |key, quantity, default| joints.gain(table, key, quantity, default);
        Some(match choice {
            Choice::None => Self::None,
            Choice::Hold => {
                let proportional_gain = gain("proportional_gain", &STIFFNESS, 49.0);
                let derivative_gain = gain("derivative_gain", &DAMPING, 14.0);
                Self::Hold { proportional_gain: proportional_gain?, derivative_gain: derivative_gain? }
            }
            Choice::Damping => Self::Damping { derivative_gain: gain("derivative_gain", &DAMPING, 7.0)? },
            Choice::Stabilise => {
                let derivative_gain = gain("derivative_gain", &JOINT_DECAY, 0.5);
                let base_gain = table.number_or("base_gain", &BASE_DECAY, 0.5);
                let base_torque_limit = match table.get("base_torque_limit") {
                    Some(value) => value.number(&BASE_TORQUE).map(Some),
                    None => Some(None),
                };
                Self::Stabilise {
                    derivative_gain: derivative_gain?,
                    base_gain: base_gain?,
                    base_torque_limit: base_torque_limit?,
                }
            }
        })
    }
}

/// The value of `control`.
#[derive(Clone, Copy)]
enum Choice {
    None,
    Hold,
    Damping,
    Stabilise,
}

impl Choice {
    const ALL: [(&'static str, Self); 4] =
        [("none", Self::None), ("hold", Self::Hold), ("damping", Self::Damping), ("stabilise", Self::Stabilise)];

    /// Notes the keys that are about another law.
    fn reject_others(self, table: &Table<'_>) {
        let (others, why): (&[&str], _) = match self {
            Self::None => (
                &PostImpact::KEYS[6..],
                "without control there are no torques, expected `control` `hold`, `damping` or `stabilise` with it",
            ),
            Self::Hold => (&["base_gain", "base_torque_limit"], "only `control = \"stabilise\"` acts on the base"),
            Self::Damping => (
                &["proportional_gain", "base_gain", "base_torque_limit"],
                "damping has a derivative_gain alone, expected `control = \"hold\"` or `\"stabilise\"` with it",
            ),
            Self::Stabilise => {
                (&["proportional_gain"], "stabilisation wants no angles, expected `control = \"hold\"` with it")
            }
        };
        for value in others.iter().filter_map(|key| table.get(key)) {
            value.reject(why);
        }
    }
}

impl PostImpact {
    pub(super) const KEYS: [&'static str; 12] = [
        "duration",
        "step",
        integration::KEYS[0],
        integration::KEYS[1],
        integration::KEYS[2],
        "control",
        "proportional_gain",
        "derivative_gain",
        "base_gain",
        "base_torque_limit",
        Actuation::KEYS[0],
        Actuation::KEYS[1],
    ];

    pub(super) fn from_table(table: &Table<'_>, joints: &Joints<'_>) -> Option<Self> {
        let times = duration_and_step(table);
        let control = PostCaptureControl::from_table(table, joints);
        let actuation = match control {
            Some(PostCaptureControl::None) => Some(Actuation::default()),
            _ => Actuation::from_table(table, times, joints),
        };
        let integration = integration::integration(table);
        let (duration, step) = times?;
        Some(Self { duration, step, control: control?, actuation: actuation?, integration: integration? })
    }
}
