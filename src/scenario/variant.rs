//! Cases with values of their own: each is a scenario of this one case.

use super::variation::VariedValue;
use super::{Scenario, Source};
use crate::diagnostic::Warning;
use std::fmt::Write;

/// A case that has other values at keys of the scenario or of its layout, `set`, and with them an approach of its own.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Variant {
    /// Paths, as sweeps name them, with their values.
    pub set: Vec<(String, VariedValue)>,
    /// The scenario with these values and this case alone; it has the scenario's name.
    pub scenario: Scenario,
    /// The texts of that scenario and its layout, as files that have the values would be.
    pub texts: [String; 2],
}

impl Variant {
    /// The name of its case.
    #[must_use]
    pub fn name(&self) -> &str {
        self.scenario.cases.first().map_or("", |case| &case.name)
    }

    /// The index of its `[[case]]` in the file.
    #[must_use]
    pub fn index(&self) -> usize {
        self.scenario.cases.first().map_or(0, |case| case.index)
    }

    /// `layout.base.mass = 480.0, approach.duration = 12.0`.
    #[must_use]
    pub fn values(&self) -> String {
        let mut text = String::new();
        for (i, (path, value)) in self.set.iter().enumerate() {
            let comma = if i > 0 { ", " } else { "" };
            write!(text, "{comma}{path} = {value}").expect("writing to a String does not fail");
        }
        text
    }

    /// The path of its `set` in the file.
    #[must_use]
    pub fn key(&self) -> String {
        format!("case[{}].set", self.index())
    }

    /// What is to be said of the key of its scenario at `key` in the file, which has the value that others have there.
    #[must_use]
    pub fn at_its_key(&self, warning: Warning) -> Warning {
        if warning.key.starts_with("case[") {
            return warning;
        }
        Warning { key: self.key(), why: format!("with these values, `{}`: {}", warning.key, warning.why), ..warning }
    }

    /// What its scenario and layout would have been read from: texts with the values.
    #[must_use]
    pub fn sources(&self, [scenario, layout]: [&Source; 2]) -> super::ScenarioSource {
        let source = |text: &String, of: &Source| Source { text: text.clone(), file: of.file.clone() };
        super::ScenarioSource { scenario: source(&self.texts[0], scenario), layout: source(&self.texts[1], layout) }
    }
}
