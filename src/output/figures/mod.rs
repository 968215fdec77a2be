//! The figures of a study: their content as [`Figure`]s, which [`draw`] converts to SVG, PDF and PNG.

mod approach;
mod clearance;
mod configuration;
mod contact_velocities;
mod dash;
pub mod draw;
mod energy;
mod figure;
mod momentum;
mod panel;
mod pdf;
mod post_impact;
mod robot;
mod scale;
mod snapshot;
mod style;
mod time_curves;
mod width;

pub use figure::{Axis, AxisRange, Figure, Mark, Panel, Series};
pub(crate) use panel::power_of_ten;
pub use style::{Colour, Dash, Symbol};
pub use width::Width;

use crate::capture::Study;
use crate::scenario::Scenario;

/// The figures of the approach, the impacts and the post-impact motion. The name of a figure that belongs to one case
/// ends in the case's name.
#[must_use]
pub fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let mut figures = configuration::figures(scenario, study);
    figures.extend(approach::figures(scenario, study));
    figures.extend(contact_velocities::figure(scenario, study));
    for case in &study.cases {
        figures.push(momentum::figure(scenario, study, case));
        figures.push(energy::figure(study, case));
        figures.extend(clearance::figure(study, case));
        if let Some(capture) = &case.capture {
            figures.extend(post_impact::figures(scenario, study, case, capture));
        }
    }
    figures
}
