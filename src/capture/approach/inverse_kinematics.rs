//! Final joint angles of the approach, designed from the end effector poses that are wanted at contact.

use crate::capture::approach::Approach;
use crate::capture::approach::terminal_rates::{TerminalRates, TerminalRatesError, generalized_jacobian, rates_for};
use crate::check::distance_and_most;
use crate::dynamics::Model;
use crate::scenario::{EndEffectorGoal, FinalRates, Scenario};
use crate::simulate::{Phase, PhaseError};
use nalgebra::{DMatrix, DVector};

/// Rounds before giving up; each gains about a digit.
const MOST_ROUNDS: usize = 80;
/// Residual at which the end effectors are where they are wanted: rad, and m per m of reach.
const ENOUGH: f64 = 1e-11;
/// Joints turn by at most this in one round, rad: the Jacobian is that of one pose.
const LONGEST_STEP: f64 = 0.5;
/// Singular values below this part of the largest are held back.
const DAMPING: f64 = 1e-3;
/// How often a step that makes things worse is halved.
const MOST_HALVINGS: u32 = 12;

/// Final joint angles whose exactly tracked approach ends with the end effectors at the wanted poses.
#[derive(Clone, Debug, PartialEq)]
pub struct InverseKinematics {
    /// rad.
    pub joint_angles: Vec<f64>,
    /// The end rates that go with them, rad/s, and what their design saw.
    pub rates: TerminalRates,
    /// The largest that is missing: rad, and m per m of the arm's reach.
    pub residual: f64,
    /// How many approaches were tracked.
    pub rounds: usize,
    /// Joints less wanted numbers. Where it is positive, every step is the shortest that does it; where it is negative,
    /// only wishes that agree with each other can be met.
    pub spare_joints: isize,
}

/// Why no final joint angles were found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InverseKinematicsError {
    /// A place beyond the stretched arm.
    #[error(
        "the pose wanted of the tip of `{arm}` is out of reach: {distance:.4} m from where the robot's COM is at the end of \
         the approach, and no pose brings that tip further out than {most:.4} m"
    )]
    OutOfReach {
        /// The arm's name.
        arm: String,
        /// m.
        distance: f64,
        /// m.
        most: f64,
    },
    /// The iteration came no nearer.
    #[error(
        "the wanted tip poses were not reached: after {rounds} approaches they are still missed by {residual:.3e} (rad, or m \
         per m of reach; the way there: {history}), with smallest/largest singular value {singularity_margin:.1e} of the \
         generalized Jacobian. They may be out of reach; or give final_joint_angles near the wanted pose to start from"
    )]
    Unsettled {
        /// How many were tracked.
        rounds: usize,
        /// The best that was reached.
        residual: f64,
        /// Residuals, round by round.
        history: History,
        /// At the best pose.
        singularity_margin: f64,
    },
    /// The approach, or the design of its end rates, has no answer.
    #[error(transparent)]
    Rates(#[from] TerminalRatesError),
}

/// Residuals of an iteration, round by round.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History(pub Vec<f64>);

impl std::fmt::Display for History {
    /// The first three and the last three.
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let shown = |values: &[f64]| values.iter().map(|value| format!("{value:.1e}")).collect::<Vec<_>>().join(", ");
        match self.0.as_slice() {
            [first @ .., _, _, _] if first.len() > 3 => {
                let (start, end) = (self.0.get(..3).unwrap_or_default(), self.0.get(first.len()..).unwrap_or_default());
                write!(f, "{}, …, {}", shown(start), shown(end))
            }
            values => f.write_str(&shown(values)),
        }
    }
}

/// Newton's method over whole approaches: track exactly → end effector poses → step by the generalized Jacobian →
/// track.
///
/// The base turns with the path (the robot is non-holonomic), so the Jacobian of the final pose over the final joint
/// angles is the generalized one only nearly, and the method converges linearly. Steps are damped least squares, at
/// most 0.5 rad, and halved where they do not bring the end effectors nearer. Every round takes the end rates from the
/// one before; both settle together. The yaw of an end effector is wanted up to whole turns.
///
/// # Errors
/// [`InverseKinematicsError`], with the numbers.
pub fn inverse_kinematics(
    model: &dyn Model<f64>,
    scenario: &Scenario,
    goals: &[EndEffectorGoal],
    sample: f64,
    tick: &mut dyn FnMut(),
) -> Result<InverseKinematics, InverseKinematicsError> {
    out_of_reach(scenario, goals)?;
    let mut trial = Trial { scenario: scenario.clone(), rates: start_rates(scenario, model.joints()) };
    let mut best: Option<Step> = None;
    let (mut history, mut part, mut halvings) = (History::default(), 1.0, 0);
    for round in 1..=MOST_ROUNDS {
        let (found, margin, change) = match trial.track(model, goals, sample, tick) {
            Ok(found) => found,
            // a wild step may end where nothing can be computed: as bad as one that ends far away
            Err(_) if best.is_some() => (None, 0.0, f64::INFINITY),
            Err(error) => return Err(error.into()),
        };
        let residual = found.as_ref().map_or(f64::INFINITY, |step| step.residual);
        history.0.push(residual);
        if let Some(step) = found.filter(|step| best.as_ref().is_none_or(|best| step.residual < best.residual)) {
            (part, halvings) = (1.0, 0);
            if step.residual <= ENOUGH && change <= ENOUGH {
                let rates = TerminalRates { joint_rates: trial.rates, singularity_margin: margin, iterations: round };
                let wanted: usize = goals.iter().map(EndEffectorGoal::len).sum();
                return Ok(InverseKinematics {
                    joint_angles: step.angles,
                    rates,
                    residual: step.residual,
                    rounds: round,
                    spare_joints: isize::try_from(model.joints()).unwrap_or(isize::MAX)
                        - isize::try_from(wanted).unwrap_or(isize::MAX),
                });
            }
            best = Some(step);
        } else if residual > ENOUGH {
            (part, halvings) = (part * 0.5, halvings + 1);
        }
        let Some(step) = best.as_ref().filter(|_| halvings <= MOST_HALVINGS) else { break };
        let moved = step.angles.iter().zip(step.change.iter()).map(|(angle, change)| angle + part * change);
        trial.scenario.approach.final_joint_angles = moved.collect();
    }
    let (residual, singularity_margin) = best.map_or((f64::INFINITY, 0.0), |best| (best.residual, best.margin));
    Err(InverseKinematicsError::Unsettled { rounds: history.0.len(), residual, history, singularity_margin })
}

/// What a round tracks.
struct Trial {
    scenario: Scenario,
    rates: Vec<f64>,
}

/// A pose that was reached, and where to go from it.
struct Step {
    angles: Vec<f64>,
    residual: f64,
    margin: f64,
    change: DVector<f64>,
}

impl Trial {
    /// One approach; then the rates for the next one. Returns also the singularity margin and by how much the rates
    /// changed.
    fn track(
        &mut self,
        model: &dyn Model<f64>,
        goals: &[EndEffectorGoal],
        sample: f64,
        tick: &mut dyn FnMut(),
    ) -> Result<(Option<Step>, f64, f64), TerminalRatesError> {
        let phase = Approach::new(&self.scenario, sample).track_exactly(model, &self.rates, tick)?;
        let step = self.step(model, goals, &phase)?;
        let margin = step.as_ref().map_or(0.0, |step| step.margin);
        let FinalRates::EndEffectorTwists(wanted) = &self.scenario.approach.end else { return Ok((step, margin, 0.0)) };
        let (rates, margin) = rates_for(model, &phase, wanted)?;
        let change = rates.iter().zip(&self.rates).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        self.rates = rates;
        Ok((step, margin, change))
    }

    fn step(
        &self,
        model: &dyn Model<f64>,
        goals: &[EndEffectorGoal],
        phase: &Phase,
    ) -> Result<Option<Step>, TerminalRatesError> {
        let Some(end) = phase.end() else { return Ok(None) };
        let jacobian =
            generalized_jacobian(model, &end.state).map_err(|source| PhaseError { time: end.time, source })?;
        let mut rows = Vec::new();
        for (i, ((goal, pose), arm)) in
            goals.iter().zip(&end.end_effector_poses).zip(&self.scenario.layout.arms).enumerate()
        {
            let unit = if arm.reach() > 0.0 { arm.reach() } else { 1.0 };
            rows.extend(goal.missing(pose).map(|(part, missing)| {
                let unit = if part == 0 { 1.0 } else { unit };
                (3 * i + part, missing / unit, unit)
            }));
        }
        let missing = DVector::from_iterator(rows.len(), rows.iter().map(|(_, missing, _)| *missing));
        let scaled = DMatrix::from_fn(rows.len(), jacobian.ncols(), |row, column| {
            rows.get(row).map_or(0.0, |(from, _, unit)| jacobian[(*from, column)] / unit)
        });
        let angles = self.scenario.approach.final_joint_angles.clone();
        let (change, margin) = damped(scaled, &missing);
        let residual = if missing.is_empty() { 0.0 } else { missing.amax() };
        Ok(Some(Step { angles, residual, margin, change }))
    }
}

/// The damped least-squares step, at most [`LONGEST_STEP`], and the smallest singular value over the largest.
fn damped(jacobian: DMatrix<f64>, missing: &DVector<f64>) -> (DVector<f64>, f64) {
    let joints = jacobian.ncols();
    let svd = jacobian.svd(true, true);
    let largest = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let smallest = svd.singular_values.iter().copied().fold(f64::INFINITY, f64::min);
    let (Some(u), Some(v)) = (&svd.u, &svd.v_t) else { return (DVector::zeros(joints), 0.0) };
    if largest == 0.0 {
        return (DVector::zeros(joints), 0.0);
    }
    let held_back = (DAMPING * largest).powi(2);
    let parts =
        (u.transpose() * missing).component_mul(&svd.singular_values.map(|value| value / (value * value + held_back)));
    let change = v.transpose() * parts;
    let longest = change.amax();
    let change = if longest > LONGEST_STEP { change * (LONGEST_STEP / longest) } else { change };
    (change, smallest / largest)
}

fn start_rates(scenario: &Scenario, joints: usize) -> Vec<f64> {
    match &scenario.approach.end {
        FinalRates::JointRates(rates) => rates.clone(),
        FinalRates::Rest | FinalRates::EndEffectorTwists(_) => vec![0.0; joints],
    }
}

fn out_of_reach(scenario: &Scenario, goals: &[EndEffectorGoal]) -> Result<(), InverseKinematicsError> {
    for (i, (goal, arm)) in goals.iter().zip(&scenario.layout.arms).enumerate() {
        let (EndEffectorGoal::Position([x, y]) | EndEffectorGoal::Pose([_, x, y])) = goal else { continue };
        if let Some((distance, most)) = distance_and_most(scenario, i, [*x, *y])
            && distance > most
        {
            return Err(InverseKinematicsError::OutOfReach { arm: arm.name.clone(), distance, most });
        }
    }
    Ok(())
}
