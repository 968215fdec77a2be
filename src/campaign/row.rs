//! One case of a sweep: what it was computed with and what came of it.
//!
//! # Example
//! ```
//! use planar_capture::campaign::Campaign;
//! use planar_capture::campaign::outputs::outputs;
//! use planar_capture::campaign::row::{CaseRunner, Status};
//! use planar_capture::campaign::sweep::Draw;
//! use planar_capture::engine::Choice;
//! use planar_capture::registry::{Robots, SHIPPED};
//!
//! let text = r#"
//! name = "masses"
//! scenario = "redysim_single_arm_3r.toml"
//! seed = 1
//! sampling = "grid"
//! vary = [{ key = "layout.base.mass", distribution = { choice = [-1.0, 600.0] } }]
//! "#;
//! let Campaign { sweep, variation, scenario, .. } =
//!     Campaign::parse(text, "masses.toml", "scenarios".as_ref(), SHIPPED)?;
//! let (choice, _) = Choice::fastest(&scenario.layout, Robots::SHIPPED);
//! let (draw, outputs) = (Draw::new(&sweep), outputs(&scenario, &[]));
//! let runner = CaseRunner { draw, variation: &variation, choice: &choice, outputs: &outputs, laws: &[] };
//! // a base has a positive mass
//! let rows = [0, 1].map(|case| runner.run(case, f64::INFINITY, &mut |_, _, _| {}));
//! assert_eq!(rows.map(|row| row.status), [Status::Refused, Status::Done]);
//! # Ok::<(), planar_capture::diagnostic::Report>(())
//! ```

use super::outputs::{Output, is_captured};
use super::sweep::Draw;
use crate::capture::{CaseResult, Silent, Study, study_registered};
use crate::engine::Choice;
use crate::laws::RegisteredLaw;
use crate::scenario::Scenario;
use crate::scenario::variation::{Variation, VariedValue};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// With a result that passes its audit.
    Done,
    /// With a result that does not.
    AuditFailed,
    /// Scenario or layout are not valid with its values.
    Refused,
    /// Its simulation stopped.
    Stopped,
    /// By a fault of the program.
    Panicked,
}

impl Status {
    /// All of them with their names in files.
    pub const ALL: [(&'static str, Self); 5] = [
        ("done", Self::Done),
        ("audit_failed", Self::AuditFailed),
        ("refused", Self::Refused),
        ("stopped", Self::Stopped),
        ("panicked", Self::Panicked),
    ];

    /// As in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, status)| *status == self).map_or("", |(name, _)| name)
    }
}

/// The row of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its index.
    pub case: u64,
    /// In the order of the keys.
    pub values: Vec<VariedValue>,
    /// Whether what was to be held is held.
    pub captured: Option<bool>,
    /// In the order of the outputs.
    pub outputs: Vec<Option<f64>>,
    /// How it ended.
    pub status: Status,
    /// Why it did not end well.
    pub message: Option<String>,
    /// What it took, s.
    pub seconds: f64,
}

/// Computes cases.
#[derive(Debug)]
pub struct CaseRunner<'a> {
    /// Of the values.
    pub draw: Draw<'a>,
    /// Of the texts.
    pub variation: &'a Variation,
    /// Of the dynamics.
    pub choice: &'a Choice,
    /// In the order of the columns.
    pub outputs: &'a [Output],
    /// That scenarios may name beside the shipped ones.
    pub laws: &'a [RegisteredLaw],
}

/// Takes what else is wanted of a case that has a result.
pub type Keep<'a> = &'a mut dyn FnMut(&Scenario, &Study, &CaseResult);

/// Why a case has no result, or none that passes.
type Failure = (Status, String);

impl CaseRunner<'_> {
    /// Computes a case with samples every `sample` seconds; `keep` may take its time series.
    #[must_use]
    pub fn run(&self, case: u64, sample: f64, keep: Keep<'_>) -> Row {
        let begin = Instant::now();
        let values = self.draw.values(case);
        let mut row = Row {
            case,
            values,
            captured: None,
            outputs: vec![None; self.outputs.len()],
            status: Status::Done,
            message: None,
            seconds: 0.0,
        };
        // one case is not to take the others with it
        let computed = catch_unwind(AssertUnwindSafe(|| self.compute(&mut row, sample, keep)));
        let failure = computed.unwrap_or_else(|panic| Err((Status::Panicked, text_of_panic(&*panic)))).err();
        if let Some((status, message)) = failure {
            row.status = status;
            row.message = Some(message);
        }
        row.seconds = begin.elapsed().as_secs_f64();
        row
    }

    fn compute(&self, row: &mut Row, sample: f64, keep: Keep<'_>) -> Result<(), Failure> {
        let refused = |report: crate::diagnostic::Report| (Status::Refused, report.sentence());
        let scenario = self.variation.scenario(&row.values).map_err(refused)?;
        let model = self.choice.model(&scenario.layout);
        let study = study_registered(&scenario, &|| model.clone_box(), self.laws, sample, &mut Silent)
            .map_err(|error| (Status::Stopped, error.to_string()))?;
        let [case] = &study.cases[..] else { unreachable!("a variation has one case") };
        row.captured = is_captured(&scenario, case);
        row.outputs = self.outputs.iter().map(|output| output.value(&study, case)).collect();
        keep(&scenario, &study, case);
        match study.audit_failures() {
            failures if failures.is_empty() => Ok(()),
            failures => Err((Status::AuditFailed, failures.join("; "))),
        }
    }
}

fn text_of_panic(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or(panic.downcast_ref::<&str>().copied());
    text.unwrap_or("a panic without a message").to_owned()
}
