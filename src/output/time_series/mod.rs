//! The time series of a case: rows, columns, and their files.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::time_series::{Columns, rows};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let case = &study.cases[0];
//! assert_eq!(Columns::of(&scenario, case).list()[0].heading(), "base_yaw [rad]");
//! // from rest, the kinetic energy is the work of the joint torques
//! for row in rows(&study, case) {
//!     assert!((row.total_momentum.kinetic_energy - row.sample.work.joint_work).abs() < 1e-6);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod columns;
mod csv;
#[cfg(feature = "parquet")]
mod parquet;

pub use columns::{Column, Columns};
pub use csv::{CsvWriter, write_csv};
#[cfg(feature = "parquet")]
pub use parquet::write_parquet;

use crate::capture::{CaseResult, Study};
use crate::dynamics::Momentum;
use crate::output::run_manifest::RunManifest;
use crate::scenario::Scenario;
use crate::simulate::bodies::with_bodies;
use crate::simulate::stored_samples::PhaseSample;
use crate::simulate::system::Body;
use crate::simulate::{Phase, Sample};
use std::borrow::Cow;
use std::io;

const APPROACH: &str = "approach";

/// Robot and targets at one instant of a case.
#[derive(Clone, Debug)]
pub struct TimeSeriesRow<'a> {
    /// Since the start of the approach, s.
    pub time: f64,
    /// `approach` or `post_impact`.
    pub phase: &'static str,
    /// The robot; its time counts from the start of the phase.
    pub sample: Cow<'a, Sample>,
    /// The targets, in the scenario's order.
    pub targets: Cow<'a, [Body]>,
    /// Momentum about the inertial origin and kinetic energy of robot and targets together.
    pub total_momentum: Momentum<f64>,
}

/// The rows of a case: the approach, then the post-impact motion. Each impact has two rows of the same time, before and
/// after it. Of a long phase these are the samples in memory.
pub fn rows<'a>(study: &'a Study, case: &'a CaseResult) -> impl Iterator<Item = TimeSeriesRow<'a>> {
    let approach = case.approach(study);
    let before = approach.samples.iter().map(move |sample| before_impact(approach, case, Cow::Borrowed(sample)));
    let after = case.capture.iter().flat_map(move |captured| {
        captured
            .post_impact
            .samples
            .iter()
            .zip(&captured.targets)
            .map(move |(sample, targets)| after_impact(approach, Cow::Borrowed(sample), Cow::Borrowed(targets)))
    });
    before.chain(after)
}

/// All rows of a case, as [`rows`]; those that are not in memory are read from a temporary file, one after the other.
pub fn all_rows<'a>(study: &'a Study, case: &'a CaseResult) -> impl Iterator<Item = io::Result<TimeSeriesRow<'a>>> {
    let approach = case.approach(study);
    let before = approach.all_samples().map(move |sample| {
        let sample = match sample? {
            PhaseSample::InMemory(_, sample) => Cow::Borrowed(sample),
            PhaseSample::Stored(sample, _) => Cow::Owned(*sample),
        };
        Ok(before_impact(approach, case, sample))
    });
    let after = case.capture.iter().flat_map(move |captured| {
        captured.post_impact.all_samples().map(move |sample| {
            Ok(match sample? {
                PhaseSample::InMemory(i, sample) => {
                    after_impact(approach, Cow::Borrowed(sample), Cow::Borrowed(&captured.targets[i]))
                }
                PhaseSample::Stored(sample, targets) => {
                    after_impact(approach, Cow::Owned(*sample), Cow::Owned(targets))
                }
            })
        })
    });
    before.chain(after)
}

fn before_impact<'a>(approach: &Phase, case: &CaseResult, sample: Cow<'a, Sample>) -> TimeSeriesRow<'a> {
    let targets = case.targets_before(approach.duration - sample.time);
    let total_momentum = with_bodies(sample.momentum, targets.iter().copied());
    TimeSeriesRow { time: sample.time, phase: APPROACH, sample, targets: Cow::Owned(targets), total_momentum }
}

fn after_impact<'a>(approach: &Phase, sample: Cow<'a, Sample>, targets: Cow<'a, [Body]>) -> TimeSeriesRow<'a> {
    // the robot's momentum is that of the targets, too
    let total_momentum = sample.momentum;
    TimeSeriesRow { time: approach.duration + sample.time, phase: "post_impact", sample, targets, total_momentum }
}

/// The metadata of a time series' file, as keys and values: names, version, and the manifest of the run.
#[must_use]
pub fn provenance(scenario: &Scenario, case: &CaseResult, manifest: &RunManifest) -> Vec<(String, String)> {
    let names = [
        ("scenario", scenario.name.as_str()),
        ("layout", &scenario.layout.name),
        ("case", &case.name),
        ("planar_capture_version", env!("CARGO_PKG_VERSION")),
    ];
    let names = names.map(|(key, value)| (key.to_owned(), value.to_owned()));
    names.into_iter().chain(manifest.entries()).collect()
}
