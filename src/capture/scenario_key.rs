//! The key of the scenario that an error of its study is about, for a message at its place in the file.
//!
//! # Example
//! ```
//! use planar_capture::capture::StudyError;
//! use planar_capture::simulate::PhaseError;
//! use planar_capture::{error::Error, registry, scenario::Scenario};
//!
//! let path = "scenarios/spinning_target.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let source = Error::Tolerance { tolerance: 1e-10, step: 1e-12 };
//! let key = StudyError::Approach(PhaseError { time: 2.5, source }).key(&scenario);
//! // the file leaves it at its default
//! assert_eq!((key.path.as_str(), key.value.as_str()), ("approach.tolerance", "1e-10"));
//! ```

use crate::capture::StudyError;
use crate::capture::approach::inverse_kinematics::InverseKinematicsError;
use crate::capture::approach::terminal_rates::TerminalRatesError;
use crate::capture::clearance::Exhausted;
use crate::diagnostic::{Report, report_error};
use crate::error::Error;
use crate::scenario::{Approach, Case, PostCaptureControl, PostImpact, Scenario, Tracking, contact_name};
use crate::simulate::PhaseError;
use crate::simulate::stepper::{Integration, Integrator};

/// Convex parts of an outline that are more than its motion needs.
const MANY_PARTS: usize = 20;

/// A key and what the scenario has for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioKey {
    /// From the root: `target[0].position`.
    pub path: String,
    /// Its value, for a file that leaves it at its default.
    pub value: String,
}

impl StudyError {
    /// The error at its key in the text of the scenario, which is called `file`.
    ///
    /// # Panics
    /// For the scenario of another study.
    #[must_use]
    pub fn report(&self, scenario: &Scenario, text: &str, file: &str, help: Option<String>) -> Report {
        let ScenarioKey { path, value } = self.key(scenario);
        report_error(text, file, (&path, &value), &self.to_string(), help)
    }

    /// The phase that was stopped, by the name of its table in scenarios, and when and why; `None` for other errors.
    #[must_use]
    pub fn stopped(&self) -> Option<(&'static str, &PhaseError)> {
        match self {
            Self::Approach(stopped) => Some(("approach", stopped)),
            Self::PostImpact { source, .. } => Some(("post_impact", source)),
            _ => None,
        }
    }

    /// Whether a valid simulation broke down; else the scenario has no result.
    #[must_use]
    pub fn is_breakdown(&self) -> bool {
        matches!(self, Self::RoughPath { .. } | Self::ClearanceExhausted { .. })
            || self.stopped().is_some_and(|(_, stopped)| !stopped.is_misuse())
    }

    /// The key to change, or the first of several.
    ///
    /// # Panics
    /// For the scenario of another study.
    #[must_use]
    pub fn key(&self, scenario: &Scenario) -> ScenarioKey {
        match self {
            Self::NoLaw { name, key: path } => key(*path, *name),
            Self::TerminalRates(error) | Self::InverseKinematics(InverseKinematicsError::Rates(error)) => {
                terminal_rates(scenario, error)
            }
            Self::InverseKinematics(InverseKinematicsError::OutOfReach { arm, .. }) => {
                let arm = scenario.layout.arms.iter().position(|other| other.name == *arm);
                let arm = arm.expect("the error names an arm of the layout");
                key(format!("approach.final_end_effector_poses[{arm}]"), "none")
            }
            Self::InverseKinematics(InverseKinematicsError::NotConverged { .. }) => {
                key("approach.final_end_effector_poses", "none")
            }
            Self::Approach(stopped) => of_approach(scenario, stopped),
            Self::Inside { target, .. } => key(format!("target[{}].position", index(scenario, target)), "none"),
            Self::ClearanceExhausted { case, what } => most_distances(scenario, case, what),
            Self::RoughPath { table, .. } => {
                let after = scenario.post_impact.as_ref().filter(|_| *table == "post_impact");
                let step = after.map_or(scenario.approach.step, |after| after.step);
                key(format!("{table}.step"), format!("{step:?}"))
            }
            Self::PathFile { .. } => key("approach.duration", format!("{:?}", scenario.approach.duration)),
            Self::Chatter { case, target, .. } => restitution(scenario, case, target),
            Self::Impact { case, .. } => contact_kind(scenario, case),
            Self::PostImpact { source, .. } => {
                let after = scenario.post_impact.as_ref().expect("an error of the phase");
                of_post_impact(after, source)
            }
        }
    }
}

/// Of the pair with the most distances the outline of many parts; else the twist of a target that turns.
fn most_distances(scenario: &Scenario, case: &str, what: &Exhausted) -> ScenarioKey {
    let target = |body: &String| body.strip_prefix("targets/").map(|name| index(scenario, name));
    let targets: Vec<_> = what.bodies.iter().map(target).zip(what.parts).collect();
    if let Some((Some(i), _)) = targets.iter().find(|(target, parts)| target.is_some() && *parts >= MANY_PARTS) {
        return key(format!("target[{i}].polygon"), "none");
    }
    let twist = |i: usize| case_of(scenario, case).map_or([0.0; 3], |(_, case)| case.target_twists[i]);
    let turning = targets.iter().filter_map(|(target, _)| *target).max_by(|a, b| {
        let [a, b] = [*a, *b].map(|i| twist(i)[0].abs());
        a.total_cmp(&b)
    });
    turning.map_or_else(|| key("approach", ""), |i| key(format!("target[{i}].twist"), format!("{:?}", twist(i))))
}

fn key(path: impl Into<String>, value: impl Into<String>) -> ScenarioKey {
    ScenarioKey { path: path.into(), value: value.into() }
}

fn terminal_rates(scenario: &Scenario, error: &TerminalRatesError) -> ScenarioKey {
    match error {
        TerminalRatesError::PhaseError(stopped) => of_approach(scenario, stopped),
        TerminalRatesError::Diverged { .. }
        | TerminalRatesError::Unreachable { .. }
        | TerminalRatesError::NotConverged { .. } => key("approach.final_end_effector_twists", "none"),
    }
}

fn of_approach(scenario: &Scenario, stopped: &PhaseError) -> ScenarioKey {
    let Approach { step, integration, .. } = scenario.approach;
    let gain = match &scenario.approach.tracking {
        Tracking::InverseDynamics => None,
        // only the law knows its gains
        Tracking::Own { name, .. } => Some(("tracking", (*name).to_owned())),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain }
        | Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            stiffer(proportional_gain, derivative_gain).map(shown)
        }
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, .. } if rate_gain > pose_gain => {
            Some(shown(("rate_gain", *rate_gain)))
        }
        Tracking::ResolvedMotionRate { pose_gain, .. } => Some(shown(("pose_gain", *pose_gain))),
    };
    of_phase("approach", step, integration, gain, stopped)
}

fn of_post_impact(after: &PostImpact, stopped: &PhaseError) -> ScenarioKey {
    let gain = match &after.control {
        PostCaptureControl::None => None,
        PostCaptureControl::Own { name, .. } => Some(("control", (*name).to_owned())),
        PostCaptureControl::Hold { proportional_gain, derivative_gain } => {
            stiffer(proportional_gain, derivative_gain).map(shown)
        }
        PostCaptureControl::Damping { derivative_gain } => stiffer(&[], derivative_gain).map(shown),
        PostCaptureControl::Stabilise { derivative_gain, base_gain, .. } => {
            let damping = stiffer(&[], derivative_gain).filter(|(_, gain)| gain >= base_gain);
            Some(shown(damping.unwrap_or(("base_gain", *base_gain))))
        }
    };
    of_phase("post_impact", after.step, after.integration, gain, stopped)
}

/// The key and the largest of those gains that make the shorter time constants of a unit inertia.
fn stiffer(proportional: &[f64], derivative: &[f64]) -> Option<(&'static str, f64)> {
    let [proportional, derivative] = [proportional, derivative].map(|gains| gains.iter().copied().reduce(f64::max));
    let damping = derivative.map(|gain| ("derivative_gain", gain));
    match proportional {
        Some(gain) if gain.sqrt() > derivative.unwrap_or(0.0) => Some(("proportional_gain", gain)),
        _ => damping,
    }
}

fn shown((name, gain): (&'static str, f64)) -> (&'static str, String) {
    (name, format!("{gain:?}"))
}

/// What the hint of a phase that stopped names. The steps of an adaptive integrator are not those of the phase: what makes
/// them short is the gain of a control, or a law of the program's own, at the key that names it.
fn of_phase(
    table: &str,
    step: f64,
    integration: Integration,
    gain: Option<(&'static str, String)>,
    stopped: &PhaseError,
) -> ScenarioKey {
    match (stopped.source, integration.integrator) {
        (Error::UnsupportedBodies { .. }, _) => key(format!("{table}.coordinates"), "full"),
        (Error::ContinuousMemory, _) => key(format!("{table}.sample_time"), "none"),
        (Error::Tolerance { .. }, Integrator::Adaptive { tolerance }) => {
            key(format!("{table}.tolerance"), format!("{tolerance:e}"))
        }
        (_, Integrator::Adaptive { tolerance }) => match gain {
            Some((name, gain)) => key(format!("{table}.{name}"), gain),
            None => key(format!("{table}.tolerance"), format!("{tolerance:e}")),
        },
        _ => key(format!("{table}.step"), format!("{step:?}")),
    }
}

/// Index of the target of this name.
fn index(scenario: &Scenario, target: &str) -> usize {
    scenario.targets.iter().position(|other| other.name == target).unwrap_or_default()
}

/// Index in the file and content of the case of this name.
fn case_of<'a>(scenario: &'a Scenario, case: &str) -> Option<(usize, &'a Case)> {
    scenario.cases.iter().map(|case| (case.index, case)).find(|(_, other)| other.name == case)
}

/// The restitution of a target: the case's own, or the target's.
fn restitution(scenario: &Scenario, case: &str, name: &str) -> ScenarioKey {
    let i = index(scenario, name);
    let of_target = scenario.targets[i].restitution;
    let own = case_of(scenario, case).map(|(k, case)| (k, case.restitutions[i]));
    match own.filter(|(_, own)| own.to_bits() != of_target.to_bits()) {
        Some((k, own)) => key(format!("case[{k}].restitutions.{name}"), own.to_string()),
        None => key(format!("target[{i}].restitution"), of_target.to_string()),
    }
}

/// The kind of contact of the first target that a case touches: the case's own, or the target's.
fn contact_kind(scenario: &Scenario, case: &str) -> ScenarioKey {
    let touched = case_of(scenario, case).and_then(|(k, case)| {
        let i = case.kinds.iter().position(|kinds| kinds.iter().any(Option::is_some))?;
        Some((k, i, &case.kinds[i]))
    });
    let Some((k, i, kinds)) = touched else { return key("target", "none") };
    let target = &scenario.targets[i];
    let names = kinds.iter().map(|kind| contact_name(*kind)).collect::<Vec<_>>().join(", ");
    if target.contacts.iter().map(|contact| contact.kind).eq(kinds.iter().copied()) {
        key(format!("target[{i}].kind"), names)
    } else {
        key(format!("case[{k}].kinds.{}", target.name), names)
    }
}

#[cfg(test)]
mod tests;
