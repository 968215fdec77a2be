//! The impacts of a case in order of time, each with the samples of the motion immediately before and after it.

use crate::capture::impact::ImpactSolution;
use crate::capture::{CaseResult, Study};
use crate::simulate::Sample;
use crate::simulate::system::Body;

/// One impact of a case.
#[derive(Clone, Copy, Debug)]
pub struct ImpactEvent<'a> {
    /// Since the start of the approach, s.
    pub time: f64,
    /// Velocities, impulses and balances by both models.
    pub solution: &'a ImpactSolution,
    /// The robot immediately before.
    pub before: &'a Sample,
    /// The targets immediately before, in the scenario's order.
    pub targets: &'a [Body],
    /// Index of the sample of the post-impact motion immediately after.
    pub after: usize,
}

/// The impacts of a case: the one that ends the approach, then those that interrupt the post-impact motion.
///
/// Empty if the case has no capture. An impact at the very end of the motion has no sample after it; `after` is then
/// the last sample, before it.
#[must_use]
pub fn impacts<'a>(study: &'a Study, case: &'a CaseResult) -> Vec<ImpactEvent<'a>> {
    let Some(capture) = &case.capture else { return Vec::new() };
    let approach = case.approach(study);
    let first = ImpactEvent {
        time: approach.duration,
        solution: &capture.impact,
        before: approach.end(),
        targets: &case.targets,
        after: 0,
    };
    let samples = &capture.post_impact.samples;
    let later = capture.later_impacts.iter().map(|later| {
        // the samples before and after an impact have the same time
        let before = samples.partition_point(|sample| sample.time < later.time);
        ImpactEvent {
            time: approach.duration + later.time,
            solution: &later.impact,
            before: &samples[before],
            targets: &capture.targets[before],
            after: samples.partition_point(|sample| sample.time <= later.time) - 1,
        }
    });
    std::iter::once(first).chain(later).collect()
}
