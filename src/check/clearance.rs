//! Warnings about overlaps along the planned path: the approach without tracking errors, in few steps.

use super::number::short;
use super::warning;
use crate::capture::{Silent, study};
use crate::diagnostic::Warning;
use crate::registry;
use crate::scenario::{Actuation, Scenario, Tracking};
use crate::simulate::stepper::Integration;

/// Number of steps of the planned path.
const STEPS: f64 = 200.0;
/// Most distances of one case.
const MAX_DISTANCES: u64 = 20_000;
/// Depth of an overlap without a warning, m: end effectors may reach their targets a little from within.
const TOLERATED_DEPTH: f64 = 1e-3;

/// One warning for each case in which bodies of given outlines overlap before the contact.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    let mut planned = scenario.clone();
    let by_end_effectors = matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. });
    if scenario.approach.final_end_effector_poses.is_some() && !by_end_effectors {
        return Vec::new(); // the run computes the path
    }
    planned.post_impact = None;
    planned.clearance.max_distances = MAX_DISTANCES;
    // feedback needs the scenario's steps
    if !by_end_effectors {
        planned.approach.step = planned.approach.step.max(planned.approach.duration / STEPS);
        planned.approach.integration = Integration::default();
        planned.approach.tracking = Tracking::InverseDynamics;
        planned.approach.actuation = Actuation::default();
        if planned.approach.trajectory.properties().starts_at_rest {
            planned.initial.joint_rates.fill(0.0);
        }
    }
    let layout = &scenario.layout;
    let make = || registry::generated(layout).unwrap_or_else(|_| registry::generic(layout));
    // what stops a run is reported by the run
    let Ok(result) = study(&planned, &make, planned.approach.duration, &mut Silent) else { return Vec::new() };
    let mut warnings: Vec<Warning> = Vec::new();
    for case in &result.cases {
        let overlaps = case.clearance.overlaps.iter().filter(|overlap| !overlap.is_default);
        let deep =
            overlaps.filter(|overlap| overlap.depth > TOLERATED_DEPTH).min_by(|a, b| a.span[0].total_cmp(&b.span[0]));
        let Some(overlap) = deep else { continue };
        let [a, b] = &overlap.bodies;
        let why = format!(
            "`{a}` and `{b}` are inside each other along the planned path, from {} s and by {} m",
            short(overlap.span[0]),
            short(overlap.depth)
        );
        // the same for several cases
        if warnings.iter().all(|warning| warning.why != why) {
            let help = "choose another approach; `outline` in the layout and `clearance.ignore` say what may overlap";
            warnings.push(warning("approach", why, help));
        }
    }
    warnings
}
