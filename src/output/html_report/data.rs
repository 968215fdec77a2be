//! The data of the HTML report as JSON: layouts, motion, targets, impacts, momentum and energy over time.

use super::contacts::{closing_failures, constraint_openings, distances, impacts_of_case};
use super::digits;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::frames::{FrameMotion, robot_frames};
use crate::layout::Layout;
use crate::outline::Outline;
use crate::output::run_manifest::RunManifest;
use crate::output::scene::{PALETTE, hexadecimal};
use crate::output::study_part::StudyPart;
use crate::output::summary::{least_distance, overlaps};
use crate::scenario::{Case, Scenario, Variant};
use crate::simulate::system::Body;
use crate::simulate::{Phase, Sample};
use serde_json::{Value, json};

/// The data that the programs of the page read: what cases share stands with their part, and the cases are in the order of
/// the file.
pub(super) fn data(scenario: &Scenario, parts: &[StudyPart<'_>], manifest: &RunManifest) -> Value {
    let mut cases = Vec::new();
    for (i, part) in parts.iter().enumerate() {
        for (case, result) in part.scenario.cases.iter().zip(&part.study.cases) {
            let mut value = one_case(part.scenario, &part.study, case, result);
            value["part"] = json!(i);
            value["set"] = json!(part.variant.map(Variant::values));
            cases.push((case.index, value));
        }
    }
    cases.sort_by_key(|(index, _)| *index);
    json!({
        "scenario": scenario.name,
        "run": manifest.to_json(),
        "palette": PALETTE.map(hexadecimal),
        "parts": parts.iter().map(one_part).collect::<Vec<_>>(),
        "cases": cases.into_iter().map(|(_, value)| value).collect::<Vec<_>>(),
    })
}

/// Robot, targets and approach of the cases of a part, and how they were computed.
fn one_part(part: &StudyPart<'_>) -> Value {
    let StudyPart { scenario, study, manifest, dynamics, .. } = part;
    let mut run = manifest.to_json_of_case(dynamics);
    run["layout_toml"] = json!(manifest.layout_toml);
    let mut value = json!({
        "layout": robot(&scenario.layout),
        "targets": scenario.targets.iter().map(|target| json!({
            "name": target.name, "mass": target.mass, "inertia": target.inertia, "radius": target.outline.reach(),
            "polygon": match &target.outline {
                Outline::Disc { .. } => None,
                outline => Some(outline.corners()),
            },
        })).collect::<Vec<_>>(),
        "run": run,
        "objections": part.audit_failures(),
    });
    // with an approach of its own in every case, the study's approach is that without contacts
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
                "outline": link.outline.as_ref().map(Outline::corners),
            })).collect::<Vec<_>>(),
        })
    });
    let frames = robot_frames(layout).into_iter().map(|frame| {
        let joint = match frame.motion {
            FrameMotion::Joint(joint) => Some(joint),
            _ => None,
        };
        json!({"parent": frame.parent, "pose": frame.pose, "joint": joint, "arm": frame.arm})
    });
    json!({
        "name": layout.name,
        "sha256": layout.sha256(),
        "base": {"mass": layout.base.mass, "inertia": layout.base.inertia, "size": layout.default_base_size(), "outline": layout.base.outline.as_ref().map(Outline::corners)},
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
        "impacts": impacts_of_case(scenario, study, result),
        "closest": result.closest.iter().map(|pair| json!({
            "target": pair.target, "arm": pair.arm, "distance": pair.distance, "time": pair.time,
        })).collect::<Vec<_>>(),
        "least": result.clearance.least_shown().map(least_distance),
        "overlaps": overlaps(&result.clearance),
        "open": closing_failures(scenario, case),
        "distances": distances(scenario, study, case, result),
    });
    if let Some(own) = &result.approach {
        value["approach"] = phase(own);
    }
    if let Some(capture) = &result.capture {
        value["post_impact"] = phase(&capture.post_impact);
        value["post_impact"]["targets"] = target_columns(capture, |body| body.pose);
        value["post_impact"]["target_twists"] = target_columns(capture, |body| body.twist);
        value["post_impact"]["holds"] = json!(constraint_openings(study, result, capture));
    }
    value
}

/// Per target three columns over the samples of the post-impact motion.
fn target_columns(capture: &CaptureResult, vector: impl Fn(&Body) -> [f64; 3]) -> Value {
    let column = |target: usize, part: usize| {
        capture.targets.iter().map(|bodies| digits(vector(&bodies[target])[part])).collect::<Vec<_>>()
    };
    let count = capture.targets[0].len();
    (0..count).map(|target| [0, 1, 2].map(|part| column(target, part))).collect::<Vec<_>>().into()
}

/// Columns over the time of a phase.
fn phase(phase: &Phase) -> Value {
    let samples = &phase.samples;
    let (joints, arms) = (samples[0].state.joint_angles.len(), samples[0].end_effector_poses.len());
    let column =
        |value: &dyn Fn(&Sample) -> f64| samples.iter().map(|sample| digits(value(sample))).collect::<Vec<_>>();
    // with so many digits that what is constant is seen to be: the page adds the targets' part before the impact
    let conserved = |value: &dyn Fn(&Sample) -> f64| {
        let rounded = |sample| format!("{:.10e}", value(sample)).parse().unwrap_or_else(|_| value(sample));
        samples.iter().map(rounded).collect::<Vec<f64>>()
    };
    let linear_momentum = [0, 1].map(|i| conserved(&|sample| sample.momentum.linear_momentum[i]));
    let columns = |count: usize, value: &dyn Fn(&Sample, usize) -> f64| {
        (0..count).map(|i| column(&|sample| value(sample, i))).collect::<Vec<_>>()
    };
    let end_effectors = (0..arms).map(|arm| columns(3, &|sample, i| sample.end_effector_poses[arm][i]));
    json!({
        "duration": phase.duration,
        "samples": phase.sample_count(),
        "time": samples.iter().map(|sample| sample.time).collect::<Vec<_>>(),
        "base_pose": columns(3, &|sample, i| sample.state.base_pose[i]),
        "base_twist": columns(3, &|sample, i| sample.state.base_twist[i]),
        "joint_angles": columns(joints, &|sample, i| sample.state.joint_angles[i]),
        "joint_rates": columns(joints, &|sample, i| sample.state.joint_rates[i]),
        "joint_torques": columns(joints, &|sample, i| sample.joint_torques[i]),
        "end_effectors": end_effectors.collect::<Vec<_>>(),
        "linear_momentum": linear_momentum,
        "angular_momentum": conserved(&|sample| sample.momentum.angular_momentum),
        "kinetic_energy": column(&|sample| sample.momentum.kinetic_energy),
        "work": column(&|sample| sample.work.total()),
        "momentum_drift": phase.drift.momentum_drift,
        "energy_error": phase.drift.energy_error,
        "center_of_mass_drift": phase.drift.center_of_mass_drift,
        "constraint_errors": phase.constraint_errors,
    })
}
