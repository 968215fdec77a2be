//! Parts of a run: the cases of one approach.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::{run_manifest::RunManifest, study_part::StudyPart};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//! use std::borrow::Cow;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let mut study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let manifest = RunManifest::new(&scenario, source, "planar-capture run".to_owned());
//! study.approach.drift.energy_error = 0.5; // as if torques had done work of which half is missing
//! let (scenario, study) = (&scenario, Cow::Borrowed(&study));
//! let part = StudyPart { scenario, variant: None, dynamics: "generated", study, manifest };
//! assert_eq!(part.audit_failures(), ["approach: energy error 5.00e-1 is over its bound 1e-6"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::capture::Study;
use crate::capture::step_advice::step_advice;
use crate::output::run_manifest::RunManifest;
use crate::scenario::{Scenario, Variant};
use std::borrow::Cow;

/// The study of a scenario's common cases, or of a case with values of its own.
#[derive(Clone, Debug)]
pub struct StudyPart<'a> {
    /// With the values of its cases.
    pub scenario: &'a Scenario,
    /// The case with values of its own; `None` for all others.
    pub variant: Option<&'a Variant>,
    /// The implementation of the dynamics.
    pub dynamics: &'a str,
    /// The results.
    pub study: Cow<'a, Study>,
    /// For the files of its cases.
    pub manifest: RunManifest,
}

impl StudyPart<'_> {
    /// The failures of the audit, each with the case where it is that of one.
    #[must_use]
    pub fn audit_failures(&self) -> Vec<String> {
        let failures = self.study.audit_failures().into_iter();
        let Some(name) = self.variant.map(Variant::name) else { return failures.collect() };
        // the approach, too, is that of the case
        failures.map(|failure| if failure.starts_with(name) { failure } else { format!("{name}, {failure}") }).collect()
    }

    /// What would keep the audit's bounds, each with the case where it is that of one.
    #[must_use]
    pub fn step_advice(&self) -> Vec<String> {
        let advice = step_advice(self.scenario, &self.study).into_iter();
        match self.variant.map(Variant::name) {
            Some(name) => advice.map(|sentence| format!("{name}: {sentence}")).collect(),
            None => advice.collect(),
        }
    }
}
