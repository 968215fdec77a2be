//! The figures of a study: their content as [`Figure`]s, which [`draw`] converts to SVG, PDF and PNG.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::figures::figures;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let all = figures(&scenario, &study);
//! let angles = all.iter().find(|figure| figure.name == "approach_joint_angles").expect("a figure of the approach");
//! let joints = &angles.panels[0].series;
//! assert_eq!(joints.len(), 3);
//! assert_eq!(joints[1].points[0], (0.0, scenario.initial.joint_angles[1]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod approach;
mod clearance;
mod configuration;
mod contact_velocities;
mod cut;
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
