//! `summary.json`: the results of a study under the keys that the chapter on results in docs/book documents.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::output::{run_manifest::RunManifest, summary::summary};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let (scenario, source) = Scenario::read_with_source(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let manifest = RunManifest::new(&scenario, source, "planar-capture run".to_owned());
//! let summary = summary(&scenario, "generated", &study, &manifest)?;
//! let approach = &summary["cases"][0]["approach"];
//! assert_eq!(approach["duration"], 20.0);
//! // numbers read back exactly
//! let angles: Vec<f64> = serde_json::from_value(approach["joint_angles"].clone())?;
//! assert_eq!(angles, study.approach.end().state.joint_angles);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::capture::clearance::{Clearance, LeastDistance, Overlap};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::impact::{ContactResult, ImpactResult, ImpactSolution};
use crate::capture::residual_motion::ResidualMotion;
use crate::capture::terminal_error::TerminalError;
use crate::capture::{CaseResult, Study};
use crate::output::finite::{NotFinite, finite};
use crate::output::run_manifest::RunManifest;
use crate::output::study_part::StudyPart;
use crate::scenario::Scenario;
use crate::simulate::Phase;
use crate::simulate::limits::{LimitViolation, LimitViolations};
use serde_json::{Value, json};

/// The summary of a study; `dynamics` names the implementation. Numbers read back exactly.
///
/// # Errors
/// A number that is not finite.
pub fn summary(scenario: &Scenario, dynamics: &str, study: &Study, manifest: &RunManifest) -> Result<Value, NotFinite> {
    let cases = study.cases.iter().map(|case| case_value(scenario, study, case));
    of_cases(scenario, dynamics, &cases.collect::<Vec<_>>(), manifest)
}

/// The summary of all parts of a scenario's run, its cases in the order of the file.
///
/// # Errors
/// A number that is not finite.
pub fn summary_of_parts(
    scenario: &Scenario,
    dynamics: &str,
    parts: &[StudyPart<'_>],
    manifest: &RunManifest,
) -> Result<Value, NotFinite> {
    let mut cases = Vec::new();
    for part in parts {
        for (case, result) in part.scenario.cases.iter().zip(&part.study.cases) {
            let mut value = case_value(part.scenario, &part.study, result);
            if let Some(variant) = part.variant {
                value["set"] = variant.set.iter().map(|(path, value)| (path.clone(), json!(value.to_toml()))).collect();
                value["run"] = part.manifest.to_json_of_case(part.dynamics);
            }
            cases.push((case.index, value));
        }
    }
    cases.sort_by_key(|(index, _)| *index);
    let cases: Vec<_> = cases.into_iter().map(|(_, value)| value).collect();
    of_cases(scenario, dynamics, &cases, manifest)
}

fn of_cases(scenario: &Scenario, dynamics: &str, cases: &[Value], manifest: &RunManifest) -> Result<Value, NotFinite> {
    let layout = &scenario.layout;
    finite(json!({
        "scenario": scenario.name,
        "layout": {"name": layout.name, "sha256": layout.sha256()},
        "dynamics": dynamics,
        "run": manifest.to_json(),
        "cases": cases,
    }))
}

fn case_value(scenario: &Scenario, study: &Study, case: &CaseResult) -> Value {
    let mut value = json!({"name": case.name, "approach": phase(case.approach(study), true)});
    if let Some(found) = &study.inverse_kinematics {
        value["approach"]["designed"] = json!({
            "final_joint_angles": found.joint_angles,
            "residual": found.residual,
            "rounds": found.iterations,
            "singularity_margin": found.rates.singularity_margin,
            "spare_joints": found.spare_joints,
        });
    }
    if !study.terminal_errors.is_empty() {
        let parts = |error: &Option<TerminalError>| json!(error.as_ref().map(|error| &error.parts));
        value["approach"]["missed"] = study.terminal_errors.iter().map(parts).collect();
    }
    if !case.closest.is_empty() {
        let closest = case.closest.iter().map(|pair| {
            json!({
                "target": scenario.targets[pair.target].name,
                "arm": scenario.layout.arms[pair.arm].name,
                "distance": pair.distance,
                "time": pair.time,
            })
        });
        value["closest"] = closest.collect();
    }
    value["clearance"] = clearance(&case.clearance);
    if let Some(time) = case.stopped {
        value["stopped"] = json!(time);
    }
    if let Some(captured) = &case.capture {
        value["impact"] = impact(scenario, &captured.impact);
        value["post_impact"] = phase(&captured.post_impact, false);
        if !captured.later_impacts.is_empty() {
            let later = captured.later_impacts.iter().map(|later| {
                let mut value = impact(scenario, &later.impact);
                value["time"] = json!(later.time);
                value
            });
            value["post_impact"]["impacts"] = later.collect();
        }
        if captured.penetration > 0.0 {
            value["post_impact"]["penetration"] = json!(captured.penetration);
        }
        if let Some(residual) = &captured.residual_motion {
            value["post_impact"]["remainder"] = residual_motion(residual);
        }
    }
    value
}

/// Least distances and overlaps; `null` where all bodies are joined.
fn clearance(clearance: &Clearance) -> Value {
    let Some(mut value) = clearance.least.as_ref().map(least_distance) else { return Value::Null };
    value["first_overlap"] = json!(clearance.overlaps.first().map(|overlap| overlap.span[0]));
    value["besides_contacts"] = json!(clearance.besides_contacts.as_ref().map(least_distance));
    value["overlaps"] = overlaps(clearance);
    value["evaluations"] = json!(clearance.evaluations);
    value
}

/// Which bodies, how near and when.
pub(super) fn least_distance(LeastDistance { distance, time, bodies }: &LeastDistance) -> Value {
    json!({"least_distance": distance, "time": time, "bodies": bodies})
}

/// All overlaps of a case.
pub(super) fn overlaps(clearance: &Clearance) -> Value {
    let overlaps = clearance.overlaps.iter().map(|Overlap { bodies, span: [from, to], depth, is_default }| {
        json!({"bodies": bodies, "from": from, "to": to, "depth": depth, "default_outline": is_default})
    });
    overlaps.collect()
}

fn impact(scenario: &Scenario, impact: &ImpactSolution) -> Value {
    json!({
        "exact": impact_result(&impact.exact),
        "paper": impact.paper.as_ref().map(impact_result),
        "contacts": impact.contacts.iter().map(|contact| contact_value(scenario, contact)).collect::<Vec<_>>(),
    })
}

/// The state at the end of a phase, and its audit.
fn phase(phase: &Phase, end_effectors: bool) -> Value {
    let end = phase.end();
    let mut value = json!({
        "duration": phase.duration,
        "base_pose": end.state.base_pose,
        "base_twist": end.state.base_twist,
        "joint_angles": end.state.joint_angles,
        "joint_rates": end.state.joint_rates,
    });
    if end_effectors {
        value["end_effector_poses"] = json!(end.end_effector_poses);
        value["end_effector_twists"] = json!(end.end_effector_twists);
    }
    value["momentum_drift"] = json!(phase.drift.momentum_drift);
    value["energy_error"] = json!(phase.drift.energy_error);
    value["center_of_mass_drift"] = json!(phase.drift.center_of_mass_drift);
    value["path_error"] = json!(phase.path_error);
    if phase.constraint_errors.iter().any(|error| *error > 0.0) {
        value["constraint_errors"] = json!(phase.constraint_errors);
    }
    if let Some(margin) = phase.singularity_margin {
        value["singularity_margin"] = json!(margin);
    }
    if let Some(LimitViolations { joint_angle, joint_rate }) = &phase.limit_violations {
        let [joint_angle, joint_rate] = [joint_angle, joint_rate].map(|largest| largest.as_ref().map(violation));
        value["limits"] = json!({"joint_angle": joint_angle, "joint_rate": joint_rate});
    }
    if !phase.saturation.joints.is_empty() {
        value["joints_saturated"] = json!(phase.saturation.joints);
    }
    if end.base_torque.is_some() {
        value["base_impulse"] = json!(end.work.base_impulse);
        value["base_work"] = json!(end.work.base_work);
        value["base_saturated"] = json!(phase.saturation.base);
    }
    value
}

fn violation(violation: &LimitViolation) -> Value {
    let LimitViolation { joint, time, value, limit } = violation;
    json!({"joint": joint, "time": time, "value": value, "limit": limit})
}

/// One contact, with target and arm by name.
pub(super) fn contact_value(scenario: &Scenario, result: &ContactResult) -> Value {
    let ImpactContact { target, arm, law, offset, miss } = result.contact;
    let response = &result.response;
    let mut value = json!({
        "target": scenario.targets[target].name,
        "arm": scenario.layout.arms[arm].name,
        "kind": law.kind().name(),
        "offset": offset,
        "miss": miss,
        "impulse": result.impulse,
        "relative_twist": response.relative_twist,
        "direction": response.direction,
        "effective_masses": response.effective_masses,
        "impulse_index": response.impulse_index,
        "impulse_ellipse": {
            "semi_axes": response.impulse_ellipse.semi_axes,
            "direction": response.impulse_ellipse.direction,
        },
        "extended_inverse_inertia": response.inverse_inertia.0,
    });
    if let Some(duration) = scenario.contact.duration {
        value["mean_force"] = json!(result.impulse.map(|part| part / duration));
    }
    value
}

fn residual_motion(residual: &ResidualMotion) -> Value {
    json!({
        "control": residual.control,
        "momentum": residual.momentum,
        "velocity": residual.velocity,
        "inertia": residual.inertia,
        "rigid_rate": residual.rigid_rate,
        "base_rate": residual.base_rate,
        "largest_joint_rate": residual.largest_joint_rate,
        "wheel_rates": residual.wheel_rates,
    })
}

/// The solution of one impact by one model.
pub(super) fn impact_result(result: &ImpactResult) -> Value {
    json!({
        "joint_rates_after": result.joint_rates_after,
        "base_twist_after": result.base_twist_after,
        "target_twists_after": result.target_twists_after,
        "impulses": result.impulses,
        "impulse_magnitudes": result.impulse_magnitudes(),
        "momentum_jump": result.momentum_jump,
        "kinetic_energy_before": result.kinetic_energy_before,
        "kinetic_energy_after": result.kinetic_energy_after,
    })
}
