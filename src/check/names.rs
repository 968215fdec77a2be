//! Warnings about names that commands take for options.

use super::warning;
use crate::diagnostic::Warning;
use crate::scenario::Scenario;

/// Names of a scenario and its cases that begin with a hyphen: results are files of these names.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let of_cases = scenario.cases.iter().filter(|case| case.name != scenario.name);
    let of_cases = of_cases.map(|case| (format!("case[{}].name", case.index), &case.name));
    let names = std::iter::once(("name".to_owned(), &scenario.name)).chain(of_cases);
    let why = "files and folders of results have this name, and commands take it for an option";
    names
        .filter(|(_, name)| name.starts_with('-'))
        .map(|(key, _)| warning(key, why, "begin with a letter or a digit"))
        .collect()
}
