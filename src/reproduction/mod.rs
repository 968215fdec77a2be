//! The report on the paper's reproduction: the tables and figures of the paper and of this crate side by side.
//!
//! # Example
//! ```no_run
//! use planar_capture::capture::Silent;
//! use planar_capture::reproduction::reproduce;
//!
//! let report = reproduce(&mut Silent)?;
//! let (path, text) = &report.files[0];
//! assert_eq!(path, "reproduction.md");
//! // Table 5 of the paper, beside what is computed
//! assert!(text.contains("0.0873"));
//! # Ok::<(), planar_capture::reproduction::ReproductionError>(())
//! ```

mod impacts;
mod markdown;
mod overlaps;
mod parameters;
mod printed;
mod residuals;

use crate::capture::{Observer, Study, StudyError, study};
use crate::output::figures::{Figure, Width, draw, figures};
use crate::registry::{self, NoModel};
use crate::scenario::Scenario;
use std::path::Path;

/// Text and placeholders of the report.
const TEMPLATE: &str = include_str!("report.md");
/// Between two points of a curve, s: enough for these curves, and little enough for small files.
const SAMPLE: f64 = 0.25;

/// The paper's study, as this crate reads it; with torques from inverse dynamics; with eq. (7) as printed.
const SCENARIOS: [(&str, &str); 3] = [
    ("raina_shah_2017.toml", include_str!("../../scenarios/raina_shah_2017.toml")),
    ("raina_shah_2017_exact_tracking.toml", include_str!("../../scenarios/raina_shah_2017_exact_tracking.toml")),
    ("raina_shah_2017_as_printed.toml", include_str!("../../scenarios/raina_shah_2017_as_printed.toml")),
];

/// Figures of the study that the report shows.
const SHOWN: [&str; 9] = [
    "initial_configuration",
    "impact_configuration",
    "approach_joint_angles",
    "approach_end_effector_velocities",
    "impact_velocities",
    "momentum_case1",
    "post_impact_motion_case1",
    "post_impact_motion_case2",
    "post_impact_motion_case3",
];

/// A report and the figures that it refers to.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Reproduction {
    /// Path below the report's folder, and content; the report is the first.
    pub files: Vec<(String, String)>,
}

/// Why there is no report.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReproductionError {
    /// A shipped scenario cannot be read.
    #[error("{0}")]
    Scenario(#[from] crate::diagnostic::Report),
    /// There is no generated code for the paper's robot.
    #[error(transparent)]
    Model(#[from] NoModel),
    /// A computation has no answer.
    #[error(transparent)]
    Study(#[from] StudyError),
    /// An impact has no answer.
    #[error("the impact: {0}")]
    Dynamics(#[from] crate::error::Error),
    /// The text of the report cannot be filled in.
    #[error("the report cannot be written: {0}")]
    Template(#[from] tera::Error),
}

/// A scenario and its results.
struct Run {
    scenario: Scenario,
    study: Study,
}

/// Runs the paper's study in its three readings and writes the report; the same crate gives the same bytes.
///
/// # Errors
/// [`ReproductionError`], where this crate was built without the paper's robot.
pub fn reproduce(observer: &mut dyn Observer) -> Result<Reproduction, ReproductionError> {
    let [tracked, exactly_tracked, as_printed] = SCENARIOS.map(|(file, text)| run(file, text, observer));
    let runs = [tracked?, exactly_tracked?, as_printed?];
    let [tracked, _, as_printed] = &runs;
    let mut values = tera::Context::new();
    for (name, table) in parameters::tables(&runs).into_iter().chain(impacts::tables(&runs)) {
        values.insert(name, &table);
    }
    values.insert("overlaps", &overlaps::overlaps(tracked));
    let model = registry::generated(&tracked.scenario.layout)?;
    values.insert("residuals", &residuals::residuals(tracked, &*model)?);
    let mut templates = tera::Tera::default();
    templates.add_raw_template("report.md", TEMPLATE)?;
    let mut files = vec![("reproduction.md".to_owned(), templates.render("report.md", &values)?)];
    let mut add =
        |name: &str, figure: &Figure| files.push((format!("reproduction/{name}.svg"), draw::svg(figure, Width::Page)));
    for figure in figures(&tracked.scenario, &tracked.study) {
        if SHOWN.contains(&figure.name.as_str()) {
            add(&figure.name, &figure);
        }
    }
    for figure in figures(&as_printed.scenario, &as_printed.study) {
        if figure.name == "approach_end_effector_velocities" {
            add("approach_end_effector_velocities_as_printed", &figure);
        }
    }
    Ok(Reproduction { files })
}

fn run(file: &str, text: &str, observer: &mut dyn Observer) -> Result<Run, ReproductionError> {
    let scenario = Scenario::parse(text, file, Path::new(""), registry::SHIPPED)?;
    let model = registry::generated(&scenario.layout)?;
    let study = study(&scenario, &|| model.clone_box(), SAMPLE, observer)?;
    Ok(Run { scenario, study })
}
