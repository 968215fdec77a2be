//! The impacts of a case in order of time, each with the samples of the motion immediately before and after it.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::impacts::impacts;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/spinning_target.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let impact = impacts(&study, &study.cases[0])[0];
//! assert_eq!(impact.time, 20.0);
//! // the target of 40 kg has lost the momentum that the robot has gained
//! let (before, after) = (impact.targets[0].twist, impact.solution.target_twists[0]);
//! let [_, fx, fy] = impact.solution.contacts[0].impulse;
//! assert!((40.0 * (before[1] - after[1]) - fx).abs() < 1e-9);
//! assert!((40.0 * (before[2] - after[2]) - fy).abs() < 1e-9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

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

/// How many digits after the point tell times in s apart, which are in their order; three at least.
#[must_use]
pub fn time_digits(times: &[f64]) -> usize {
    const MOST: usize = 9;
    let gaps = times.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 0.0);
    let least = gaps.fold(f64::INFINITY, f64::min);
    let is_seen =
        |digits: &usize| [1e3, 1e4, 1e5, 1e6, 1e7, 1e8].get(digits - 3).is_some_and(|unit| least * unit >= 2.0);
    (3..MOST).find(is_seen).unwrap_or(MOST)
}

#[cfg(test)]
mod tests {
    use super::time_digits;

    #[test]
    fn times_have_the_digits_that_tell_them_apart() {
        assert_eq!(time_digits(&[1.0]), 3);
        assert_eq!(time_digits(&[1.0, 1.5, 1.5]), 3);
        assert_eq!(time_digits(&[5.0682, 5.0685]), 4);
        assert_eq!(time_digits(&[5.0, 5.0 + 1e-12]), 9);
    }
}
