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

#[cfg(test)]
mod tests {
    use crate::diagnostic::Warning;
    use crate::registry;
    use crate::scenario::Scenario;

    const TEXT: &str = "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.4, -0.9]\n[approach]\n\
                        duration = 1.0\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [0.4, -0.9]\n[[target]]\n\
                        name = \"disc\"\narm = \"arm1\"\nmass = 1.0\ninertia = 1.0\ncontact = [0.0, 0.5]\nradius = 0.5\n\
                        [[case]]\nname = \"c\"\nset = { \"approach.duration\" = 2.0 }\n[[case]]\nname = \"a\"\n[[case]]\n\
                        name = \"b\"\nset = { \"approach.duration\" = 3.0, \"target.disc.mass\" = 4.0 }\n[post_impact]\n\
                        duration = 1.0\n";

    /// Cases are in the order of the file, those with values of their own too; what is said of a key that a case sets is said at
    /// its `set`, and what is said of the case itself stays there.
    #[test]
    fn cases_with_values_stay_in_their_places() {
        let scenario =
            Scenario::parse(TEXT, "it.toml", "".as_ref(), registry::SHIPPED).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(scenario.case_names(), ["c", "a", "b"]);
        let b = scenario.variant("b").expect("values");
        assert_eq!((b.index(), b.values().as_str()), (2, "approach.duration = 3.0, target.disc.mass = 4.0"));
        assert!(scenario.variant("a").is_none());
        let at = |key: &str| {
            let warning = Warning { key: key.to_owned(), why: "it is odd".to_owned(), help: "none".to_owned() };
            let Warning { key, why, .. } = b.at_its_key(warning);
            (key, why)
        };
        let said = "with these values, `approach.duration`: it is odd".to_owned();
        assert_eq!(at("approach.duration"), ("case[2].set".to_owned(), said));
        assert_eq!(at("case[2].target_twists"), ("case[2].target_twists".to_owned(), "it is odd".to_owned()));
    }
}
