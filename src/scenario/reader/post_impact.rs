//! The `[post_impact]` table.

use super::actuation::actuation;
use super::duration_and_step;
use super::integration::integration;
use super::joints::Joints;
use crate::diagnostic::Table;
use crate::scenario::{PostCaptureControl, PostImpact};
use crate::simulate::actuators::Actuation;

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

/// The law of the table with its gains.
fn control(table: &Table<'_>, joints: &Joints<'_>) -> Option<PostCaptureControl> {
    let laws: Vec<_> = PostCaptureControl::LAWS.iter().map(|law| (law.name(), law)).collect();
    let law = table.choice("control", &laws)?;
    table.reject_keys_without(
        "control",
        law.name(),
        match law {
            PostCaptureControl::None => {
                "without control there are no torques, expected `control` `hold`, `damping` or `stabilise` with it"
            }
            PostCaptureControl::Hold { .. } => "only `control = \"stabilise\"` acts on the base",
            PostCaptureControl::Damping { .. } => {
                "damping has a derivative_gain alone, expected `control = \"hold\"` or `\"stabilise\"` with it"
            }
            PostCaptureControl::Stabilise { .. } => {
                "stabilisation wants no angles, expected `control = \"hold\"` with it"
            }
        },
    );
    let gain = |key| joints.gain(table, table.entry_with(key, "control", law.name()));
    Some(match law {
        PostCaptureControl::None => PostCaptureControl::None,
        PostCaptureControl::Hold { .. } => {
            let [proportional_gain, derivative_gain] = ["proportional_gain", "derivative_gain"].map(gain);
            PostCaptureControl::Hold { proportional_gain: proportional_gain?, derivative_gain: derivative_gain? }
        }
        PostCaptureControl::Damping { .. } => PostCaptureControl::Damping { derivative_gain: gain("derivative_gain")? },
        PostCaptureControl::Stabilise { .. } => {
            let derivative_gain = gain("derivative_gain");
            let base_gain = table.number("base_gain");
            let base_torque_limit = table.optional_number("base_torque_limit");
            PostCaptureControl::Stabilise {
                derivative_gain: derivative_gain?,
                base_gain: base_gain?,
                base_torque_limit: base_torque_limit?,
            }
        }
    })
}
