//! One HTML file with a replay of the study: opens from disk, without a network.
//!
//! Text, styles, programs and data are all in it. The plots are drawn by uPlot (MIT), whose text and licence it
//! carries.

mod data;
mod impacts;

use crate::capture::Study;
use crate::scenario::Scenario;
use std::io::{self, Write};

const PAGE: &str = include_str!("page.html");

/// What takes the place of each mark in the page.
const PARTS: [(&str, &str); 11] = [
    ("/*uplot.css*/", include_str!("uPlot.min.css")),
    ("/*page.css*/", include_str!("page.css")),
    ("/*uplot.licence*/", include_str!("uPlot.LICENSE")),
    ("/*uplot.js*/", include_str!("uPlot.iife.min.js")),
    ("/*motion.js*/", include_str!("motion.js")),
    ("/*pen.js*/", include_str!("pen.js")),
    ("/*view.js*/", include_str!("view.js")),
    ("/*scene.js*/", include_str!("scene.js")),
    ("/*plots.js*/", include_str!("plots.js")),
    ("/*contacts.js*/", include_str!("contacts.js")),
    ("/*page.js*/", include_str!("page.js")),
];

/// Writes the page.
///
/// # Errors
/// What the writer says.
pub fn write_report(scenario: &Scenario, study: &Study, mut to: impl Write) -> io::Result<()> {
    let mut page = PAGE.replace("<!--title-->", &escaped(&scenario.name));
    for (mark, text) in PARTS {
        page = page.replace(mark, text.trim_end());
    }
    // last, so that no mark in it is looked for; `</` would end the element that holds it
    let data = serde_json::to_string(&data::data(scenario, study))?.replace("</", "<\\/");
    let (before, after) = page.split_once("/*data*/").unwrap_or((&page, ""));
    to.write_all(before.as_bytes())?;
    to.write_all(data.as_bytes())?;
    to.write_all(after.as_bytes())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
