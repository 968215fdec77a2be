//! `[collect]`: what a sweep keeps beside the default outputs.

use super::super::keys::DEFAULT_SAMPLE;
use super::super::outputs::OutputGroup;
use super::super::sweep::Collect;
use crate::diagnostic::{Table, every};
use crate::scenario::Scenario;

pub(super) fn collect(root: &Table<'_>, cases: Option<u64>, scenario: &Scenario) -> Option<Collect> {
    let none = Collect { outputs: Vec::new(), series: Vec::new(), sample: DEFAULT_SAMPLE };
    root.read_or("collect", none, |value| {
        let table = value.table()?;
        let outputs = table.read_or("outputs", Vec::new(), |value| {
            every(value.items(&value.wanted())?.iter().map(|item| {
                let group = item.choice(&OutputGroup::ALL)?;
                if group == OutputGroup::MeanForces && scenario.contact.duration.is_none() {
                    item.reject("the scenario has no `contact.duration`, over which forces would be mean values");
                    return None;
                }
                Some(group)
            }))
        });
        let series = table.read_or("series", Vec::new(), |value| {
            let mut series = every(value.items(&value.wanted())?.iter().map(|item| {
                let case = item.whole()?;
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
        let sample = table.number("sample");
        Some(Collect { outputs: outputs?, series: series?, sample: sample? })
    })
}
