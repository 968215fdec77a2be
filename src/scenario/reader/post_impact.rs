//! The `[post_impact]` table: what follows the capture.

use super::duration_and_step;
use super::integration;
use super::joints::Joints;
use crate::diagnostic::{NumberRule, Table};
use crate::scenario::{PostCaptureControl, PostImpact};
use crate::simulate::actuators::Actuation;

const STIFFNESS: NumberRule = NumberRule::non_negative("a proportional gain (or one per joint)", "N m/rad");
const DAMPING: NumberRule = NumberRule::non_negative("a derivative gain (or one per joint)", "N m s/rad");
const JOINT_DECAY: NumberRule =
    NumberRule::non_negative("a derivative gain of stabilisation (or one per joint)", "1/s");
const BASE_DECAY: NumberRule = NumberRule::non_negative("a gain of the base rate", "1/s");
const BASE_TORQUE: NumberRule = NumberRule::non_negative("a limit of the torque on the base", "N m");

impl PostCaptureControl {
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
