//! Parts of a run: the cases of one approach.

use crate::capture::Study;
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
}
