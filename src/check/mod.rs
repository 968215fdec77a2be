//! What a layout or a scenario is and what is odd about it: `planar-capture check`.
//!
//! What is wrong the readers say. An oddity is a number that can be worked with but seldom is what was meant; each has
//! a threshold, named where it is compared, that no sensible robot comes near.

mod approach;
mod arms;
mod bodies;
mod kind;
mod link;
mod number;
mod places;
mod pose;
mod robot;
mod stiffness;
mod study;
mod targets;

use crate::diagnostic::{Report, report_warnings};
use crate::layout::Layout;
use crate::scenario::Scenario;
use kind::Kind;
use std::path::Path;
pub(crate) use targets::distance_and_most;

/// A file that can be worked with.
#[derive(Clone, Debug)]
pub struct CheckReport {
    /// What it is, in lines for the terminal.
    pub description: String,
    /// What is odd about it, and about the layout that it names.
    pub warnings: Report,
}

/// Looks at a layout or a scenario, whichever the TOML text is; the other arguments are those of [`Scenario::parse`].
///
/// # Errors
/// All that is wrong with it.
pub fn inspect(text: &str, file: &str, folder: &Path, shipped: &[(&str, &str)]) -> Result<CheckReport, Report> {
    match Kind::of(text, file)? {
        Kind::Layout => {
            let layout = Layout::parse(text, file)?;
            Ok(CheckReport { description: robot::description(&layout), warnings: layout_warnings(&layout, text, file) })
        }
        Kind::Scenario => {
            let (scenario, source) = Scenario::parse_with_source(text, file, folder, shipped)?;
            let warnings = [approach::warnings, pose::warnings, stiffness::warnings, targets::warnings];
            let warnings: Vec<_> = warnings.into_iter().flat_map(|look| look(&scenario)).collect();
            let of_layout = layout_warnings(&scenario.layout, &source.text, &source.file);
            Ok(CheckReport {
                description: study::description(&scenario),
                warnings: report_warnings(text, file, &warnings).and(of_layout),
            })
        }
    }
}

fn layout_warnings(layout: &Layout, text: &str, file: &str) -> Report {
    report_warnings(text, file, &[bodies::warnings(layout), arms::warnings(layout)].concat())
}
