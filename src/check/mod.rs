//! Descriptions of layouts and scenarios and warnings about unlikely numbers in them: `planar-capture check`.
//!
//! Errors are found by the readers. A warning is about a valid number that is probably not what was meant; each has a
//! threshold, a named constant, that no realistic robot comes near.

mod approach;
mod arms;
mod bodies;
mod clearance;
mod kind;
mod link;
mod names;
mod number;
mod pose;
mod robot;
mod stiffness;
mod study;
mod targets;

use crate::diagnostic::{Report, Warning, report_warnings};
use crate::layout::Layout;
use crate::registry::Robots;
use crate::scenario::Scenario;
use kind::Kind;
use std::path::Path;
pub use stiffness::help_with_gains;

/// A valid file.
#[derive(Clone, Debug)]
pub struct CheckReport {
    /// Lines for the terminal.
    pub description: String,
    /// About the file, and about the layout that it names.
    pub warnings: Report,
    /// Why every run of the scenario is refused: its values are valid one by one, but there is no such motion.
    pub refusal: Option<Report>,
}

/// Checks TOML text of a layout or a scenario; the other arguments are those of [`Scenario::parse`].
///
/// # Errors
/// Those of [`Layout::parse`] and [`Scenario::parse`].
pub fn inspect(text: &str, file: &str, folder: &Path, shipped: &[(&str, &str)]) -> Result<CheckReport, Report> {
    inspect_with(text, file, folder, shipped, Robots::SHIPPED)
}

/// As [`inspect`], in a program that has code for these robots.
///
/// # Errors
/// Those of [`inspect`].
pub fn inspect_with(
    text: &str,
    file: &str,
    folder: &Path,
    shipped: &[(&str, &str)],
    robots: Robots<'_>,
) -> Result<CheckReport, Report> {
    match Kind::of(text, file)? {
        Kind::Layout => {
            let layout = Layout::parse(text, file)?;
            Ok(CheckReport {
                description: robot::description(&layout, robots),
                warnings: layout_warnings(&layout, text, file),
                refusal: None,
            })
        }
        Kind::Scenario => {
            let (scenario, source) = Scenario::parse_with_source(text, file, folder, shipped)?;
            let warnings =
                [names::warnings, approach::warnings, pose::warnings, stiffness::warnings, targets::warnings];
            let mut warnings: Vec<_> = warnings.into_iter().flat_map(|check| check(&scenario)).collect();
            let refusal = match clearance::warnings(&scenario, robots) {
                Ok(found) => {
                    warnings.extend(found);
                    None
                }
                Err(error) => Some(error.report(&scenario, text, file, None)),
            };
            let of_layout = layout_warnings(&scenario.layout, &source.text, &source.file);
            Ok(CheckReport {
                description: study::description(&scenario, robots),
                warnings: report_warnings(text, file, &warnings).and(of_layout),
                refusal,
            })
        }
    }
}

fn layout_warnings(layout: &Layout, text: &str, file: &str) -> Report {
    report_warnings(text, file, &[bodies::warnings(layout), arms::warnings(layout)].concat())
}

/// A warning about the value of a key, with the reason and the expected value.
fn warning(key: impl Into<String>, why: impl Into<String>, help: impl Into<String>) -> Warning {
    Warning { key: key.into(), why: why.into(), help: help.into() }
}
