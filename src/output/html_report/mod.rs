//! One HTML file with an animation and plots of a study. It contains its styles, programs and data and opens without a
//! network.
//!
//! uPlot (MIT) draws the plots; the file contains its text and licence.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::html_report::write_report;
//! use planar_capture::output::run_manifest::RunManifest;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let manifest = RunManifest::new(&scenario, source, "planar-capture run".to_owned());
//! let mut page = Vec::new();
//! write_report(&scenario, &study, &manifest, &mut page)?;
//! let page = String::from_utf8(page)?;
//! assert!(page.contains("<title>redysim_single_arm_3r"));
//! assert!(!page.contains("<script src") && !page.contains("stylesheet")); // all that it needs is in it
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod contacts;
mod data;

use crate::capture::Study;
use crate::output::markup;
use crate::output::run_manifest::RunManifest;
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

/// Writes the page.
///
/// # Errors
/// Those of the writer.
pub fn write_report(scenario: &Scenario, study: &Study, manifest: &RunManifest, mut to: impl Write) -> io::Result<()> {
    // pages of cases of their own are told apart by their tabs
    let title = match &manifest.case {
        Some(case) => format!("{}, {case}", scenario.name),
        None => scenario.name.clone(),
    };
    let mut page = PAGE.replace("<!--title-->", &markup::text(&title));
    for (placeholder, text) in PARTS {
        page = page.replace(placeholder, text.trim_end());
    }
    // `</` would end the script element
    let data = serde_json::to_string(&data::data(scenario, study, manifest))?.replace("</", "<\\/");
    to.write_all(page.replacen("/*data*/", &data, 1).as_bytes())
}

/// Rounded to six digits, more than the page shows.
fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
