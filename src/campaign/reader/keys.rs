//! The keys that vary, each tried with a value of its distribution.

use super::super::distribution::Distribution;
use crate::diagnostic::Table;
use crate::format::Step;
use crate::scenario::variation::{KeyPath, Unusable, Variation, VariedValue};
use crate::scenario::{LawFormats, Scenario, ScenarioSource};

/// Reads the paths, and sets each of them once, alone, to the median of its distribution.
pub(super) fn keys(
    tables: &[Table<'_>],
    distributions: &[Option<Distribution>],
    (scenario, source, laws): (&Scenario, &ScenarioSource, &LawFormats),
    case: &str,
) -> Option<(Vec<KeyPath>, Variation)> {
    let medians: Vec<VariedValue> = distributions
        .iter()
        .map(|known| known.as_ref().map_or(VariedValue::Number(1.0), |distribution| distribution.quantile(0.5)))
        .collect();
    let mut paths = Vec::new();
    let mut is_valid = true;
    for ((table, median), distribution) in tables.iter().zip(&medians).zip(distributions) {
        let path = table.require("key").and_then(|value| {
            let text = value.text()?;
            let refuse = |why: &str| value.reject(why);
            let path = KeyPath::parse(text).map_err(|why| refuse(&why)).ok()?;
            check_case(&path, case).map_err(|why| refuse(&why)).ok()?;
            let variation = Variation::new(scenario, source, case, &[(path.clone(), median.clone())]);
            let variation = variation.map_err(|Unusable { why, .. }| refuse(&why)).ok()?.with_laws(laws);
            // without its distribution there is no value to try
            if distribution.is_some()
                && let Err(report) = variation.scenario(std::slice::from_ref(median))
            {
                refuse(&format!("with {median}, the median of its distribution, {}", report.sentence()));
                return None;
            }
            Some(path)
        });
        is_valid &= path.is_some();
        paths.extend(path);
    }
    if !is_valid {
        return None;
    }
    let all: Vec<_> = paths.iter().cloned().zip(medians).collect();
    let variation = Variation::new(scenario, source, case, &all).map_err(|Unusable { key, why }| {
        if let Some(value) = tables[key].get("key") {
            value.reject(&why);
        }
    });
    Some((paths, variation.ok()?.with_laws(laws)))
}

/// Only one case is computed.
fn check_case(path: &KeyPath, case: &str) -> Result<(), String> {
    match &path.steps[..] {
        [Step::Key(first), Step::Named(other), ..] if first == "case" && other != case => {
            Err(format!("the sweep computes the case `{case}`, expected a key of that"))
        }
        _ => Ok(()),
    }
}
