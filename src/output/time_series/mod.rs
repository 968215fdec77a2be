//! The time series of a case: its rows, its columns, and the files that hold them.

mod columns;
mod csv;
#[cfg(feature = "parquet")]
mod parquet;

pub use columns::{Column, columns};
pub use csv::write_csv;
#[cfg(feature = "parquet")]
pub use parquet::write_parquet;

use crate::capture::{CaseResult, Study};
use crate::dynamics::Momentum;
use crate::scenario::Scenario;
use crate::simulate::Sample;
use crate::simulate::bodies::with_bodies;
use crate::simulate::system::Body;

const APPROACH: &str = "approach";

/// One instant of a case.
#[derive(Clone, Debug)]
pub struct TimeSeriesRow<'a> {
    /// Since the start of the approach, s.
    pub time: f64,
    /// `approach` or `post_impact`.
    pub phase: &'static str,
    /// What is known of the robot; its own time runs from the start of the phase.
    pub sample: &'a Sample,
    /// The targets, in the scenario's order; empty where nothing is captured.
    pub targets: Vec<Body>,
}

impl TimeSeriesRow<'_> {
    /// Momentum and energy of robot and targets together.
    #[must_use]
    pub fn whole(&self) -> Momentum<f64> {
        // after the impact the targets are counted in already
        let alone = if self.phase == APPROACH { &self.targets[..] } else { &[] };
        with_bodies(self.sample.momentum, alone)
    }
}

/// The approach, then the motion after the impact, where there is one.
///
/// At each impact there are two rows of the same time, before and after it.
pub fn rows<'a>(study: &'a Study, case: &'a CaseResult) -> impl Iterator<Item = TimeSeriesRow<'a>> {
    let approach = case.approach(study);
    let before = approach.samples.iter().map(move |sample| TimeSeriesRow {
        time: sample.time,
        phase: APPROACH,
        sample,
        targets: case.targets_before(approach.duration - sample.time),
    });
    let after = case.capture.iter().flat_map(move |captured| {
        captured.post_impact.samples.iter().zip(&captured.targets).map(move |(sample, targets)| TimeSeriesRow {
            time: approach.duration + sample.time,
            phase: "post_impact",
            sample,
            targets: targets.clone(),
        })
    });
    before.chain(after)
}

/// Where a time series comes from, as keys and values: what a file says about itself.
#[must_use]
pub fn provenance(scenario: &Scenario, case: &CaseResult) -> [(&'static str, String); 5] {
    [
        ("scenario", scenario.name.clone()),
        ("layout", scenario.layout.name.clone()),
        ("layout_sha256", scenario.layout.sha256()),
        ("case", case.name.clone()),
        ("planar_capture_version", env!("CARGO_PKG_VERSION").to_owned()),
    ]
}
