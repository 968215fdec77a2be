//! Whether a TOML file is a layout or a scenario, by its top-level keys.

use crate::diagnostic::{Report, nearest, reject_document};
use crate::{layout, scenario};
use toml::de::DeTable;

/// The key that both have at their top level.
const OF_BOTH: &str = "name";

/// Keys that only layouts, and that only scenarios, have at their top level.
fn keys() -> [Vec<&'static str>; 2] {
    [layout::FORMAT.names(), scenario::FORMAT.names()]
        .map(|names| names.into_iter().filter(|name| *name != OF_BOTH).collect())
}

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
        let known @ [layouts, _] = &keys();
        let meant = |key: &str| nearest(key, known.iter().flatten().copied());
        let keys: Vec<_> = tree.get_ref().keys().filter_map(|key| meant(key.get_ref())).collect();
        let of_layouts = keys.iter().filter(|key| layouts.contains(key)).count();
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
    let known = [vec![OF_BOTH], keys().concat()].concat();
    let message = "this is neither a layout, which has `name`, `[base]` and `[[arm]]`, nor a scenario, which has \
                   `name`, `layout`, `[initial]` and `[approach]`";
    reject_document(text, file, &known, message, "none of these keys is here")
}
