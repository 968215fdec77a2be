//! What to say about a scenario without a result.

use super::stiffness::help_with_gains;
use crate::capture::StudyError;
use crate::capture::scenario_key::ScenarioKey;
use crate::diagnostic::{Report, report_error, report_without_place};
use crate::scenario::{Scenario, Source, Variant};

/// The error of a study at its key in the scenario, of which `source` is the text, or at the values that a `variant` of it
/// has of its own; where a phase broke down, with what would help if its gains are too high. No key is at fault where the
/// system has no place for a path.
///
/// # Panics
/// For the scenario of another study.
#[must_use]
pub fn study_report(error: &StudyError, scenario: &Scenario, variant: Option<&Variant>, source: &Source) -> Report {
    if let StudyError::PathFile { .. } = error {
        let help =
            "set `TMPDIR` to a folder that can be written to and has space; a shorter phase needs less".to_owned();
        return report_without_place(error.to_string(), help);
    }
    let help = error.stopped().and_then(|(phase, _)| help_with_gains(scenario, phase));
    let Some(variant) = variant else { return error.report(scenario, &source.text, &source.file, help) };
    let ScenarioKey { path, .. } = error.key(scenario);
    let why = format!("with these values, `{path}`: {error}");
    report_error(&source.text, &source.file, (&variant.key(), "none"), &why, help)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::registry;
    use std::path::Path;

    /// Where the system has no place for a path, no key of the scenario is at fault.
    #[test]
    fn no_key_is_named_where_the_system_has_no_place() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
        let file = folder.join("raina_shah_2017.toml");
        let (scenario, source) = Scenario::read_with_source(&file, registry::SHIPPED).expect("a scenario");
        let (case, reason) = ("case1".to_owned(), "no space left".to_owned());
        let text = study_report(&StudyError::PathFile { case, reason }, &scenario, None, &source.scenario).to_string();
        assert!(
            text.starts_with("error: case `case1`: the path of a long phase") && text.contains("`TMPDIR`"),
            "{text}"
        );
        assert!(!text.contains("-->"), "{text}");
    }
}
