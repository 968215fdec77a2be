//! What to say about a scenario without a result.

use super::stiffness::help_with_gains;
use crate::capture::StudyError;
use crate::capture::scenario_key::ScenarioKey;
use crate::diagnostic::{Report, report_error};
use crate::scenario::{Scenario, Source, Variant};

/// The error of a study at its key in the scenario, of which `source` is the text; where a phase broke down, with what
/// would help if its gains are too high.
///
/// # Panics
/// For the scenario of another study.
#[must_use]
pub fn study_report(error: &StudyError, scenario: &Scenario, source: &Source) -> Report {
    let help = error.stopped().and_then(|(phase, _)| help_with_gains(scenario, phase));
    error.report(scenario, &source.text, &source.file, help)
}

/// The same of a case with values of its own, at these values.
#[must_use]
pub fn variant_report(error: &StudyError, variant: &Variant, source: &Source) -> Report {
    let help = error.stopped().and_then(|(phase, _)| help_with_gains(&variant.scenario, phase));
    let ScenarioKey { path, .. } = error.key(&variant.scenario);
    let why = format!("with these values, `{path}`: {error}");
    report_error(&source.text, &source.file, (&variant.key(), "none"), &why, help)
}
