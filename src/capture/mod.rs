//! A study: simulates a scenario's approach, then for every case the impact, eqs. (10) to (17), and the motion after
//! it.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, study};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/spinning_target.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! assert!(study.audit_failures().is_empty());
//! // the capture is inelastic: momentum stays, energy is lost
//! let impact = &study.cases[0].capture.as_ref().expect("a capture").impact.exact;
//! assert!(impact.relative_momentum_jump < 1e-12);
//! assert!(impact.kinetic_energy_after < impact.kinetic_energy_before);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod approach;
pub mod assembly;
pub mod clearance;
pub mod contact_at_time;
pub mod contact_detection;
mod contact_pair;
pub mod contact_response;
pub mod heavy_target;
pub mod impact;
mod origin;
pub mod post_capture;
mod proximity;
pub(crate) mod reach;
pub(crate) mod reduced_matrices;
pub mod residual_motion;
pub mod scenario_key;
mod sequence;
pub mod step_advice;
mod target_motion;
pub mod terminal_error;

use crate::capture::approach::ApproachTracking;
use crate::capture::approach::inverse_kinematics::{
    InverseKinematics, InverseKinematicsError, check_reach, inverse_kinematics,
};
use crate::capture::approach::terminal_rates::{TerminalRates, TerminalRatesError, terminal_rates};
use crate::capture::clearance::{Clearance, ClosestApproach, Exhausted};
use crate::capture::heavy_target::HeavyTarget;
use crate::capture::impact::{ImpactResult, ImpactSolution};
use crate::capture::origin::Origin;
use crate::capture::residual_motion::ResidualMotion;
use crate::capture::sequence::CaptureSequence;
use crate::capture::terminal_error::TerminalError;
use crate::laws::{Laws, NamedLaws, OwnLaws, RegisteredLaw};
use crate::owned::CloneModel;
use crate::plain_text::count;
use crate::scalar::Real;
use crate::scenario::{Detection, FinalRates, Scenario, Tracking};
pub use crate::simulate::conservation::CENTER_OF_MASS_BOUND;
use crate::simulate::event::NoEvents;
use crate::simulate::limits::LimitViolations;
use crate::simulate::path::Path;
use crate::simulate::system::Body;
use crate::simulate::{Phase, PhaseError};
use std::cmp::Ordering;

/// Largest momentum drift of a phase that passes the audit.
pub const MOMENTUM_BOUND: f64 = 1e-9;
/// Largest energy error of a phase that passes the audit.
pub const ENERGY_BOUND: f64 = 1e-6;

/// Largest estimated error of a path that passes the audit, rad or m.
pub const PATH_BOUND: f64 = 1e-4;

/// Largest distance of a goal of resolved motion rate control from the robot's COM over what can be reached.
const FARTHEST_GOAL: f64 = 1e3;

/// Most overlaps of a case that the audit names one by one.
const NAMED_OVERLAPS: usize = 10;

/// Largest constraint error that passes the audit, rad or m, and its largest rate.
pub const CONSTRAINT_BOUND: f64 = 1e-10;

/// Largest penetration of a target by an end effector that does not hold it, m.
pub const PENETRATION_BOUND: f64 = 1e-6;

/// What to compute in place of a bounce that comes to rest on its target.
const INSTEAD: &str = "contacts at rest are not modelled; `kind = \"pin\"` or `\"rigid\"` holds what stays in contact, a larger \
                       `restitution` lets it go, and a shorter `post_impact.duration` ends before it comes to rest";

/// Makes a model of the robot without targets.
pub type ModelFactory<'a> = &'a dyn Fn() -> Box<dyn CloneModel>;

/// The results of one scenario.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Study {
    /// Of the approach, where end effector twists are given.
    pub terminal_rates: Option<TerminalRates>,
    /// Of the approach, where end effector poses are given and the joint trajectory is to reach them.
    pub inverse_kinematics: Option<InverseKinematics>,
    /// The approach of all cases; with contact detection, that without contacts.
    pub approach: Phase,
    /// Its errors from the desired end effector poses, one per arm; empty where none are given.
    pub terminal_errors: Vec<Option<TerminalError>>,
    /// One per case, in the scenario's order.
    pub cases: Vec<CaseResult>,
}

/// The results of one case.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CaseResult {
    /// Its name.
    pub name: String,
    /// With contact detection, the approach up to the first contact; else `None`.
    pub approach: Option<Phase>,
    /// The targets at the end of the approach, before the impact.
    pub targets: Vec<Body>,
    /// With contact detection, the planned contacts that were not made.
    pub closest: Vec<ClosestApproach>,
    /// Of all bodies, over approach and post-impact motion.
    pub clearance: Clearance,
    /// The time at which an overlap ended the case, where the scenario wants it, s since the start of the approach.
    pub stopped: Option<f64>,
    /// Impact and post-impact motion; `None` without targets, and where no end effector met its target.
    pub capture: Option<CaptureResult>,
}

/// An impact after the first one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LaterImpact {
    /// Since the first impact, s.
    pub time: f64,
    /// The impact.
    pub impact: ImpactSolution,
}

/// A capture and the motion after it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CaptureResult {
    /// The first impact, by the exact and the paper's equations.
    pub impact: ImpactSolution,
    /// The motion of robot and targets from the exact velocities.
    pub post_impact: Phase,
    /// The targets at each of its samples.
    pub targets: Vec<Vec<Body>>,
    /// Impacts after the first one, where contacts are found by detection.
    pub later_impacts: Vec<LaterImpact>,
    /// Largest penetration of a target by an end effector that does not hold it, m.
    pub penetration: f64,
    /// What is held at the end, where that is far heavier than the robot; else `None`.
    pub heavy_target: Option<HeavyTarget>,
    /// The residual motion at the end; `None` without control, as in the paper.
    pub residual_motion: Option<ResidualMotion>,
}

impl CaptureResult {
    /// All impacts, in their order.
    pub fn impacts(&self) -> impl Iterator<Item = &ImpactSolution> {
        std::iter::once(&self.impact).chain(self.later_impacts.iter().map(|later| &later.impact))
    }
}

/// Why a study has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StudyError {
    /// The scenario names a control law of the program's own, which was not handed to the study.
    #[error("the law `{name}` is not a shipped one, and was not handed to the study: `study_with` takes it")]
    NoLaw {
        /// Its name.
        name: &'static str,
        /// The key that names it: `approach.tracking` or `post_impact.control`.
        key: &'static str,
    },
    /// The terminal rates could not be computed.
    #[error(transparent)]
    TerminalRates(#[from] TerminalRatesError),
    /// The final joint angles could not be computed.
    #[error(transparent)]
    InverseKinematics(#[from] InverseKinematicsError),
    /// The approach stopped.
    #[error("the approach stopped {0}")]
    Approach(PhaseError),
    /// An end effector is inside its target when the approach begins.
    #[error(
        "case `{case}`: the end effector of arm `{arm}` starts {} m inside target `{target}`; contacts that are found by \
         detection begin apart",
        metres(*depth)
    )]
    Inside {
        /// The case's name.
        case: String,
        /// The arm's.
        arm: String,
        /// The target's.
        target: String,
        /// m.
        depth: f64,
    },
    /// There are too many distances to compute.
    #[error(
        "case `{case}`: the clearance was not computed to the end: {what}; expected outlines of fewer corners, slower \
         twists, or the pair in `clearance.ignore`"
    )]
    ClearanceExhausted {
        /// The case's name.
        case: String,
        /// What was computed.
        what: Box<Exhausted>,
    },
    /// There are too many distances to compute along a path that is wrong.
    #[error(
        "case `{case}`: the path is wrong by some {path_error:.1e} rad or m, and distances along it were computed \
         until {time} s only: a shorter step, or `integrator = \"adaptive\"`, makes the error smaller"
    )]
    RoughPath {
        /// The case's name.
        case: String,
        /// `approach` or `post_impact`.
        table: &'static str,
        /// Since the start of the approach, s.
        time: f64,
        /// Of the phase.
        path_error: f64,
    },
    /// The path of a long phase is not in its temporary file.
    #[error("case `{case}`: the path of a long phase could not be kept in a temporary file: {reason}")]
    PathFile {
        /// The case's name.
        case: String,
        /// The operating system's.
        reason: String,
    },
    /// Too many impacts.
    #[error(
        "case `{case}`: {impacts} impacts by {time} s after the first, the last with target `{target}`: bounces that \
         come to rest on each other are not modelled; `kind = \"pin\"` or `\"rigid\"` holds what stays in contact, and another \
         `restitution` or a shorter `post_impact.duration` has fewer impacts"
    )]
    Chatter {
        /// The case's name.
        case: String,
        /// How many there were.
        impacts: usize,
        /// The target of the last one.
        target: String,
        /// Since the first, s.
        time: f64,
    },
    /// An impact could not be solved.
    #[error("the impact of case `{case}` could not be solved: {source}")]
    Impact {
        /// The case's name.
        case: String,
        /// Why.
        source: crate::error::Error,
    },
    /// The motion after an impact stopped.
    #[error("the motion after the impact of case `{case}` stopped {source}")]
    PostImpact {
        /// The case's name.
        case: String,
        /// When and why.
        source: PhaseError,
    },
}

/// A depth in full down to a tenth of a millimetre.
fn metres(depth: f64) -> String {
    if depth < 1e-4 { format!("{depth:.1e}") } else { format!("{depth:.4}") }
}

/// The progress display of a study.
pub trait Observer {
    /// A part begins, of about so many steps; 0 where the number is not known.
    fn begin(&mut self, part: &str, steps: u64);
    /// One more step is done.
    fn step(&mut self);
}

/// An observer without output.
#[derive(Clone, Copy, Debug)]
pub struct Silent;

impl Observer for Silent {
    fn begin(&mut self, _: &str, _: u64) {}
    fn step(&mut self) {}
}

/// Simulates a scenario; samples are `sample` seconds apart. Positions in the results are as exact as double precision
/// writes them, all else does not depend on how far the robot is from the inertial origin.
///
/// # Errors
/// [`StudyError`].
pub fn study(
    scenario: &Scenario,
    make: ModelFactory<'_>,
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Study, StudyError> {
    study_with(scenario, make, Laws::default(), sample, observer)
}

/// As [`study`], with the control laws that the scenario names, where they are among these.
///
/// # Errors
/// [`StudyError`].
pub fn study_registered(
    scenario: &Scenario,
    make: ModelFactory<'_>,
    laws: &[RegisteredLaw],
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Study, StudyError> {
    study_with(scenario, make, NamedLaws::of(scenario, laws).laws(), sample, observer)
}

/// As [`study`], with laws of one's own in place of those that the scenario names.
///
/// # Errors
/// [`StudyError`].
pub fn study_with(
    scenario: &Scenario,
    make: ModelFactory<'_>,
    laws: Laws<'_>,
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Study, StudyError> {
    let [tracking, post_capture] = scenario.own_laws();
    if let (Some((name, _)), None) = (tracking, laws.tracking) {
        return Err(StudyError::NoLaw { name, key: "approach.tracking" });
    }
    if let (Some((name, _)), None) = (post_capture, laws.post_capture) {
        return Err(StudyError::NoLaw { name, key: "post_impact.control" });
    }
    let about = |origin| OwnLaws { laws, scenario, origin };
    match Origin::of(scenario) {
        Some(origin) => {
            let relative = origin.relative(scenario);
            let study = study_about_origin(&relative, make, about(origin.position()), sample, observer)?;
            Ok(origin.absolute(study))
        }
        None => study_about_origin(scenario, make, about([0.0; 2]), sample, observer),
    }
}

fn study_about_origin(
    scenario: &Scenario,
    make: ModelFactory<'_>,
    own: OwnLaws<'_>,
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Study, StudyError> {
    let model = make();
    // resolved motion rate control needs no joint trajectory
    let by_end_effectors = matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. });
    let inverse_kinematics = match &scenario.approach.final_end_effector_poses {
        Some(goals) if !by_end_effectors => {
            observer.begin("designing final joint angles", 0);
            Some(inverse_kinematics(&*model, scenario, goals, sample, &mut || observer.step())?)
        }
        // the arms stretch towards a goal out of reach, but not along a path that is all but endless
        Some(goals) => {
            check_reach(scenario, goals, FARTHEST_GOAL)?;
            None
        }
        None => None,
    };
    let (mut designed, mut given): (Scenario, Scenario);
    let (scenario, own) = match &inverse_kinematics {
        Some(InverseKinematics { joint_angles, .. }) => {
            (designed, given) = (scenario.clone(), own.scenario.clone());
            designed.approach.final_joint_angles.clone_from(joint_angles);
            given.approach.final_joint_angles.clone_from(joint_angles);
            (&designed, OwnLaws { scenario: &given, ..own })
        }
        None => (scenario, own),
    };
    let own = Some(own);
    let approach = ApproachTracking::new(scenario, sample).with(own);
    let terminal_rates = match (&scenario.approach.end, &inverse_kinematics) {
        (FinalRates::EndEffectorTwists(_), Some(inverse_kinematics)) => Some(inverse_kinematics.rates.clone()),
        (FinalRates::EndEffectorTwists(wanted), None) if !by_end_effectors => {
            observer.begin("designing end rates", 0);
            Some(terminal_rates(&*model, &approach, wanted, &mut || observer.step())?)
        }
        _ => None,
    };
    let rates = match (&scenario.approach.end, &terminal_rates) {
        (FinalRates::JointRates(rates), _) => rates.clone(),
        (_, Some(terminal_rates)) => terminal_rates.joint_rates.clone(),
        (_, None) => vec![0.0; model.joints()],
    };
    observer.begin("approach", approach.steps());
    let approach = approach.track(&*model, &rates, &mut NoEvents, &mut || observer.step());
    let approach = approach.map_err(StudyError::Approach)?;
    let cases = scenario
        .cases
        .iter()
        .map(|case| {
            let sequence = CaptureSequence { scenario, case, rates: &rates, make, sample, own };
            match scenario.contact.detection {
                Detection::Time => sequence.contact_at_time(&approach, observer),
                Detection::Event => sequence.contact_by_detection(observer),
            }
        })
        .collect::<Result<Vec<_>, StudyError>>()?;
    let terminal_errors = TerminalError::of(scenario, &approach);
    let mut study = Study { terminal_rates, inverse_kinematics, approach, terminal_errors, cases };
    // the clearance is computed
    for phase in study.phases_mut() {
        phase.path = Path::default();
    }
    Ok(study)
}

impl CaseResult {
    /// Its approach.
    #[must_use]
    pub fn approach<'a>(&'a self, study: &'a Study) -> &'a Phase {
        self.approach.as_ref().unwrap_or(&study.approach)
    }

    /// Momentum [l, px, py] about the inertial origin and kinetic energy of the targets together before the impact; N m
    /// s, N s, J.
    #[must_use]
    pub fn targets_momentum(&self) -> ([f64; 3], f64) {
        self.targets.iter().map(Body::momentum).fold(([0.0; 3], 0.0), |(sum, energy), (part, more)| {
            (std::array::from_fn(|i| sum[i] + part[i]), energy + more)
        })
    }

    /// The freely moving targets `ago` s before the end of the approach.
    #[must_use]
    pub fn targets_before(&self, ago: f64) -> Vec<Body> {
        self.targets.iter().map(|target| target.after(-ago)).collect()
    }
}

impl Study {
    /// The approach and the phases of all cases.
    fn phases_mut(&mut self) -> impl Iterator<Item = &mut Phase> {
        let of_cases = self.cases.iter_mut().flat_map(|CaseResult { approach, capture, .. }| {
            approach.iter_mut().chain(capture.as_mut().map(|capture| &mut capture.post_impact))
        });
        std::iter::once(&mut self.approach).chain(of_cases)
    }

    /// The approach that cases have in common; `None` where each has its own, by contact detection.
    fn common_approach(&self) -> Option<&Phase> {
        self.cases.iter().any(|case| case.approach.is_none()).then_some(&self.approach)
    }

    /// The failures of the audit; empty when every phase and every exact impact passes, and no bodies overlap where the
    /// scenario forbids it.
    #[must_use]
    pub fn audit_failures(&self) -> Vec<String> {
        let mut found = Vec::new();
        found.extend(self.common_approach().into_iter().flat_map(|common| phase_failures("approach", common, None)));
        for case in &self.cases {
            if let Some(own) = &case.approach {
                found.extend(phase_failures(&format!("{}, approach", case.name), own, None));
            }
            let mut overlaps = case.clearance.failures();
            let named = overlaps.by_ref().take(NAMED_OVERLAPS);
            found.extend(named.map(|overlap| format!("{}: {}", case.name, overlap.sentence())));
            let more = overlaps.count();
            if more > 0 {
                found.push(format!("{}: {}, all in the summary", case.name, count(more, "more overlap")));
            }
            let depths = case.closest.iter().map(|pair| -pair.distance);
            let depths = depths.chain(case.capture.iter().map(|captured| captured.penetration));
            let depth = depths.fold(0.0, Real::maximum);
            if exceeds(depth, PENETRATION_BOUND) {
                found.push(format!(
                    "{}: an end effector is {depth:.2e} m inside a target that it does not hold: {INSTEAD}",
                    case.name
                ));
            }
            let Some(captured) = &case.capture else { continue };
            found.extend(captured.impacts().flat_map(|impact| impact_failures(&case.name, &impact.exact)));
            let name = format!("{}, post-impact", case.name);
            found.extend(phase_failures(&name, &captured.post_impact, captured.heavy_target.as_ref()));
        }
        found
    }
}

/// Whether a value is over its bound; NaN is over every bound.
fn exceeds(value: f64, bound: f64) -> bool {
    value.partial_cmp(&bound).is_none_or(Ordering::is_gt)
}

fn impact_failures(case: &str, exact: &ImpactResult) -> Vec<String> {
    let mut found = Vec::new();
    let jump = exact.relative_momentum_jump;
    if exceeds(jump, MOMENTUM_BOUND) {
        found.push(format!("{case}: the exact impact changes the momentum by {jump:.2e} of it"));
    }
    if exceeds(exact.kinetic_energy_after, exact.kinetic_energy_before * (1.0 + MOMENTUM_BOUND)) {
        found.push(format!(
            "{case}: the exact impact raises the kinetic energy from {} J to {} J",
            exact.kinetic_energy_before, exact.kinetic_energy_after
        ));
    }
    found
}

fn phase_failures(name: &str, phase: &Phase, heavy: Option<&HeavyTarget>) -> Vec<String> {
    let drifts = over_bounds(phase).map(|(what, value, bound)| {
        let remedy = heavy.filter(|_| what == MOMENTUM_DRIFT).map(|heavy| format!("; {}", heavy.remedy()));
        format!("{what} {value:.2e} is over its bound {bound:.0e}{}", remedy.unwrap_or_default())
    });
    let limit_violations = phase.limit_violations.iter().flat_map(LimitViolations::sentences);
    drifts.chain(limit_violations).map(|what| format!("{name}: {what}")).collect()
}

const MOMENTUM_DRIFT: &str = "momentum drift";

/// What is beyond its bound in a phase: name, value and bound.
fn over_bounds(phase: &Phase) -> impl Iterator<Item = (&'static str, f64, f64)> {
    let checks = [
        (MOMENTUM_DRIFT, phase.drift.momentum_drift, MOMENTUM_BOUND),
        ("energy error", phase.drift.energy_error, ENERGY_BOUND),
        ("centre-of-mass drift", phase.drift.center_of_mass_drift, CENTER_OF_MASS_BOUND),
        ("path error", phase.path_error, PATH_BOUND),
        ("opening of what is held", phase.constraint_errors[0], CONSTRAINT_BOUND),
        ("rate of opening of what is held", phase.constraint_errors[1], CONSTRAINT_BOUND),
    ];
    checks.into_iter().filter(|(_, value, bound)| exceeds(*value, *bound))
}

#[cfg(test)]
mod tests;
