//! The description of a sweep: what is computed how many times, and what varies.

use super::number::short;
use crate::campaign::Campaign;
use crate::campaign::distribution::{Distribution, Kind};
use crate::campaign::outputs::OutputGroup;
use crate::campaign::sweep::Collect;
use crate::plain_text::count;
use std::fmt::{self, Write};

pub(super) fn description(campaign: &Campaign) -> String {
    let mut text = String::new();
    write(&mut text, campaign).expect("writing to a String does not fail");
    text
}

fn write(out: &mut String, campaign: &Campaign) -> fmt::Result {
    let (sweep, scenario) = (&campaign.sweep, &campaign.scenario);
    writeln!(out, "{}: a sweep\n", sweep.name)?;
    writeln!(out, "  scenario            {}, its case {}", scenario.name, sweep.case)?;
    writeln!(out, "  robot               {}", scenario.layout.name)?;
    let blocks = usize::try_from(sweep.blocks()).unwrap_or(usize::MAX);
    writeln!(out, "  cases               {}, {}, in {}", sweep.cases, sweep.sampling.name(), count(blocks, "file"))?;
    for varied in &sweep.varied {
        writeln!(out, "  varies              {}: {}", varied.label(), values(&varied.distribution))?;
    }
    for ([one, other], rank) in sweep.correlations() {
        writeln!(out, "  correlated          {one} with {other}: rank correlation {}", short(rank))?;
    }
    let Collect { outputs, series, sample } = &sweep.collect;
    let names = OutputGroup::ALL.iter().filter(|(_, group)| outputs.contains(group)).map(|(name, _)| *name);
    let names = names.collect::<Vec<_>>().join(", ");
    if !names.is_empty() {
        writeln!(out, "  outputs             the default ones, {names}")?;
    }
    if !series.is_empty() {
        let cases = series.iter().map(u64::to_string).collect::<Vec<_>>().join(", ");
        let of = if series.len() == 1 { "case" } else { "cases" };
        writeln!(out, "  time series         of {of} {cases}, every {} s", short(*sample))?;
    }
    Ok(())
}

/// Its choices, or some of its quantiles.
fn values(distribution: &Distribution) -> String {
    if let Kind::Choice(values) = &distribution.kind {
        return values.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    }
    let at = |probability| distribution.quantile(probability).number().map_or_else(String::new, short);
    format!("{} ({} to {} in 90 % of the cases)", at(0.5), at(0.05), at(0.95))
}
