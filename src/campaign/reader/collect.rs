//! `[collect]`: what a sweep keeps beside the default outputs.

use super::super::outputs::OutputGroup;
use super::super::sweep::Collect;
use super::{read_or, whole};
use crate::diagnostic::{NumberRule, Table, every};
use crate::scenario::Scenario;

const SAMPLE: NumberRule = NumberRule::positive("a time between rows", "s");
const DEFAULT_SAMPLE: f64 = 0.05;
const CASE: NumberRule = NumberRule::non_negative("the index of a case", "").at_most(super::MOST_CASES);

pub(super) fn collect(root: &Table<'_>, cases: Option<u64>, scenario: &Scenario) -> Option<Collect> {
    let none = Collect { outputs: Vec::new(), series: Vec::new(), sample: DEFAULT_SAMPLE };
    read_or(root, "collect", none, |value| {
        let table = value.table(&["outputs", "series", "sample"])?;
        let outputs = read_or(&table, "outputs", Vec::new(), |value| {
            let names = "a list of names of outputs";
            every(value.items(names)?.iter().map(|item| {
                let group = item.choice(&OutputGroup::ALL)?;
                if group == OutputGroup::MeanForces && scenario.contact.duration.is_none() {
                    item.reject("the scenario has no `contact.duration`, over which forces would be mean values");
                    return None;
                }
                Some(group)
            }))
        });
        let series = read_or(&table, "series", Vec::new(), |value| {
            let mut series = every(value.items("a list of indices of cases")?.iter().map(|item| {
                let case = whole(item, &CASE)?;
                if cases.is_some_and(|cases| case >= cases) {
                    item.reject(&format!("there are {} cases, counted from 0", cases.unwrap_or_default()));
                    return None;
                }
                Some(case)
            }))?;
            series.sort_unstable();
            series.dedup();
            Some(series)
        });
        let sample = table.number_or("sample", &SAMPLE, DEFAULT_SAMPLE);
        Some(Collect { outputs: outputs?, series: series?, sample: sample? })
    })
}
