//! The contacts of a case as JSON: impacts, failed grasps, distances, and openings of the constraints.

use super::digits;
use crate::capture::assembly::rotated;
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::contact_detection::signed_distance;
use crate::capture::impact::ContactResult;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::contact::ContactKind;
use crate::output::impacts::{ImpactEvent, impacts};
use crate::output::summary::{contact_value, impact_result};
use crate::output::time_series::rows;
use crate::scenario::{Case, Detection, Scenario};
use crate::simulate::system::Body;
use serde_json::{Value, json};

/// The impacts that have contacts, in order of time; `sample` is the index of the first sample after each.
pub(super) fn impacts_of_case(scenario: &Scenario, study: &Study, result: &CaseResult) -> Vec<Value> {
    let with_contacts = impacts(study, result).into_iter().filter(|event| !event.solution.contacts.is_empty());
    let value = |event: ImpactEvent<'_>| {
        json!({
            "sample": event.after,
            "time": event.time,
            "exact": impact_result(&event.solution.exact),
            "contacts": event.solution.contacts.iter().map(|one| contact(scenario, &event, one)).collect::<Vec<_>>(),
        })
    };
    with_contacts.map(value).collect()
}

/// The contact as in the summary, but target and arm by index, with quantities that the page shows.
fn contact(scenario: &Scenario, event: &ImpactEvent<'_>, result: &ContactResult) -> Value {
    let ImpactContact { target, arm, law, .. } = result.contact;
    let [_, x, y] = event.before.end_effector_poses[arm];
    let [_, vx, vy] = result.response.relative_twist;
    let mut value = contact_value(scenario, result);
    value["target"] = json!(target);
    value["arm"] = json!(arm);
    value["restitution"] = json!(law.bounce().map(|(_, restitution)| restitution));
    value["end_effector"] = json!([x, y]);
    value["holds"] = json!(law.kind().holds());
    value["literal_impulse"] = json!(event.solution.paper.as_ref().and_then(|paper| paper.impulses[arm]));
    // along the inward normal of a bounce
    value["closing_speed"] = json!(law.bounce().map_or(libm::hypot(vx, vy), |([x, y], _)| -(vx * x + vy * y)));
    value
}

/// (target, arm, kind) of the contacts that a case plans; the kind is `None` where the grasp fails to close.
fn planned_contacts<'a>(
    scenario: &'a Scenario,
    case: &'a Case,
) -> impl Iterator<Item = (usize, usize, Option<ContactKind>)> + 'a {
    let targets = scenario.targets.iter().zip(&case.kinds).enumerate();
    targets.flat_map(|(i, (target, kinds))| {
        target.contacts.iter().zip(kinds).map(move |(touch, kind)| (i, touch.arm, *kind))
    })
}

/// The grasps that do not close in this case.
pub(super) fn closing_failures(scenario: &Scenario, case: &Case) -> Vec<Value> {
    let open = planned_contacts(scenario, case).filter(|(.., kind)| kind.is_none());
    open.map(|(target, arm, _)| json!({"target": target, "arm": arm})).collect()
}

/// Distances of end effectors from the targets that they are to meet over the rows of the time series, m, where
/// contacts are found by detection.
pub(super) fn distances(scenario: &Scenario, study: &Study, case: &Case, result: &CaseResult) -> Vec<Value> {
    if scenario.contact.detection == Detection::Time {
        return Vec::new();
    }
    let rows: Vec<_> = rows(study, result).collect();
    let closing = planned_contacts(scenario, case).filter(|(.., kind)| kind.is_some());
    closing
        .map(|(target, arm, _)| {
            let distances = rows.iter().map(|row| {
                let end_effector = &row.sample.end_effector_poses[arm];
                digits(signed_distance(scenario, target, &row.targets[target], end_effector).0)
            });
            json!({"target": target, "arm": arm, "distance": distances.collect::<Vec<_>>()})
        })
        .collect()
}

/// The opening of each contact that is kept closed by a constraint, over the samples of the post-impact motion: the
/// larger of the distance of the contact points, m, and, for a rigid contact, the relative rotation, rad. `null` before
/// the contact exists.
///
/// The first rigid contact of a target merges it with the last link; no constraint belongs to it.
pub(super) fn constraint_openings(study: &Study, result: &CaseResult, capture: &CaptureResult) -> Vec<Value> {
    let mut openings = Vec::new();
    let mut merged = Vec::new();
    for event in impacts(study, result) {
        let contacts = event.solution.contacts.iter().map(|result| result.contact);
        for ImpactContact { target, arm, law, .. } in contacts.filter(|contact| contact.law.kind().holds()) {
            let rigid = law.kind().holds_yaw();
            if rigid && !merged.contains(&target) {
                merged.push(target);
                continue;
            }
            let samples = &capture.post_impact.samples;
            let pose = |i: usize| relative_pose(&capture.targets[i][target], &samples[i].end_effector_poses[arm]);
            let [yaw, x, y] = pose(event.after);
            let opening = |i: usize| {
                let [now_yaw, now_x, now_y] = pose(i);
                let rotation = if rigid { (now_yaw - yaw).abs() } else { 0.0 };
                (i >= event.after).then(|| digits(libm::hypot(now_x - x, now_y - y).max(rotation)))
            };
            let column = (0..samples.len()).map(opening);
            openings.push(json!({"target": target, "arm": arm, "open": column.collect::<Vec<_>>()}));
        }
    }
    openings
}

/// Pose of an end effector in the frame of a target.
fn relative_pose(target: &Body, end_effector: &[f64; 3]) -> [f64; 3] {
    let [yaw, x, y] = target.pose;
    let [along, across] = rotated([end_effector[1] - x, end_effector[2] - y], -yaw);
    [end_effector[0] - yaw, along, across]
}
