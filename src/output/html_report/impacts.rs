//! What the page shows of contacts: every impact of a case, what was missed, and how closed the holds stay.

use super::data::digits;
use crate::capture::assembly::turned;
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::contact_detection::signed_distance;
use crate::capture::impact::{ContactResult, ImpactResult, ImpactSolution};
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::output::time_series::rows;
use crate::scenario::{Case, Detection, Scenario};
use crate::simulate::system::Body;
use serde_json::{Value, json};

/// The impacts of a case, in their order; one that touches nothing is none.
pub(super) fn impacts(scenario: &Scenario, study: &Study, result: &CaseResult) -> Vec<Value> {
    let Some(captured) = &result.capture else { return Vec::new() };
    let end_effectors = |sample: usize| captured.post_impact.samples.get(sample).map(|now| &now.end_effector_poses[..]);
    let first = (0, result.approach(study).duration, &captured.impact);
    let later = captured
        .further
        .iter()
        .map(|one| (sample_after(captured, one.time), result.approach(study).duration + one.time, &one.impact));
    let touched = std::iter::once(first).chain(later).filter(|(.., impact)| !impact.contacts.is_empty());
    touched
        .map(|(sample, time, impact)| {
            json!({
                "sample": sample,
                "time": time,
                "exact": balance(&impact.exact),
                "paper": impact.paper.as_ref().map(balance),
                "contacts": impact.contacts.iter()
                    .map(|one| contact(scenario, one, end_effectors(sample).unwrap_or_default(), impact)).collect::<Vec<_>>(),
            })
        })
        .collect()
}

/// The first sample after an impact: there are two at its time.
fn sample_after(captured: &CaptureResult, time: f64) -> usize {
    captured.post_impact.samples.iter().rposition(|sample| sample.time <= time).unwrap_or_default()
}

fn balance(result: &ImpactResult) -> Value {
    json!({
        "momentum_jump": result.momentum_jump,
        "kinetic_energy_before": result.kinetic_energy_before,
        "kinetic_energy_after": result.kinetic_energy_after,
    })
}

fn contact(scenario: &Scenario, result: &ContactResult, end_effectors: &[[f64; 3]], impact: &ImpactSolution) -> Value {
    let ImpactContact { target, arm, law, miss, .. } = result.touching;
    let response = &result.response;
    let literal = impact.paper.as_ref().and_then(|paper| paper.impulses.get(arm).copied().flatten());
    let [_, vx, vy] = response.relative_twist;
    json!({
        "target": target,
        "arm": arm,
        "kind": law.kind().name(),
        "restitution": law.bounce().map(|(_, restitution)| restitution),
        "tip": end_effectors.get(arm).map(|[_, x, y]| [x, y]),
        "miss": miss,
        "impulse": result.impulse,
        "literal_impulse": literal,
        "mean_force": scenario.contact.duration.map(|duration| result.impulse.map(|part| part / duration)),
        "relative_twist": response.relative_twist,
        // an end effector closes in against the normal of what it bounces off
        "closing_speed": law.bounce().map_or(vx.hypot(vy), |([x, y], _)| -(vx * x + vy * y)),
        "effective_masses": response.effective_masses,
        "impulse_index": response.impulse_index,
        "impulse_ellipse": {
            "semi_axes": response.impulse_ellipse.semi_axes,
            "direction": response.impulse_ellipse.direction,
        },
    })
}

/// The grasps that were not to close in this case.
pub(super) fn open(scenario: &Scenario, case: &Case) -> Vec<Value> {
    let targets = scenario.targets.iter().zip(&case.kinds).enumerate();
    let touches =
        targets.flat_map(|(i, (target, kinds))| target.touches.iter().zip(kinds).map(move |(t, k)| (i, t, k)));
    let open = touches.filter(|(.., kind)| kind.is_none());
    open.map(|(target, touch, _)| json!({"target": target, "arm": touch.arm})).collect()
}

/// Distances of end effectors from the targets that they are to meet, m, over approach and motion after it, where
/// contacts are found by detection.
pub(super) fn distances(scenario: &Scenario, study: &Study, case: &Case, result: &CaseResult) -> Vec<Value> {
    if scenario.contact.detection == Detection::Time {
        return Vec::new();
    }
    let all: Vec<_> = rows(study, result).collect();
    let mut columns = Vec::new();
    for (i, (target, kinds)) in scenario.targets.iter().zip(&case.kinds).enumerate() {
        for (touch, _) in target.touches.iter().zip(kinds).filter(|(_, kind)| kind.is_some()) {
            let distance = |targets: &[Body], end_effectors: &[[f64; 3]]| {
                Some(digits(signed_distance(scenario, i, targets.get(i)?, end_effectors.get(touch.arm)?).0))
            };
            let column = all.iter().map(|now| distance(&now.targets, &now.sample.end_effector_poses));
            columns.push(json!({"target": i, "arm": touch.arm, "distance": column.collect::<Vec<_>>()}));
        }
    }
    columns
}

/// By how much each hold that is kept by a constraint is open, over the samples after the first impact: the larger of
/// the distance of the contact points, m, and of the turn of one that is rigid, rad. `None` before it takes hold.
///
/// The first rigid hold of a target makes it part of the robot's link: there is nothing that could open.
pub(super) fn holds(captured: &CaptureResult) -> Vec<Value> {
    let later = captured.further.iter().map(|one| (sample_after(captured, one.time), &one.impact));
    let mut holds = Vec::new();
    let mut merged = Vec::new();
    for (from, impact) in std::iter::once((0, &captured.impact)).chain(later) {
        let held = impact.contacts.iter().map(|one| one.touching);
        for ImpactContact { target, arm, law, .. } in held.filter(|touch| touch.law.kind().holds()) {
            let keeps_yaw = law.kind().holds_yaw();
            if keeps_yaw && !merged.contains(&target) {
                merged.push(target);
                continue;
            }
            let seen = |i: usize| {
                let now = captured.post_impact.samples.get(i)?;
                Some(relative(captured.targets.get(i)?.get(target)?, now.end_effector_poses.get(arm)?))
            };
            let Some([yaw, x, y]) = seen(from) else { continue };
            let open = |i: usize| {
                let [now_yaw, now_x, now_y] = seen(i).filter(|_| i >= from)?;
                let turn = if keeps_yaw { (now_yaw - yaw).abs() } else { 0.0 };
                Some(digits((now_x - x).hypot(now_y - y).max(turn)))
            };
            let column = (0..captured.post_impact.samples.len()).map(open);
            holds.push(json!({"target": target, "arm": arm, "open": column.collect::<Vec<_>>()}));
        }
    }
    holds
}

/// Pose of an end effector in the frame of a target.
fn relative(target: &Body, end_effector: &[f64; 3]) -> [f64; 3] {
    let [yaw, x, y] = target.pose;
    let [along, across] = turned([end_effector[1] - x, end_effector[2] - y], -yaw);
    [end_effector[0] - yaw, along, across]
}
