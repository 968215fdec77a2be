//! The choice of some cases of a scenario.

use super::CommandError;
use crate::scenario::Scenario;

/// Keeps the cases of these names alone; all of them where there is no name.
pub fn retain(scenario: &mut Scenario, wanted: &[String], file: &str) -> Result<(), CommandError> {
    if wanted.is_empty() {
        return Ok(());
    }
    let names = scenario.case_names();
    if let Some(unknown) = wanted.iter().find(|wanted| !names.contains(&wanted.as_str())) {
        let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
        let message = format!("{file} has no case `{unknown}`, expected one of {}", names.join(", "));
        return Err(CommandError::Usage(message));
    }
    scenario.cases.retain(|case| wanted.contains(&case.name));
    scenario.variants.retain(|variant| wanted.iter().any(|name| name == variant.name()));
    Ok(())
}
