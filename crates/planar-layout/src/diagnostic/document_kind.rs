//! The kinds of documents that the programs read, and what is said of one in place of another.

use super::{Report, Table, read_document, reject_document};
use crate::format::TableFormat;

/// A layout, a scenario or a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DocumentKind {
    /// A robot.
    Layout,
    /// A capture study of a robot.
    Scenario,
    /// What varies in a scenario.
    Sweep,
}

impl DocumentKind {
    /// What a text is by the tables that it has; `None` of any other text.
    fn of(tree: &toml::Table) -> Option<Self> {
        let has = |key: &str| tree.contains_key(key);
        let kinds =
            [(has("approach"), Self::Scenario), (has("vary"), Self::Sweep), (has("base") && has("arm"), Self::Layout)];
        kinds.into_iter().find_map(|(is, kind)| is.then_some(kind))
    }

    /// Reads a text of this kind as [`read_document`] does; of one of another kind the report says that alone.
    ///
    /// # Errors
    /// A report of everything wrong with the content.
    pub fn read<T>(
        self,
        text: &str,
        file: &str,
        format: &'static TableFormat,
        read: impl FnOnce(&Table<'_>) -> Option<T>,
    ) -> Result<T, Report> {
        read_document(text, file, format, read).map_err(|report| self.reject_others(text, file).unwrap_or(report))
    }

    /// The report on a text that is of another kind than this one; `None` of any other text.
    fn reject_others(self, text: &str, file: &str) -> Option<Report> {
        let tree: toml::Table = text.trim_start_matches('\u{feff}').parse().ok()?;
        let found = Self::of(&tree)?;
        let message = match (self, found) {
            (Self::Scenario, Self::Layout) => {
                "this is a layout, expected a scenario that names it with `layout`: `planar-capture template scenario` \
                 prints one"
            }
            (Self::Scenario, Self::Sweep) => {
                "this is a sweep, expected the scenario that it names, or the command `planar-capture sweep`"
            }
            (Self::Sweep, Self::Scenario) => {
                "this is a scenario, expected a sweep that names it with `scenario`: `planar-capture template sweep` \
                 prints one; for one run of it: `planar-capture run`"
            }
            (Self::Sweep, Self::Layout) => {
                "this is a layout, expected a sweep of a scenario that names it with `layout`: \
                 `planar-capture template sweep` prints one"
            }
            (Self::Layout, Self::Scenario) => "this is a scenario, expected the layout that it names with `layout`",
            (Self::Layout, Self::Sweep) => "this is a sweep, expected the layout that its scenario names with `layout`",
            (Self::Layout, Self::Layout) | (Self::Scenario, Self::Scenario) | (Self::Sweep, Self::Sweep) => {
                return None;
            }
        };
        let label = match self {
            Self::Layout => "a layout has the tables `[base]` and `[[arm]]`",
            Self::Scenario => "a scenario has the table `[approach]`",
            Self::Sweep => "a sweep has tables `[[vary]]`",
        };
        let keys: Vec<&str> = tree.keys().map(String::as_str).collect();
        Some(reject_document(text, file, &keys, message, label))
    }
}
