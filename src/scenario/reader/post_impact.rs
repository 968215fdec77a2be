//! The `[post_impact]` table.

use super::actuation::actuation;
use super::duration_and_step;
use super::integration::integration;
use super::joints::Joints;
use super::own_law::law_numbers;
use crate::diagnostic::Table;
use crate::scenario::{LawFormat, LawNumbers, PostCaptureControl, PostImpact};
use crate::simulate::actuators::Actuation;

pub(super) fn post_impact(table: &Table<'_>, joints: &Joints<'_>, own: &[LawFormat]) -> Option<PostImpact> {
    let times = duration_and_step(table);
    let control = control(table, joints, own);
    let actuation = match control {
        Some(PostCaptureControl::None) => Some(Actuation::default()),
        _ => actuation(table, times, joints),
    };
    let integration = integration(table);
    let (duration, step) = times?;
    Some(PostImpact { duration, step, control: control?, actuation: actuation?, integration: integration? })
}

/// Numbers that shipped laws have.
const OF_SHIPPED_LAWS: [&str; 4] = ["proportional_gain", "derivative_gain", "base_gain", "base_torque_limit"];

/// The law of the table with its numbers.
fn control(table: &Table<'_>, joints: &Joints<'_>, own: &[LawFormat]) -> Option<PostCaptureControl> {
    let unmade = own.iter().map(|law| PostCaptureControl::Own { name: law.name, numbers: LawNumbers::default() });
    let unmade: Vec<_> = unmade.collect();
    let laws: Vec<_> = PostCaptureControl::LAWS.iter().chain(&unmade).map(|law| (law.name(), law)).collect();
    let law = table.choice("control", &laws)?;
    let why_not = match law {
        PostCaptureControl::None => {
            Some("without control there are no torques, expected `control` `hold`, `damping` or `stabilise` with it")
        }
        PostCaptureControl::Hold { .. } => Some("only `control = \"stabilise\"` acts on the base"),
        PostCaptureControl::Damping { .. } => Some(
            "damping has a derivative_gain alone: `control = \"hold\"` holds angles, `\"stabilise\"` acts on the base",
        ),
        PostCaptureControl::Stabilise { .. } => {
            Some("stabilisation wants no angles, expected `control = \"hold\"` with it")
        }
        PostCaptureControl::Own { .. } => None,
    };
    if let Some(why) = why_not {
        table.reject_keys_without("control", law.name(), why);
        table.reject_keys(&["law"], "only `control` with the name of a law of the program's own has it");
    } else {
        table.reject_keys(&OF_SHIPPED_LAWS, "the numbers of a law of one's own are in `[post_impact.law]`");
    }
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
        PostCaptureControl::Own { name, .. } => {
            PostCaptureControl::Own { name, numbers: law_numbers(table, "post_impact.law", name, own)? }
        }
    })
}
