//! `distribution = { normal = { mean = 10.0, std = 2.0 }, min = 5.0 }`.

use super::super::distribution::{Distribution, Kind};
use super::super::varied_value::VariedValue;
use crate::diagnostic::{NumberRule, Table, Value, every, listing};

pub(super) const EXPECTED: &str = "a table with one of `normal`, `uniform`, `lognormal`, `triangular` and `choice`";

const KINDS: [&str; 5] = ["normal", "uniform", "lognormal", "triangular", "choice"];
const NUMBER: NumberRule = NumberRule::any("a number", "");
const SPREAD: NumberRule = NumberRule::positive("a standard deviation", "");
const POSITIVE: NumberRule = NumberRule::positive("a mean", "");

/// The least probability that bounds may leave.
const LEAST_MASS: f64 = 1e-250;

/// Reads a distribution.
pub(super) fn distribution(value: &Value<'_>) -> Option<Distribution> {
    let [normal, uniform, lognormal, triangular, choice] = KINDS;
    let table = value.table(&[normal, uniform, lognormal, triangular, choice, "min", "max"])?;
    let given: Vec<(&str, Value<'_>)> = KINDS.iter().filter_map(|kind| Some((*kind, table.get(kind)?))).collect();
    let [(kind, value_of_kind)] = &given[..] else {
        if !KINDS.iter().any(|kind| table.is_misspelt(kind)) {
            value.expected(&format!("one of {}", listing(&KINDS, "and")), None);
        }
        return None;
    };
    let kind = match *kind {
        "normal" => normal_of(&value_of_kind.table(&["mean", "std"])?),
        "lognormal" => lognormal_of(&value_of_kind.table(&["mean", "std"])?),
        "uniform" => uniform_of(value_of_kind, &value_of_kind.table(&["min", "max"])?),
        "triangular" => triangular_of(value_of_kind, &value_of_kind.table(&["min", "mode", "max"])?),
        _ => choice_of(value_of_kind),
    }?;
    if let (Kind::Choice(_), Some(bound)) = (&kind, table.get("min").or(table.get("max"))) {
        bound.reject("a choice has no bounds, expected only the values that it may take");
        return None;
    }
    let low = table.number_or("min", &NUMBER, f64::NEG_INFINITY);
    let high = table.number_or("max", &NUMBER, f64::INFINITY);
    let distribution = Distribution { kind, bounds: [low?, high?] };
    if distribution.bounds[0] >= distribution.bounds[1] || distribution.mass_within_bounds() < LEAST_MASS {
        value.reject("its bounds leave nothing of it, expected a `min` below `max` within the distribution");
        return None;
    }
    Some(distribution)
}

fn normal_of(table: &Table<'_>) -> Option<Kind> {
    let (mean, std) = (table.number("mean", &NUMBER), table.number("std", &SPREAD));
    Some(Kind::Normal { mean: mean?, std: std? })
}

fn lognormal_of(table: &Table<'_>) -> Option<Kind> {
    let (mean, std) = (table.number("mean", &POSITIVE), table.number("std", &SPREAD));
    Some(Kind::LogNormal { mean: mean?, std: std? })
}

fn uniform_of(value: &Value<'_>, table: &Table<'_>) -> Option<Kind> {
    let (min, max) = (table.number("min", &NUMBER), table.number("max", &NUMBER));
    let (min, max) = (min?, max?);
    if min >= max {
        value.reject("expected a `min` below `max`");
        return None;
    }
    Some(Kind::Uniform { min, max })
}

fn triangular_of(value: &Value<'_>, table: &Table<'_>) -> Option<Kind> {
    let [min, mode, max] = ["min", "mode", "max"].map(|key| table.number(key, &NUMBER));
    let (min, mode, max) = (min?, mode?, max?);
    if min >= max || !(min..=max).contains(&mode) {
        value.reject("expected `min` ≤ `mode` ≤ `max`, and `min` below `max`");
        return None;
    }
    Some(Kind::Triangular { min, mode, max })
}

fn choice_of(value: &Value<'_>) -> Option<Kind> {
    const VALUES: &str = "a list of at least one number, or text, or `true` and `false`";
    let items = value.items(VALUES)?;
    let values = every(items.iter().map(|item| match (item.as_str(), item.as_bool()) {
        (Some(text), _) => Some(VariedValue::Text(text.to_owned())),
        (_, Some(flag)) => Some(VariedValue::Flag(flag)),
        _ => item.number(&NUMBER).map(VariedValue::Number),
    }))?;
    let alike = values.windows(2).all(|pair| std::mem::discriminant(&pair[0]) == std::mem::discriminant(&pair[1]));
    if values.is_empty() || !alike {
        value.expected(VALUES, None);
        return None;
    }
    Some(Kind::Choice(values))
}
