//! What the planned path shows, the approach without tracking errors, in few steps: overlaps, joints beyond their limits,
//! torques that no joint has, targets that it leads past, and why there is none.

use super::misses;
use super::number::short;
use super::warning;
use crate::capture::approach::ApproachTracking;
use crate::capture::approach::inverse_kinematics::InverseKinematicsError;
use crate::capture::approach::terminal_rates::TerminalRatesError;
use crate::capture::clearance::{Overlap, ineffective_ignores};
use crate::capture::{Silent, Study, StudyError, study};
use crate::diagnostic::Warning;
use crate::engine::Choice;
use crate::registry::Robots;
use crate::scenario::{Actuation, Case, Detection, OnOverlap, Scenario, Tracking};
use crate::simulate::limits::LimitViolations;
use crate::simulate::stepper::Integration;
use crate::simulate::{Phase, Sample};

/// Number of steps of the planned path.
const STEPS: f64 = 200.0;
/// Most steps of a path that needs the scenario's own: a few seconds at most.
const MAX_STEPS: u64 = 20_000;
/// Most by which an end effector may turn, rad, of such a path: adaptive steps take a few seconds for it.
const MAX_TURNED: f64 = 1000.0;
/// Most distances of one case, which take some tenths of a second.
const MAX_DISTANCES: u64 = 200_000;
/// Depth of a reported overlap without a warning, m: end effectors may reach their targets a little from within.
const TOLERATED_DEPTH: f64 = 1e-3;
/// The same where an outline is a default, m, which is a coarse one.
const TOLERATED_DEFAULT: f64 = 1e-2;

/// One warning for each case in which bodies overlap before the contact, of given outlines and of default ones, and for
/// pairs in `ignore` that are not compared anyway.
///
/// # Errors
/// That of every run: goals that are not reached, or a start inside a target.
pub(super) fn warnings(scenario: &Scenario, robots: Robots<'_>) -> Result<Vec<Warning>, StudyError> {
    let ineffective = ineffective_ignores(scenario)
        .into_iter()
        .map(|(i, why)| warning(format!("clearance.ignore[{i}]"), why, "remove it, or name the pair that is meant"));
    Ok(ineffective.chain(overlaps(scenario, robots)?).collect())
}

/// That the search has ended early, at a time in s.
fn unfinished(time: f64, reason: &str) -> Warning {
    let why = format!("overlaps along the planned path were looked for only until {} s: {reason}", short(time));
    warning("approach", why, "`run` looks at all of it")
}

fn overlaps(scenario: &Scenario, robots: Robots<'_>) -> Result<Vec<Warning>, StudyError> {
    let mut planned = scenario.clone();
    let by_end_effectors = matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. });
    planned.post_impact = None;
    planned.clearance.max_distances = MAX_DISTANCES;
    // a case that stops has no depth
    planned.clearance.on_overlap = OnOverlap::Report;
    // the approaches of cases differ by the targets' motions, and by which contacts end them
    let mut seen = Vec::new();
    let mut is_new = |case: &Case| {
        let contacts: Vec<bool> = case.kinds.iter().flatten().map(Option::is_some).collect();
        let approach = (case.target_twists.clone(), contacts);
        let is_new = !seen.contains(&approach);
        seen.push(approach);
        is_new
    };
    let cases: Vec<usize> = (0..scenario.cases.len()).filter(|place| is_new(&scenario.cases[*place])).collect();
    planned.cases = cases.iter().map(|place| scenario.cases[*place].clone()).collect();
    // feedback needs the scenario's steps
    if by_end_effectors {
        let steps = ApproachTracking::new(scenario, scenario.approach.duration).steps();
        let turned = super::approach::final_rate(scenario) * scenario.approach.duration;
        let reason = if steps > MAX_STEPS {
            Some(format!("it takes {steps} steps"))
        } else {
            (turned > MAX_TURNED).then(|| format!("at its final rate an end effector turns by {} rad", short(turned)))
        };
        if let Some(reason) = reason {
            let why = format!("overlaps along the planned path were not looked for: {reason}");
            return Ok(vec![warning("approach", why, "`run` looks at all of it")]);
        }
    } else {
        planned.approach.step = planned.approach.duration / STEPS;
        planned.approach.integration = Integration::default();
        planned.approach.tracking = Tracking::InverseDynamics;
        planned.approach.actuation = Actuation::default();
        if planned.approach.trajectory.properties().starts_at_rest {
            planned.initial.joint_rates.fill(0.0);
        }
    }
    let layout = &scenario.layout;
    let (choice, _) = Choice::fastest(layout, robots);
    let make = || choice.model(layout);
    // torques are looked at where there are limits of them, and where lags are to be told
    let has_torques = !by_end_effectors && scenario.approach.actuation.torque_limits.is_some();
    let has_samples = has_torques || (!by_end_effectors && scenario.contact.detection == Detection::Event);
    let sample = if has_samples { planned.approach.step } else { planned.approach.duration };
    let result = match study(&planned, &make, sample, &mut Silent) {
        Ok(result) => result,
        Err(StudyError::ClearanceExhausted { what, .. }) => return Ok(vec![unfinished(what.time, &what.to_string())]),
        Err(StudyError::RoughPath { time, path_error, .. }) => {
            return Ok(vec![unfinished(time, &format!("the path is known to {path_error:.1e} rad or m alone"))]);
        }
        Err(error) if is_of_every_run(&error) => return Err(error),
        // what else stops a run is reported by the run
        Err(_) => return Ok(Vec::new()),
    };
    let mut warnings = bodies_inside(&result, scenario.clearance.on_overlap);
    warnings.extend(beyond_limits(scenario, &result));
    if has_torques {
        warnings.extend(beyond_torques(scenario, &result.approach));
    }
    let off_path = misses::off_path(scenario, &result, by_end_effectors);
    warnings.extend(misses::warnings(scenario, &cases, &result, off_path));
    Ok(warnings)
}

/// The overlaps of given outlines, and then those of default ones, of which no run fails.
fn bodies_inside(planned: &Study, on_overlap: OnOverlap) -> Vec<Warning> {
    let is_deep = |overlap: &Overlap| match on_overlap {
        _ if overlap.is_default => overlap.depth > TOLERATED_DEFAULT,
        OnOverlap::Report => overlap.depth > TOLERATED_DEPTH,
        OnOverlap::Fail | OnOverlap::Stop => true,
    };
    let given = "choose another approach, or an `outline` that does not go beyond the end effector where it is to touch; \
                 `clearance.ignore` says what may overlap";
    let default = "these outlines are defaults, the base a box and links segments, and no run fails by them; an `outline` of \
                   base and links in the layout is what they are";
    let of = |is_default: bool, help: &str| {
        // the same for several cases once, with their names unless it is all of them
        let mut found: Vec<(String, Vec<&str>)> = Vec::new();
        for case in &planned.cases {
            let overlaps = case.clearance.overlaps.iter().filter(|overlap| overlap.is_default == is_default);
            let deep: Vec<_> = overlaps.filter(|overlap| is_deep(overlap)).collect();
            let Some(why) = first_overlap(&deep) else { continue };
            match found.iter_mut().find(|(other, _)| *other == why) {
                Some((_, cases)) => cases.push(&case.name),
                None => found.push((why, vec![&case.name])),
            }
        }
        let in_words = |(why, cases): (String, Vec<&str>)| {
            let is_some = cases.len() < planned.cases.len();
            let names = if is_some { format!("in case `{}`: ", cases.join("`, `")) } else { String::new() };
            warning("approach", names + &why, help)
        };
        found.into_iter().map(in_words).collect::<Vec<_>>()
    };
    [of(false, given), of(true, default)].concat()
}

/// The first of some overlaps in words, and how many more there are.
fn first_overlap(overlaps: &[&Overlap]) -> Option<String> {
    let first = overlaps.iter().min_by(|a, b| a.span[0].total_cmp(&b.span[0]))?;
    let ([a, b], from, depth) = (&first.bodies, short(first.span[0]), short(first.depth));
    let more = match overlaps.len() - 1 {
        0 => String::new(),
        count => {
            let deepest = overlaps.iter().map(|overlap| overlap.depth).fold(0.0, f64::max);
            let noun = if count == 1 { "overlap" } else { "overlaps" };
            format!("; {count} more {noun} of bodies, the deepest of all by {} m", short(deepest))
        }
    };
    Some(format!("`{a}` and `{b}` are inside each other along the planned path, from {from} s and by {depth} m{more}"))
}

/// The joints whose planned motion takes larger torques than they have: the arms then lag behind it.
fn beyond_torques(scenario: &Scenario, planned: &Phase) -> Vec<Warning> {
    let limits = scenario.approach.actuation.torque_limits.iter().flatten().enumerate();
    let found = limits.filter_map(|(joint, limit)| {
        let torque = |sample: &Sample| sample.joint_torques[joint].abs();
        let peak = planned.samples.iter().max_by(|a, b| torque(a).total_cmp(&torque(b)))?;
        (torque(peak) > *limit).then(|| {
            let (name, needed) = (scenario.layout.joint_name(joint), short(torque(peak)));
            let why = format!("the planned motion takes up to {needed} N m of {name}, at {} s", short(peak.time));
            let help =
                format!("more than {needed} N m, or more time: the arm cannot follow, and meets its target elsewhere");
            warning("approach.torque_limits", why, help)
        })
    });
    found.collect()
}

/// The joints that go beyond their limits on the way or at the designed end; those of a given end have warnings at its
/// keys.
fn beyond_limits(scenario: &Scenario, planned: &Study) -> Vec<Warning> {
    if !super::approach::beyond_limits(scenario).is_empty() {
        return Vec::new();
    }
    let phases = match scenario.contact.detection {
        Detection::Event => planned.cases.iter().filter_map(|case| case.approach.as_ref()).collect(),
        Detection::Time => vec![&planned.approach],
    };
    let mut found: Vec<_> = phases
        .into_iter()
        .flat_map(|phase| phase.limit_violations.iter().flat_map(LimitViolations::sentences))
        .map(|sentence| format!("along the planned path {sentence}"))
        .collect();
    found.dedup();
    let help = "choose another trajectory or end, or more time; a run reports what goes beyond `limits`, and ends with exit code 1";
    found.into_iter().map(|why| warning("approach", why, help)).collect()
}

/// Whether an error of the planned path depends on neither steps nor the tracking law: it is that of the start, or of the
/// design of the end, which is that of exact tracking.
fn is_of_every_run(error: &StudyError) -> bool {
    match error {
        StudyError::InverseKinematics(InverseKinematicsError::Rates(error)) | StudyError::TerminalRates(error) => {
            !matches!(error, TerminalRatesError::PhaseError(_))
        }
        StudyError::Inside { .. } | StudyError::InverseKinematics(_) => true,
        _ => false,
    }
}
