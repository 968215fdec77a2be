//! Warnings about values that a sweep draws: what a scenario with one of them would be warned of, or refused for.

use super::number::short;
use super::{by_path, refused, scenario_findings, unlikely, warning};
use crate::campaign::Campaign;
use crate::campaign::distribution::{Distribution, Kind};
use crate::diagnostic::Warning;
use crate::registry::Robots;
use crate::scenario::variation::VariedValue;
use crate::scenario::{Scenario, Tracking};

/// Ends of the interval with 90 % of the values, and how the other values are to them.
const ENDS: [(f64, &str); 2] = [(0.05, "below"), (0.95, "above")];
/// Most warnings: a sweep of many keys is not one for each of them.
const MOST: usize = 6;
/// Most keys with whose values a path is planned: each takes some hundredths of a second.
const MOST_PATHS: usize = 20;
const NO_RESULT: &str = "such a case has no result; `min` and `max` in `distribution` keep values from there";

/// Each key alone at the ends of its values, the others at their medians.
pub(super) fn warnings(campaign: &Campaign, of_scenario: &[Warning], robots: Robots<'_>) -> Vec<Warning> {
    let varied = &campaign.sweep.varied;
    let medians: Vec<_> = varied.iter().map(|varied| varied.distribution.quantile(0.5)).collect();
    let about = |values: &[VariedValue], with_path: bool| match campaign.variation.scenario(values) {
        Ok(scenario) => findings(&scenario, with_path, robots),
        Err(report) => vec![warning("", report.sentence(), NO_RESULT)],
    };
    let mut said: Vec<Warning> = of_scenario.to_vec();
    let mut found = Vec::new();
    for new in about(&medians, true).into_iter().filter(|new| !is_said(new, &said)).collect::<Vec<_>>() {
        said.push(new.clone());
        found.push(at("vary", "with all that varies at its median", new));
    }
    for (i, varied) in varied.iter().enumerate() {
        let mut own = Vec::new();
        for (value, which) in values(&varied.distribution) {
            let mut values = medians.clone();
            values[i] = value.clone();
            let shown = value.number().map_or_else(|| value.to_string(), short);
            let unit = varied.unit();
            let with = format!("with `{}` at {}, {which}", varied.key, format!("{shown} {unit}").trim_end());
            for new in about(&values, i < MOST_PATHS) {
                // the same at the other end is said once
                if !is_said(&new, &said) && !is_said(&new, &own) {
                    own.push(new.clone());
                    found.push(at(&format!("vary[{i}].distribution"), &with, new));
                }
            }
        }
    }
    let more = found.len().saturating_sub(MOST);
    found.truncate(MOST);
    if let Some(last) = found.last_mut().filter(|_| more > 0) {
        last.help = format!("{}; {more} more of this kind", last.help);
    }
    found
}

/// All that is to be said of a scenario and its layout; of its planned path where that takes no feedback, whose steps
/// are too many to take again and again.
fn findings(scenario: &Scenario, with_path: bool, robots: Robots<'_>) -> Vec<Warning> {
    let by_end_effectors = matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. });
    let (mut warnings, refusal) =
        if with_path && !by_end_effectors { scenario_findings(scenario, robots) } else { (unlikely(scenario), None) };
    warnings.extend(by_path(&scenario.layout));
    warnings.extend(refusal.map(|error| Warning { help: NO_RESULT.to_owned(), ..refused(&error, scenario) }));
    warnings
}

/// A warning about a scenario at a key of the sweep.
fn at(key: &str, with: &str, Warning { key: of, why, help }: Warning) -> Warning {
    let of = if of.is_empty() { of } else { format!("`{of}`: ") };
    warning(key, format!("{with}, {of}{why}"), help)
}

/// Whether there is a warning about the same key; the scenario of a case has this one alone.
fn is_said(new: &Warning, said: &[Warning]) -> bool {
    let place = |key: &str| match key.strip_prefix("case[").and_then(|rest| rest.split_once(']')) {
        Some((_, rest)) => format!("case{rest}"),
        None => key.to_owned(),
    };
    said.iter().any(|said| place(&said.key) == place(&new.key))
}

/// The choices, or the ends of a continuous distribution; with the place of each among the values.
fn values(distribution: &Distribution) -> Vec<(VariedValue, String)> {
    match &distribution.kind {
        Kind::Choice(values) => {
            values.iter().take(2 * MOST).map(|value| (value.clone(), "one of its values".to_owned())).collect()
        }
        _ => ENDS
            .iter()
            .map(|(probability, side)| {
                (distribution.quantile(*probability), format!("{side} which 5 % of its values are"))
            })
            .collect(),
    }
}
