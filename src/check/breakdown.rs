//! What to say about a scenario without a result.

use super::stiffness::help_with_gains;
use crate::capture::StudyError;
use crate::capture::scenario_key::ScenarioKey;
use crate::diagnostic::{Report, report_error};
use crate::scenario::{Scenario, Source, Variant};

/// The error of a study at its key in the scenario, of which `source` is the text, or at the values that a `variant` of it
/// has of its own; where a phase broke down, with what would help if its gains are too high.
///
/// # Panics
/// For the scenario of another study.
#[must_use]
pub fn study_report(error: &StudyError, scenario: &Scenario, variant: Option<&Variant>, source: &Source) -> Report {
    let help = error.stopped().and_then(|(phase, _)| help_with_gains(scenario, phase));
    let Some(variant) = variant else { return error.report(scenario, &source.text, &source.file, help) };
    let ScenarioKey { path, .. } = error.key(scenario);
    let why = format!("with these values, `{path}`: {error}");
    report_error(&source.text, &source.file, (&variant.key(), "none"), &why, help)
}
