//! What the page shows, as JSON: bodies, motion, targets, momentum and energy over time.

use super::impacts::{distances, holds, impacts, open};
use crate::capture::{CaseResult, Study};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::output::scene::{Motion, base_size, robot_frames};
use crate::scenario::{Case, Scenario};
use crate::simulate::system::Body;
use crate::simulate::{Phase, Sample};
use serde_json::{Value, json};

/// Everything that the page needs of a study.
pub fn data(scenario: &Scenario, study: &Study) -> Value {
    let cases = scenario.cases.iter().zip(&study.cases);
    let mut value = json!({
        "scenario": scenario.name,
        "layout": robot(&scenario.layout),
        "contact_duration": scenario.contact.duration,
        "targets": scenario.targets.iter().map(|target| json!({
            "name": target.name, "mass": target.mass, "inertia": target.inertia, "radius": target.surface.reach(),
            "polygon": match &target.surface {
                Outline::Disc { .. } => None,
                Outline::Polygon { corners } => Some(corners),
            },
        })).collect::<Vec<_>>(),
        "cases": cases.map(|(case, result)| one_case(scenario, study, case, result)).collect::<Vec<_>>(),
        "objections": study.objections(),
    });
    // where every case has an approach of its own, this one went on without contacts and is nobody's
    if study.cases.iter().any(|case| case.approach.is_none()) {
        value["approach"] = phase(&study.approach);
    }
    value
}

fn robot(layout: &Layout) -> Value {
    let arms = layout.arms.iter().map(|arm| {
        json!({
            "name": arm.name,
            "links": arm.links.iter().map(|link| json!({
                "length": link.length, "mass": link.mass, "inertia": link.inertia, "com": link.com,
            })).collect::<Vec<_>>(),
        })
    });
    let frames = robot_frames(layout).into_iter().map(|frame| {
        let joint = match frame.motion {
            Motion::Joint(joint) => Some(joint),
            _ => None,
        };
        json!({"parent": frame.parent, "pose": frame.pose, "joint": joint, "arm": frame.arm})
    });
    json!({
        "name": layout.name,
        "sha256": layout.sha256(),
        "base": {"mass": layout.base.mass, "inertia": layout.base.inertia, "size": base_size(layout)},
        "arms": arms.collect::<Vec<_>>(),
        "frames": frames.collect::<Vec<_>>(),
    })
}

fn one_case(scenario: &Scenario, study: &Study, case: &Case, result: &CaseResult) -> Value {
    let bodies = result.targets.iter().map(|target| json!({"pose": target.pose, "twist": target.twist}));
    let (momentum, energy) = result.targets_momentum();
    let mut value = json!({
        "name": result.name,
        "targets": bodies.collect::<Vec<_>>(),
        "targets_alone": {"momentum": momentum, "kinetic_energy": energy},
        "impacts": impacts(scenario, study, result),
        "closest": result.closest.iter().map(|pair| json!({
            "target": pair.target, "arm": pair.arm, "distance": pair.distance, "time": pair.time,
        })).collect::<Vec<_>>(),
        "open": open(scenario, case),
        "distances": distances(scenario, study, case, result),
    });
    if let Some(own) = &result.approach {
        value["approach"] = phase(own);
    }
    if let Some(captured) = &result.capture {
        value["post_impact"] = phase(&captured.post_impact);
        value["post_impact"]["targets"] = columns_of(result.targets.len(), &captured.targets, |body| body.pose);
        value["post_impact"]["target_twists"] = columns_of(result.targets.len(), &captured.targets, |body| body.twist);
        value["post_impact"]["holds"] = json!(holds(captured));
    }
    value
}

/// Per target three columns over the samples.
fn columns_of(targets: usize, samples: &[Vec<Body>], of: impl Fn(&Body) -> [f64; 3]) -> Value {
    let column = |i: usize, part: usize| {
        let value = |bodies: &Vec<Body>| bodies.get(i).map_or(0.0, |body| of(body)[part]);
        samples.iter().map(|bodies| digits(value(bodies))).collect::<Vec<_>>()
    };
    json!((0..targets).map(|i| [0, 1, 2].map(|part| column(i, part))).collect::<Vec<_>>())
}

/// Columns over time; what the bodies' poses follow from, and what is plotted.
fn phase(phase: &Phase) -> Value {
    let samples = &phase.samples;
    let joints = samples.first().map_or(0, |sample| sample.state.joint_angles.len());
    let end_effectors = samples.first().map_or(0, |sample| sample.end_effector_poses.len());
    let column = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(|sample| digits(of(sample))).collect::<Vec<_>>();
    let columns = |n: usize, of: &dyn Fn(&Sample, usize) -> Option<f64>| {
        (0..n).map(|i| column(&|sample| of(sample, i).unwrap_or_default())).collect::<Vec<_>>()
    };
    json!({
        "duration": phase.duration,
        "time": samples.iter().map(|sample| sample.time).collect::<Vec<_>>(),
        "base_pose": columns(3, &|sample, i| sample.state.base_pose.get(i).copied()),
        "base_twist": columns(3, &|sample, i| sample.state.base_twist.get(i).copied()),
        "joint_angles": columns(joints, &|sample, i| sample.state.joint_angles.get(i).copied()),
        "joint_rates": columns(joints, &|sample, i| sample.state.joint_rates.get(i).copied()),
        "joint_torques": columns(joints, &|sample, i| sample.joint_torques.get(i).copied()),
        "tips": (0..end_effectors).map(|arm| {
            columns(3, &|sample, i| sample.end_effector_poses.get(arm)?.get(i).copied())
        }).collect::<Vec<_>>(),
        "linear_momentum": columns(2, &|sample, i| sample.momentum.linear_momentum.get(i).copied()),
        "angular_momentum": column(&|sample| sample.momentum.angular_momentum),
        "kinetic_energy": column(&|sample| sample.momentum.kinetic_energy),
        "work": column(&|sample| sample.work.total()),
        "momentum_drift": phase.drift.momentum_drift,
        "energy_error": phase.drift.energy_error,
        "center_of_mass_drift": phase.drift.center_of_mass_drift,
        "constraint_errors": phase.constraint_errors,
    })
}

/// Six digits, more than a screen shows; the CSV has them all.
pub(super) fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
