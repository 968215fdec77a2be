//! What to say about a scenario without a result.

use super::number::short;
use super::stiffness::help_with_gains;
use crate::capture::StudyError;
use crate::capture::approach::inverse_kinematics::InverseKinematicsError;
use crate::capture::approach::terminal_rates::TerminalRatesError;
use crate::capture::scenario_key::ScenarioKey;
use crate::diagnostic::{Report, report_error, report_without_place};
use crate::laws::Laws;
use crate::scenario::{Scenario, Source, Variant};
use crate::simulate::Timing;

/// The error of a study at its key in the scenario, of which `source` is the text, or at the values that a `variant` of it
/// has of its own; where a phase broke down, with what would help if its gains are too high. No key is at fault where the
/// system has no place for a path.
///
/// # Panics
/// For the scenario of another study.
#[must_use]
pub fn study_report(error: &StudyError, scenario: &Scenario, variant: Option<&Variant>, source: &Source) -> Report {
    if let StudyError::PathFile { .. } = error {
        let help =
            "set `TMPDIR` to a folder that can be written to and has space; a shorter phase needs less".to_owned();
        return report_without_place(error.to_string(), help);
    }
    let help = error.stopped().and_then(|(phase, _)| {
        let [tracking, post_capture] = scenario.own_laws();
        let own = if phase == "approach" { tracking } else { post_capture };
        own.map_or_else(|| help_with_gains(scenario, phase), |_| Some(help_with_law(scenario, phase)))
    });
    let Some(variant) = variant else { return error.report(scenario, &source.text, &source.file, help) };
    let ScenarioKey { path, .. } = error.key(scenario);
    let why = format!("with these values, `{path}`: {error}");
    report_error(&source.text, &source.file, (&variant.key(), "none"), &why, help)
}

/// The same where the phase that broke down, or a design for it, was under one of the `laws` that were handed to the study in place of
/// those that the scenario names: no key of the scenario is at fault then. `None` for other errors.
#[must_use]
pub fn law_report(error: &StudyError, scenario: &Scenario, laws: Laws<'_>) -> Option<Report> {
    let (phase, stopped) = match error {
        // designs try approaches
        StudyError::TerminalRates(TerminalRatesError::PhaseError(stopped))
        | StudyError::InverseKinematics(InverseKinematicsError::Rates(TerminalRatesError::PhaseError(stopped))) => {
            ("approach", stopped)
        }
        _ => error.stopped()?,
    };
    let is_under_law = if phase == "approach" { laws.tracking.is_some() } else { laws.post_capture.is_some() };
    let is_of_law = is_under_law && !stopped.is_misuse();
    is_of_law.then(|| report_without_place(error.to_string(), help_with_law(scenario, phase)))
}

/// What helps where a phase breaks down under a law that is no shipped one, whose gains are not known.
fn help_with_law(scenario: &Scenario, phase: &str) -> String {
    let Scenario { approach, post_impact, .. } = scenario;
    let after = post_impact.as_ref().filter(|_| phase == "post_impact");
    let (duration, step, actuation) = after.map_or((approach.duration, approach.step, &approach.actuation), |after| {
        (after.duration, after.step, &after.actuation)
    });
    match actuation.steps_per_sample {
        Some(steps) => {
            let sample_time = f64::from(steps) * Timing::of_steps(duration, step).step_length();
            format!(
                "the law's torques change too fast for its sample time, {} s, in which they are held: use smaller gains in \
                 the law, or a shorter sample time",
                short(sample_time)
            )
        }
        None => "the law's torques change too fast with the state: use smaller gains in the law".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::laws::TrackingLaw;
    use crate::registry;
    use crate::scenario::{LawNumbers, Tracking};
    use crate::simulate::PhaseError;
    use std::path::Path;

    fn paper() -> (Scenario, Source) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/raina_shah_2017.toml");
        let (scenario, source) = Scenario::read_with_source(&file, registry::SHIPPED).expect("a scenario");
        (scenario, source.scenario)
    }

    /// A law in place of the scenario's has gains of its own: what breaks down under it is said of the law, at no key. One that the
    /// scenario names is said to be at fault where it is named, or at the step.
    #[test]
    fn what_breaks_down_under_a_law_of_ones_own() {
        let (mut scenario, source) = paper();
        let stopped = |source| PhaseError { time: 2.5, source };
        let steps = stopped(Error::Steps { step: 8.2e-6, needed: 2.4e6, most: 1e6 });
        // any law will do
        let exact = Tracking::InverseDynamics;
        let handed = Laws { tracking: Some(&exact as &dyn TrackingLaw), post_capture: None };
        let approach = StudyError::Approach(steps);
        let design = StudyError::TerminalRates(TerminalRatesError::PhaseError(steps));
        scenario.approach.actuation.steps_per_sample = Some(2);
        for error in [&approach, &design] {
            let text = law_report(error, &scenario, handed).expect("a report").to_string();
            for part in ["at t = 2.5 s: steps have shrunk to some 8.2e-6 s", "too fast for its sample time, 0.01 s"] {
                assert!(text.contains(part), "{text}");
            }
            assert!(!text.contains("-->") && !text.contains("derivative_gain"), "{text}");
            assert!(law_report(error, &scenario, Laws::default()).is_none());
        }
        let after = StudyError::PostImpact { case: "case1".to_owned(), source: steps };
        assert!(law_report(&after, &scenario, handed).is_none(), "that phase has the scenario's control");
        let misuse = StudyError::Approach(stopped(Error::UnsupportedBodies { count: 1 }));
        assert!(law_report(&misuse, &scenario, handed).is_none());

        scenario.approach.tracking = Tracking::Own { name: "late", numbers: LawNumbers::default() };
        let text = study_report(&approach, &scenario, None, &source).to_string();
        assert!(text.contains("too fast for its sample time, 0.01 s"), "{text}");
        scenario.approach.actuation.steps_per_sample = None;
        let text = study_report(&approach, &scenario, None, &source).to_string();
        assert!(text.contains("too fast with the state"), "{text}");
    }

    /// Where the system has no place for a path, no key of the scenario is at fault.
    #[test]
    fn no_key_is_named_where_the_system_has_no_place() {
        let (scenario, source) = paper();
        let (case, reason) = ("case1".to_owned(), "no space left".to_owned());
        let text = study_report(&StudyError::PathFile { case, reason }, &scenario, None, &source).to_string();
        assert!(
            text.starts_with("error: case `case1`: the path of a long phase") && text.contains("`TMPDIR`"),
            "{text}"
        );
        assert!(!text.contains("-->"), "{text}");
    }
}
