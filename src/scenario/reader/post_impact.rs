//! The `[post_impact]` table.

use super::actuation::actuation;
use super::integration::integration;
use super::joints::{DERIVATIVE_GAIN, Joints, PROPORTIONAL_GAIN};
use super::{duration_and_step, read_or, reject_keys};
use crate::diagnostic::{NumberRule, Table, every};
use crate::scenario::{PostCaptureControl, PostImpact};
use crate::simulate::actuators::Actuation;

const JOINT_DECAY: NumberRule =
    NumberRule::non_negative("a derivative gain of stabilisation (or one per joint)", "1/s");
const BASE_DECAY: NumberRule = NumberRule::non_negative("a gain of the base rate", "1/s");
const BASE_TORQUE: NumberRule = NumberRule::non_negative("a limit of the torque on the base", "N m");

pub(super) const KEYS: &[&str] = &[
    "duration",
    "step",
    "integrator",
    "tolerance",
    "coordinates",
    "control",
    "proportional_gain",
    "derivative_gain",
    "base_gain",
    "base_torque_limit",
    "torque_limits",
    "sample_time",
];

pub(super) fn post_impact(table: &Table<'_>, joints: &Joints<'_>) -> Option<PostImpact> {
    let times = duration_and_step(table);
    let control = control(table, joints);
    let actuation = match control {
        Some(PostCaptureControl::None) => Some(Actuation::default()),
        _ => actuation(table, times, joints),
    };
    let integration = integration(table);
    let (duration, step) = times?;
    Some(PostImpact { duration, step, control: control?, actuation: actuation?, integration: integration? })
}

/// The laws with their default gains; the default law first.
fn laws(joints: &Joints<'_>) -> [PostCaptureControl; 4] {
    [
        PostCaptureControl::None,
        PostCaptureControl::Hold { proportional_gain: joints.repeat(49.0), derivative_gain: joints.repeat(14.0) },
        PostCaptureControl::Damping { derivative_gain: joints.repeat(7.0) },
        PostCaptureControl::Stabilise { derivative_gain: joints.repeat(0.5), base_gain: 0.5, base_torque_limit: None },
    ]
}

/// The law of the table, with the table's gains in place of the defaults.
fn control(table: &Table<'_>, joints: &Joints<'_>) -> Option<PostCaptureControl> {
    let laws = laws(joints);
    let mut law =
        read_or(table, "control", &laws[0], |value| value.choice(&laws.each_ref().map(|law| (law.name(), law))))?
            .clone();
    match &mut law {
        PostCaptureControl::None => reject_keys(
            table,
            &["proportional_gain", "derivative_gain", "base_gain", "base_torque_limit", "torque_limits", "sample_time"],
            "without control there are no torques, expected `control` `hold`, `damping` or `stabilise` with it",
        ),
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            let why = "only `control = \"stabilise\"` acts on the base";
            reject_keys(table, &["base_gain", "base_torque_limit"], why);
            every([
                joints.read_gain(table, "proportional_gain", &PROPORTIONAL_GAIN, proportional_gain),
                joints.read_gain(table, "derivative_gain", &DERIVATIVE_GAIN, derivative_gain),
            ])?;
        }
        PostCaptureControl::Damping { derivative_gain } => {
            let why = "damping has a derivative_gain alone, expected `control = \"hold\"` or `\"stabilise\"` with it";
            reject_keys(table, &["proportional_gain", "base_gain", "base_torque_limit"], why);
            joints.read_gain(table, "derivative_gain", &DERIVATIVE_GAIN, derivative_gain)?;
        }
        PostCaptureControl::Stabilise { derivative_gain, base_gain, base_torque_limit } => {
            let why = "stabilisation wants no angles, expected `control = \"hold\"` with it";
            reject_keys(table, &["proportional_gain"], why);
            let joint_gain = joints.read_gain(table, "derivative_gain", &JOINT_DECAY, derivative_gain);
            let gain = table.number_or("base_gain", &BASE_DECAY, *base_gain);
            let limit = read_or(table, "base_torque_limit", None, |value| value.number(&BASE_TORQUE).map(Some));
            joint_gain?;
            (*base_gain, *base_torque_limit) = (gain?, limit?);
        }
    }
    Some(law)
}
