//! A scenario from approach to post-impact: one approach, then an impact and what follows for every case.

use crate::approach::Approach;
use crate::capture::{Capture, capture};
use crate::design::{Design, DesignError, end_rates};
use crate::dynamics::Model;
use crate::limits::Excesses;
use crate::miss::Miss;
use crate::posture::{Posture, PostureError, posture};
use crate::remainder::Remainder;
use crate::scenario::{Case, EndRates, PostImpact, Scenario, Settling, Tracking};
use crate::settle::{settle, wheels};
use crate::simulate::{Motion, Phase, Sample, Stopped, Timing};
use crate::target::Target;

/// Largest momentum drift of a phase that passes the audit.
pub const MOMENTUM_BOUND: f64 = 1e-9;
/// Largest drift of the centre of mass in a phase that passes the audit: it is the integral of what the momentum drifts by.
pub const CENTER_OF_MASS_BOUND: f64 = 1e-9;
/// Largest energy error of a phase that passes the audit.
pub const ENERGY_BOUND: f64 = 1e-6;

/// Makes a model of the robot, in its state before any capture.
pub type MakeModel<'a> = &'a dyn Fn() -> Box<dyn Model<f64>>;

/// What was computed for one scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Study {
    /// Where the end rates of the approach come from, where they were designed.
    pub design: Option<Design>,
    /// Where its final joint angles come from, where they were designed.
    pub posture: Option<Posture>,
    /// The approach, the same in every case.
    pub approach: Phase,
    /// By how much it misses the wanted tip poses, one per arm; empty where none are wanted.
    pub misses: Vec<Option<Miss>>,
    /// One per case, in the scenario's order.
    pub cases: Vec<CaseResult>,
}

/// One case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseResult {
    /// Its name.
    pub name: String,
    /// Impact and what follows; `None` where there is nothing to capture.
    pub capture: Option<Captured>,
}

/// A capture and the motion after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Captured {
    /// Exact and as the paper writes it.
    pub impact: Capture,
    /// The merged robot from the exact velocities.
    pub post_impact: Phase,
    /// What is left at its end; `None` where the joints are free, as in the paper.
    pub remainder: Option<Remainder>,
}

/// Why a study has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StudyError {
    /// The end rates could not be designed.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The final joint angles could not be designed.
    #[error(transparent)]
    Posture(#[from] PostureError),
    /// The approach stopped.
    #[error("the approach stopped {0}")]
    Approach(Stopped),
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
        source: Stopped,
    },
}

/// Told what the study is about to do, for a progress display.
pub trait Observer {
    /// A part begins that takes about so many steps.
    fn begin(&mut self, part: &str, steps: u64);
    /// One more step is done.
    fn step(&mut self);
}

/// Runs a scenario; samples are `sample` seconds apart.
///
/// # Errors
/// [`StudyError`], with the part and the numbers.
pub fn study(
    scenario: &Scenario,
    make: MakeModel<'_>,
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Study, StudyError> {
    let model = make();
    // tips on paths of their own need no joint trajectory
    let by_tips = matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. });
    let posture = match &scenario.approach.final_end_effector_poses {
        Some(goals) if !by_tips => {
            observer.begin("designing final joint angles", 0);
            Some(posture(&*model, scenario, goals, sample, &mut || observer.step())?)
        }
        _ => None,
    };
    let mut designed;
    let scenario = match &posture {
        Some(posture) => {
            designed = scenario.clone();
            designed.approach.final_joint_angles.clone_from(&posture.joint_angles);
            &designed
        }
        None => scenario,
    };
    let approach = Approach::new(scenario, sample);
    let design = match (&scenario.approach.end, &posture) {
        (EndRates::EndEffectorTwists(_), Some(posture)) => Some(posture.rates.clone()),
        (EndRates::EndEffectorTwists(wanted), None) if !by_tips => {
            observer.begin("designing end rates", 0);
            Some(end_rates(&*model, &approach, wanted, &mut || observer.step())?)
        }
        _ => None,
    };
    let rates = match (&scenario.approach.end, &design) {
        (EndRates::JointRates(rates), _) => rates.clone(),
        (_, Some(design)) => design.joint_rates.clone(),
        (_, None) => vec![0.0; model.joints()],
    };
    observer.begin("approach", approach.steps());
    let approach = approach.track(&*model, &rates, &mut || observer.step()).map_err(StudyError::Approach)?;
    let cases = scenario
        .cases
        .iter()
        .map(|case| {
            let capture = match (&scenario.post_impact, approach.end()) {
                (Some(after), Some(end)) => Some(run_case(scenario, case, after, end, make, sample, observer)?),
                _ => None,
            };
            Ok(CaseResult { name: case.name.clone(), capture })
        })
        .collect::<Result<Vec<_>, StudyError>>()?;
    let misses = Miss::of(scenario, &approach);
    Ok(Study { design, posture, approach, misses, cases })
}

/// Impact and post-impact of one case.
fn run_case(
    scenario: &Scenario,
    case: &Case,
    after: &PostImpact,
    end: &Sample,
    make: MakeModel<'_>,
    sample: f64,
    observer: &mut dyn Observer,
) -> Result<Captured, StudyError> {
    let mut model = make();
    let targets = targets_by_arm(scenario, case, model.arms());
    let failed = |source| StudyError::Impact { case: case.name.clone(), source };
    let impact = capture(&*model, &end.motion, &targets).map_err(failed)?;
    model.merge(&end.motion.base_pose, &end.motion.joint_angles, &targets).map_err(failed)?;
    let start = Motion {
        base_twist: impact.exact.base_twist_after,
        joint_rates: impact.exact.joint_rates_after.clone(),
        ..end.motion.clone()
    };
    let timing = Timing { duration: after.duration, step: after.step, sample };
    observer.begin(&case.name, timing.steps());
    let wheels = wheels(&scenario.layout, &targets);
    let stopped = |source| StudyError::PostImpact { case: case.name.clone(), source };
    let post_impact = settle(&*model, after, &wheels, &start, sample, &mut || observer.step()).map_err(stopped)?;
    let remainder = match (&after.control, post_impact.end()) {
        (Settling::None, _) | (_, None) => None,
        (control, Some(end)) => {
            let at_end = |source| stopped(Stopped { time: end.time, source });
            Some(Remainder::of(&*model, control, &end.motion, &wheels).map_err(at_end)?)
        }
    };
    Ok(Captured { impact, post_impact, remainder })
}

/// The scenario's targets with the case's twists, in arm order.
fn targets_by_arm(scenario: &Scenario, case: &Case, arms: usize) -> Vec<Option<Target<f64>>> {
    let mut by_arm = vec![None; arms];
    for (target, twist) in scenario.targets.iter().zip(&case.target_twists) {
        if let Some(place) = by_arm.get_mut(target.arm) {
            *place =
                Some(Target { mass: target.mass, inertia: target.inertia, contact: target.contact, twist: *twist });
        }
    }
    by_arm
}

impl Study {
    /// What the audit objects to; empty when every phase and every exact impact passes.
    #[must_use]
    pub fn objections(&self) -> Vec<String> {
        let mut found = phase_objections("approach", &self.approach);
        for case in &self.cases {
            let Some(captured) = &case.capture else { continue };
            let exact = &captured.impact.exact;
            let jump = exact.relative_momentum_jump;
            if jump > MOMENTUM_BOUND {
                found.push(format!("{}: the exact impact changes the momentum by {jump:.2e} of it", case.name));
            }
            if exact.kinetic_energy_after > exact.kinetic_energy_before * (1.0 + MOMENTUM_BOUND) {
                found.push(format!(
                    "{}: the exact impact raises the kinetic energy from {} J to {} J",
                    case.name, exact.kinetic_energy_before, exact.kinetic_energy_after
                ));
            }
            found.extend(phase_objections(&format!("{}, post-impact", case.name), &captured.post_impact));
        }
        found
    }
}

fn phase_objections(name: &str, phase: &Phase) -> Vec<String> {
    let checks = [
        ("momentum drift", phase.drift.momentum_drift, MOMENTUM_BOUND),
        ("energy error", phase.drift.energy_error, ENERGY_BOUND),
        ("centre-of-mass drift", phase.drift.center_of_mass_drift, CENTER_OF_MASS_BOUND),
    ];
    // a NaN is not within its bound
    let out_of_bound =
        checks.into_iter().filter(|(_, value, bound)| value.partial_cmp(bound).is_none_or(std::cmp::Ordering::is_gt));
    let drifts = out_of_bound.map(|(what, value, bound)| format!("{what} {value:.2e} is over its bound {bound:.0e}"));
    let excesses = phase.excesses.iter().flat_map(Excesses::sentences);
    drifts.chain(excesses).map(|what| format!("{name}: {what}")).collect()
}
