//! `distribution = { normal = { mean = 10.0, std = 2.0 }, min = 5.0 }`.

use super::super::distribution::{Distribution, Kind};
use super::super::keys::DISTRIBUTION;
use crate::diagnostic::{Table, Value, every, listing};
use crate::scenario::variation::VariedValue;
use std::ops::RangeInclusive;

/// The least probability that bounds may leave.
const LEAST_MASS: f64 = 1e-250;

/// Standard deviations of a lognormal variable, relative to its mean, whose squares are numbers other than 0.
const RATIOS: RangeInclusive<f64> = 1e-150..=1e150;

/// Reads a distribution.
pub(super) fn distribution(value: &Value<'_>) -> Option<Distribution> {
    let table = value.table()?;
    let kinds = DISTRIBUTION.one_of;
    let given: Vec<&str> = kinds.iter().copied().filter(|kind| table.get(kind).is_some()).collect();
    let [kind] = given[..] else {
        if !kinds.iter().any(|kind| table.is_misspelt(kind)) {
            value.expected(&format!("one of {}", listing(kinds, "and")), None);
        }
        return None;
    };
    let of_kind = table.get(kind)?;
    let kind = match kind {
        "normal" => normal(&of_kind.table()?),
        "lognormal" => lognormal(&of_kind, &of_kind.table()?),
        "uniform" => uniform(&of_kind, &of_kind.table()?),
        "triangular" => triangular(&of_kind, &of_kind.table()?),
        _ => choice(&of_kind),
    }?;
    if let (Kind::Choice(_), Some(bound)) = (&kind, table.get("min").or(table.get("max"))) {
        bound.reject("a choice has no bounds, expected only the values that it may take");
        return None;
    }
    let (low, high) = (table.optional_number("min"), table.optional_number("max"));
    let bounds = [low?.unwrap_or(f64::NEG_INFINITY), high?.unwrap_or(f64::INFINITY)];
    let distribution = Distribution { kind, bounds };
    if distribution.bounds[0] >= distribution.bounds[1] || distribution.mass_within_bounds() < LEAST_MASS {
        value.reject("its bounds leave nothing of it, expected a `min` below `max` within the distribution");
        return None;
    }
    Some(distribution)
}

fn normal(table: &Table<'_>) -> Option<Kind> {
    let (mean, std) = (table.number("mean"), table.number("std"));
    Some(Kind::Normal { mean: mean?, std: std? })
}

fn lognormal(value: &Value<'_>, table: &Table<'_>) -> Option<Kind> {
    let (mean, std) = (table.number("mean"), table.number("std"));
    let (mean, std) = (mean?, std?);
    if !RATIOS.contains(&(std / mean)) {
        let [least, most] = [RATIOS.start(), RATIOS.end()];
        value.reject(&format!(
            "a `std` of {std:e} with a `mean` of {mean:e} is beyond double precision, expected a `std` of {least:e} to \
             {most:e} times the `mean`"
        ));
        return None;
    }
    Some(Kind::LogNormal { mean, std })
}

fn uniform(value: &Value<'_>, table: &Table<'_>) -> Option<Kind> {
    let (min, max) = (table.number("min"), table.number("max"));
    let (min, max) = (min?, max?);
    if min >= max {
        value.reject("expected a `min` below `max`");
        return None;
    }
    Some(Kind::Uniform { min, max })
}

fn triangular(value: &Value<'_>, table: &Table<'_>) -> Option<Kind> {
    let [min, mode, max] = ["min", "mode", "max"].map(|key| table.number(key));
    let (min, mode, max) = (min?, mode?, max?);
    if min >= max || !(min..=max).contains(&mode) {
        value.reject("expected `min` ≤ `mode` ≤ `max`, and `min` below `max`");
        return None;
    }
    Some(Kind::Triangular { min, mode, max })
}

fn choice(value: &Value<'_>) -> Option<Kind> {
    const VALUES: &str = "a list of at least one number, or text, or `true` and `false`";
    let items = value.items(VALUES)?;
    let values = every(items.iter().map(|item| match (item.as_str(), item.as_bool()) {
        (Some(text), _) => Some(VariedValue::Text(text.to_owned())),
        (_, Some(flag)) => Some(VariedValue::Flag(flag)),
        _ => item.number().map(VariedValue::Number),
    }))?;
    let alike = values.windows(2).all(|pair| std::mem::discriminant(&pair[0]) == std::mem::discriminant(&pair[1]));
    if values.is_empty() || !alike {
        value.expected(VALUES, None);
        return None;
    }
    Some(Kind::Choice(values))
}
