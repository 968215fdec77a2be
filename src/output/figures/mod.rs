//! The figures of a study, as SVG and PNG.
//!
//! What a figure shows is described by [`Figure`], without a word of how it is drawn; [`draw`] draws it.

mod approach;
mod configuration;
mod dash;
pub mod draw;
mod energy;
mod figure;
mod frame;
mod impact;
mod momentum;
mod panel;
mod post_impact;
mod robot;
mod scale;
mod style;
mod time;

pub use figure::{Axis, Figure, Mark, Panel, Series, Span};
pub use style::{Colour, Dash, Shape};

use crate::capture::Study;
use crate::scenario::Scenario;

/// Every figure of a study: of the approach, and for each case of the capture and what follows.
///
/// A figure that belongs to one case ends in the case's name.
#[must_use]
pub fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let mut figures = configuration::figures(scenario, study);
    figures.extend(approach::figures(scenario, study));
    figures.extend(impact::velocities(scenario, study));
    for (case, result) in scenario.cases.iter().zip(&study.cases) {
        figures.push(momentum::figure(scenario, study, result));
        figures.push(energy::figure(study, result));
        if let Some(captured) = &result.capture {
            figures.extend(post_impact::figures(scenario, case, captured));
        }
    }
    figures
}
