//! Whether a TOML file is a layout or a scenario, by its top-level keys.

use crate::diagnostic::{Report, nearest, read_document};
use std::convert::Infallible;
use toml::de::DeTable;

/// Keys that only layouts have at their top level.
const OF_LAYOUTS: [&str; 2] = ["base", "arm"];
/// Keys that only scenarios have at their top level.
const OF_SCENARIOS: [&str; 8] = ["layout", "initial", "approach", "limits", "target", "contact", "case", "post_impact"];

/// What a file describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A robot.
    Layout,
    /// A motion of a robot.
    Scenario,
}

impl Kind {
    /// The kind with more of its keys in the text, which may be broken and its keys misspelt.
    pub(super) fn of(text: &str, file: &str) -> Result<Self, Report> {
        let (tree, errors) = DeTable::parse_recoverable(text.trim_start_matches('\u{feff}'));
        let all = || OF_LAYOUTS.into_iter().chain(OF_SCENARIOS);
        let keys: Vec<_> = tree.get_ref().keys().filter_map(|key| nearest(key.get_ref(), all())).collect();
        let of_layouts = keys.iter().filter(|key| OF_LAYOUTS.contains(key)).count();
        match 2 * of_layouts {
            // the layout's reader reports invalid TOML
            0 if keys.is_empty() && !errors.is_empty() => Ok(Self::Layout),
            0 if keys.is_empty() => Err(neither(text, file)),
            twice if twice >= keys.len() => Ok(Self::Layout),
            _ => Ok(Self::Scenario),
        }
    }
}

fn neither(text: &str, file: &str) -> Report {
    let known: Vec<_> = ["name"].into_iter().chain(OF_LAYOUTS).chain(OF_SCENARIOS).collect();
    let Err(report) = read_document::<Infallible>(text, file, &known, |root| {
        let message = "this is neither a layout, which has `name`, `[base]` and `[[arm]]`, nor a scenario, which has \
                       `name`, `layout`, `[initial]` and `[approach]`";
        root.reject(message, "none of these keys is here");
        None
    });
    report
}
