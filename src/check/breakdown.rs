//! What to say about a scenario without a result.

use super::stiffness::help_with_gains;
use crate::capture::StudyError;
use crate::diagnostic::Report;
use crate::scenario::{Scenario, Source};

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
