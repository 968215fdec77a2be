//! Targets in reach of an arm that the planned path leads past, so far that no run meets them.

use super::encounter::is_distant;
use super::number::short;
use super::warning;
use crate::capture::clearance::ClosestApproach;
use crate::capture::{CaseResult, Study};
use crate::diagnostic::Warning;
use crate::scenario::{Detection, Scenario, Tracking};
use crate::simulate::Sample;

/// Least distance from a target that is far, over the arm's reach: what is left of the difference between a run and its plan,
/// but for the lag of the law, is rounding and errors of steps.
const FAR: f64 = 0.1;

/// By how much more than under constant torques an arm may lag: twice for a step of the torque, twice for the base, which gives
/// way.
const LAG: f64 = 4.0;

/// How far end effectors may be from where the planned motion has them, m, per unit of the arm's reach; `None` where that is
/// not known. `has_own_steps` where the law was simulated as a run does.
pub(super) fn off_path(scenario: &Scenario, planned: &Study, has_own_steps: bool) -> Option<f64> {
    let approach = &scenario.approach;
    if let Tracking::ResolvedMotionRate { .. } = approach.tracking {
        return has_own_steps.then_some(0.0);
    }
    let at_rest = scenario.initial.joint_rates.iter().all(|rate| *rate == 0.0);
    // what begins otherwise than planned
    if approach.trajectory.properties().starts_at_rest && !at_rest {
        return None;
    }
    let peak = |joint: usize| {
        let samples = planned.cases.iter().filter_map(|case| case.approach.as_ref()).flat_map(|phase| &phase.samples);
        samples.map(|sample: &Sample| sample.joint_torques[joint].abs()).fold(0.0, f64::max)
    };
    if let Some(limits) = &approach.actuation.torque_limits
        && limits.iter().enumerate().any(|(joint, limit)| LAG * peak(joint) > *limit)
    {
        return None;
    }
    match &approach.tracking {
        // between samples their torques are not those of the law
        _ if approach.actuation.steps_per_sample.is_some() => None,
        Tracking::InverseDynamics => Some(0.0),
        Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            let is_stable = proportional_gain.iter().chain(derivative_gain).all(|gain| *gain > 0.0);
            is_stable.then_some(0.0)
        }
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => {
            let gains = proportional_gain.iter().zip(derivative_gain).enumerate();
            let lag = |(joint, (stiffness, damping)): (usize, (&f64, &f64))| {
                (*stiffness > 0.0 && *damping > 0.0).then(|| LAG * peak(joint) / stiffness)
            };
            gains.map(lag).sum()
        }
        Tracking::ResolvedMotionRate { .. } | Tracking::Own { .. } => None,
    }
}

/// The targets of cases in which no end effector comes near any target along the planned path. After an impact the robot moves
/// otherwise than planned: a case in which one is met, or nearly, has none.
pub(super) fn warnings(scenario: &Scenario, cases: &[usize], planned: &Study, off_path: Option<f64>) -> Vec<Warning> {
    let Some(off_path) = off_path.filter(|_| scenario.contact.detection == Detection::Event) else { return Vec::new() };
    let is_far =
        |pair: &ClosestApproach| pair.distance > (FAR + off_path) * scenario.layout.arms[pair.arm].reach_from_base();
    let misses = |case: &CaseResult| !case.closest.is_empty() && case.closest.iter().all(is_far);
    let missing: Vec<_> = cases.iter().zip(&planned.cases).filter(|(_, case)| misses(case)).collect();
    let each = scenario.targets.iter().enumerate().flat_map(|(i, target)| {
        let found = missing.iter().filter(|(place, _)| !is_distant(scenario, &scenario.cases[**place], i));
        let found: Vec<_> = found
            .filter_map(|(place, case)| {
                let own = case.closest.iter().filter(|pair| pair.target == i);
                Some((**place, own.min_by(|a, b| a.distance.total_cmp(&b.distance))?))
            })
            .collect();
        let is_always = found.len() == cases.len();
        found.into_iter().take(if is_always { 1 } else { usize::MAX }).map(move |(place, nearest)| {
            let key = if is_always {
                format!("target[{i}].position")
            } else {
                format!("case[{}].target_twists", scenario.cases[place].index)
            };
            let why = format!(
                "`{}` is in reach, but not on the way: along the planned path {} comes no nearer than {} m, at {} s",
                target.name,
                scenario.layout.arms[nearest.arm].name,
                short(nearest.distance),
                short(nearest.time)
            );
            warning(key, why, "a run meets nothing then: another end of the approach, another twist, or another time")
        })
    });
    each.collect()
}
