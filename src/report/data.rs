//! What the page shows, as JSON: bodies, motion, targets, momentum and energy over time.

use crate::layout::Layout;
use crate::scenario::Scenario;
use crate::simulate::system::Body;
use crate::simulate::{Phase, Sample};
use crate::study::capture::ImpactResult;
use crate::study::{CaseResult, Study};
use crate::surface::Surface;
use serde_json::{Value, json};

/// Everything that the page needs of a study.
pub fn data(scenario: &Scenario, study: &Study) -> Value {
    let cases = study.cases.iter().map(|result| one_case(study, result));
    json!({
        "scenario": scenario.name,
        "layout": robot(&scenario.layout),
        "approach": phase(&study.approach),
        "targets": scenario.targets.iter().map(|target| json!({
            "name": target.name, "mass": target.mass, "inertia": target.inertia, "radius": target.surface.reach(),
            "polygon": match &target.surface {
                Surface::Disc { .. } => None,
                Surface::Polygon { corners } => Some(corners),
            },
        })).collect::<Vec<_>>(),
        "cases": cases.collect::<Vec<_>>(),
        "objections": study.objections(),
    })
}

fn robot(layout: &Layout) -> Value {
    let arms = layout.arms.iter().map(|arm| {
        json!({
            "name": arm.name,
            "mount": arm.mount,
            "mount_angle": arm.mount_angle,
            "links": arm.links.iter().map(|link| json!({
                "length": link.length, "mass": link.mass, "inertia": link.inertia, "com": link.com,
            })).collect::<Vec<_>>(),
        })
    });
    json!({
        "name": layout.name,
        "sha256": layout.sha256(),
        "base": {"mass": layout.base.mass, "inertia": layout.base.inertia},
        "arms": arms.collect::<Vec<_>>(),
    })
}

fn one_case(study: &Study, result: &CaseResult) -> Value {
    let bodies = |targets: &[Body]| -> Vec<_> {
        targets.iter().map(|target| json!({"pose": target.pose, "twist": target.twist})).collect()
    };
    let mut value = json!({"name": result.name, "targets": bodies(&result.targets)});
    if let Some(own) = &result.approach {
        value["approach"] = phase(own);
    }
    if let (Some(captured), Some(end)) = (&result.capture, result.approach(study).end()) {
        value["impact"] = json!({
            "time": result.approach(study).duration,
            "tips": end.end_effector_poses.iter().map(short).collect::<Vec<_>>(),
            "exact": impact(&captured.impact.exact),
            "paper": captured.impact.paper.as_ref().map(impact),
        });
        value["post_impact"] = phase(&captured.post_impact);
        let column = |i: usize, part: usize| {
            let of = |targets: &Vec<Body>| targets.get(i).map_or(0.0, |target| target.pose[part]);
            captured.targets.iter().map(|targets| digits(of(targets))).collect::<Vec<_>>()
        };
        let poses = (0..result.targets.len()).map(|i| [column(i, 0), column(i, 1), column(i, 2)]);
        value["post_impact"]["targets"] = json!(poses.collect::<Vec<_>>());
        value["targets_alone"] = targets_alone(&result.targets);
    }
    value
}

fn impact(result: &ImpactResult) -> Value {
    json!({
        "impulses": result.impulses,
        "momentum_jump": result.momentum_jump,
        "kinetic_energy_before": result.kinetic_energy_before,
        "kinetic_energy_after": result.kinetic_energy_after,
    })
}

/// Momentum [l, px, py] and energy of the targets before they are touched, which nothing changes.
fn targets_alone(targets: &[Body]) -> Value {
    let (mut momentum, mut energy) = ([0.0; 3], 0.0);
    for target in targets {
        let (part, own) = target.momentum();
        momentum = std::array::from_fn(|i| momentum[i] + part[i]);
        energy += own;
    }
    json!({"momentum": momentum, "kinetic_energy": energy})
}

/// Columns over time; what the bodies' poses follow from, and what is plotted.
fn phase(phase: &Phase) -> Value {
    let samples = &phase.samples;
    let joints = samples.first().map_or(0, |sample| sample.motion.joint_angles.len());
    let tips = samples.first().map_or(0, |sample| sample.end_effector_poses.len());
    let column = |of: &dyn Fn(&Sample) -> f64| samples.iter().map(|sample| digits(of(sample))).collect::<Vec<_>>();
    let columns = |n: usize, of: &dyn Fn(&Sample, usize) -> Option<f64>| {
        (0..n).map(|i| column(&|sample| of(sample, i).unwrap_or_default())).collect::<Vec<_>>()
    };
    json!({
        "duration": phase.duration,
        "time": column(&|sample| sample.time),
        "base_pose": columns(3, &|sample, i| sample.motion.base_pose.get(i).copied()),
        "base_twist": columns(3, &|sample, i| sample.motion.base_twist.get(i).copied()),
        "joint_angles": columns(joints, &|sample, i| sample.motion.joint_angles.get(i).copied()),
        "joint_rates": columns(joints, &|sample, i| sample.motion.joint_rates.get(i).copied()),
        "joint_torques": columns(joints, &|sample, i| sample.joint_torques.get(i).copied()),
        "tips": (0..tips).map(|arm| {
            columns(3, &|sample, i| sample.end_effector_poses.get(arm)?.get(i).copied())
        }).collect::<Vec<_>>(),
        "linear_momentum": columns(2, &|sample, i| sample.linear_momentum.get(i).copied()),
        "angular_momentum": column(&|sample| sample.angular_momentum),
        "kinetic_energy": column(&|sample| sample.kinetic_energy),
        "work": column(&|sample| sample.work),
        "momentum_drift": phase.drift.momentum_drift,
        "energy_error": phase.drift.energy_error,
    })
}

fn short(pose: &[f64; 3]) -> [f64; 3] {
    pose.map(digits)
}

/// Six digits, more than a screen shows; the CSV has them all.
fn digits(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}
