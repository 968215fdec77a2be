//! One HTML file with an animation and plots of all cases of a run, those with values of their own too. It contains its styles,
//! programs and data and opens without a network.
//!
//! uPlot (MIT) draws the plots; the file contains its text and licence.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::html_report::write_report;
//! use planar_capture::output::{run_manifest::RunManifest, study_part::StudyPart};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//! use std::borrow::Cow;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let manifest = RunManifest::new(&scenario, source, "planar-capture run".to_owned());
//! let study = Cow::Owned(study);
//! let part = StudyPart { scenario: &scenario, variant: None, dynamics: "generated", study, manifest: manifest.clone() };
//! let mut page = Vec::new();
//! write_report(&scenario, &[part], &manifest, &mut page)?;
//! let page = String::from_utf8(page)?;
//! assert!(page.contains("<title>redysim_single_arm_3r"));
//! assert!(!page.contains("<script src") && !page.contains("stylesheet")); // all that it needs is in it
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contacts;
mod data;

use crate::output::markup;
use crate::output::run_manifest::RunManifest;
use crate::output::study_part::StudyPart;
use crate::scenario::Scenario;
use std::io::{self, Write};

const PAGE: &str = include_str!("page.html");

/// (placeholder in the page, text that replaces it).
const PARTS: [(&str, &str); 15] = [
    ("/*uplot.css*/", include_str!("uPlot.min.css")),
    ("/*page.css*/", include_str!("page.css")),
    ("/*uplot.licence*/", include_str!("uPlot.LICENSE")),
    ("/*uplot.js*/", include_str!("uPlot.iife.min.js")),
    ("/*motion.js*/", include_str!("motion.js")),
    ("/*theme.js*/", include_str!("theme.js")),
    ("/*pen.js*/", include_str!("pen.js")),
    ("/*svg.js*/", include_str!("svg.js")),
    ("/*view.js*/", include_str!("view.js")),
    ("/*arrows.js*/", include_str!("arrows.js")),
    ("/*scene.js*/", include_str!("scene.js")),
    ("/*plots.js*/", include_str!("plots.js")),
    ("/*contacts.js*/", include_str!("contacts.js")),
    ("/*address.js*/", include_str!("address.js")),
    ("/*page.js*/", include_str!("page.js")),
];

/// Writes the page of all parts of a scenario's run, of which there is one at least; the manifest is that of the run.
///
/// # Errors
/// Those of the writer.
pub fn write_report(
    scenario: &Scenario,
    parts: &[StudyPart<'_>],
    manifest: &RunManifest,
    mut to: impl Write,
) -> io::Result<()> {
    let mut page = PAGE.replace("<!--title-->", &markup::text(&scenario.name));
    for (placeholder, text) in PARTS {
        page = page.replace(placeholder, text.trim_end());
    }
    // `</` would end the script element, and after `<!--` a `<script` would let nothing end it
    let data = serde_json::to_string(&data::data(scenario, parts, manifest))?.replace('<', "\\u003c");
    to.write_all(page.replacen("/*data*/", &data, 1).as_bytes())
}

/// Rounded to six digits, more than the page shows.
fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
