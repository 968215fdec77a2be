//! Values at keys that give no scenario, and which of them are to blame.

use super::{CaseTexts, KeyPath, Unusable, Variation, VariedValue};
use crate::diagnostic::Report;
use crate::scenario::{LawFormats, Scenario, ScenarioSource};

/// Why values at keys give no scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refused {
    /// Keys that cannot vary, or whose values are not valid, each with its reason.
    Keys(Vec<Unusable>),
    /// Each value is valid alone, but not all together.
    Together(String),
    /// The scenario of this case is not valid without them, too.
    Without(String),
}

impl Variation {
    /// The scenario of one case with these values at keys, and its texts.
    ///
    /// # Errors
    /// Which keys are to blame. Reasons are without places: the text that has the values is no file.
    ///
    /// # Panics
    /// See [`new`](Self::new).
    pub fn apply(
        scenario: &Scenario,
        source: &ScenarioSource,
        case: &str,
        laws: &LawFormats,
        keys: &[(KeyPath, VariedValue)],
    ) -> Result<(Scenario, CaseTexts), Refused> {
        let read = |keys: &[(KeyPath, VariedValue)]| -> Result<_, Refusal> {
            let variation = Self::new(scenario, source, case, keys)?.with_laws(laws);
            let values: Vec<_> = keys.iter().map(|(_, value)| value.clone()).collect();
            Ok((variation.scenario(&values)?, variation.texts(&values)))
        };
        let together = match read(keys) {
            Ok(read) => return Ok(read),
            Err(Refusal::Key(unusable)) => return Err(Refused::Keys(vec![unusable])),
            Err(Refusal::Values(report)) => report.sentence(),
        };
        if let Err(Refusal::Values(report)) = read(&[]) {
            return Err(Refused::Without(report.sentence()));
        }
        let alone = keys.chunks(1).enumerate().filter_map(|(key, one)| match read(one) {
            Err(Refusal::Values(report)) => Some(Unusable { key, why: report.sentence() }),
            _ => None,
        });
        let alone: Vec<_> = alone.collect();
        Err(if alone.is_empty() { Refused::Together(together) } else { Refused::Keys(alone) })
    }
}

enum Refusal {
    Key(Unusable),
    Values(Report),
}

impl From<Unusable> for Refusal {
    fn from(unusable: Unusable) -> Self {
        Self::Key(unusable)
    }
}

impl From<Report> for Refusal {
    fn from(report: Report) -> Self {
        Self::Values(report)
    }
}
