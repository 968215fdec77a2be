//! Inverse kinematics: final joint angles of the approach from the desired end effector poses at its end.
//!
//! # Example
//! ```
//! use planar_capture::capture::approach::{ApproachTracking, inverse_kinematics::inverse_kinematics};
//! use planar_capture::registry;
//! use planar_capture::scenario::{EndEffectorGoal, Scenario};
//! use planar_capture::simulate::event::NoEvents;
//!
//! let path = "scenarios/spinning_target.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let goal = EndEffectorGoal::Position([1.9, -0.9]);
//! let found = inverse_kinematics(&*robot, &scenario, &[goal], 1.0, &mut || ())?;
//! assert_eq!(found.spare_joints, 1); // three joints, two coordinates
//! scenario.approach.final_joint_angles = found.joint_angles;
//! let approach = ApproachTracking::new(&scenario, 1.0);
//! let phase = approach.track(&*robot, &found.rates.joint_rates, &mut NoEvents, &mut || ())?;
//! let [_, x, y] = phase.end().end_effector_poses[0];
//! assert!((x - 1.9).abs() < 1e-6 && (y + 0.9).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::capture::approach::ApproachTracking;
use crate::capture::approach::exact_end::ApproachEnd;
use crate::capture::approach::terminal_rates::{TerminalRates, TerminalRatesError, rates_for};
use crate::capture::reach::Reach;
use crate::capture::reduced_matrices::reduced_matrices;
use crate::dynamics::AnyModel;
use crate::scenario::{EndEffectorGoal, FinalRates, Scenario};
use crate::simulate::PhaseError;
use nalgebra::{DMatrix, DVector};

/// Largest number of iterations; each gains about a digit.
const MAX_ITERATIONS: usize = 80;
/// Residual of a converged solution: rad, and m per m of reach.
const TOLERANCE: f64 = 1e-11;
/// Largest change of a joint angle in one iteration, rad: the Jacobian is that of one pose.
const MAX_STEP: f64 = 0.5;
/// Damping of the least-squares steps, relative to the largest singular value.
const DAMPING: f64 = 1e-3;
/// Largest number of halvings of a step that does not reduce the residual.
const MAX_HALVINGS: u32 = 12;

/// Final joint angles whose exactly tracked approach ends with the end effectors at the desired poses.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct InverseKinematics {
    /// rad.
    pub joint_angles: Vec<f64>,
    /// The terminal joint rates of the same approach, rad/s.
    pub rates: TerminalRates,
    /// The largest error of a pose: rad, and m per m of the arm's reach.
    pub residual: f64,
    /// How many approaches were tracked.
    pub iterations: usize,
    /// Number of joints less number of equations. Where it is positive, every step is the shortest solution; where it
    /// is negative, only compatible goals can be reached.
    pub spare_joints: isize,
}

/// Why no final joint angles were found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InverseKinematicsError {
    /// A position beyond the stretched arm.
    #[error(
        "the wanted pose of the end effector of `{arm}` is out of reach: {distance:.4} m from the robot's COM at the end of the \
         approach, and no pose brings that end effector further out than {limit:.4} m"
    )]
    OutOfReach {
        /// The arm's name.
        arm: String,
        /// m.
        distance: f64,
        /// m.
        limit: f64,
    },
    /// The iteration did not converge.
    #[error(
        "the wanted end effector poses were not reached: after {iterations} approaches the residual is {residual:.3e} (rad, or \
         m per m of reach; all residuals: {}), with smallest/largest singular value {singularity_margin:.1e} of the \
         generalized Jacobian. {}",
        shortened(history),
        hint(*residual, history)
    )]
    NotConverged {
        /// How many were tracked.
        iterations: usize,
        /// The best that was reached.
        residual: f64,
        /// Residuals, iteration by iteration.
        history: Vec<f64>,
        /// At the best pose.
        singularity_margin: f64,
    },
    /// The approach, or the design of its end rates, has no answer.
    #[error(transparent)]
    Rates(#[from] TerminalRatesError),
}

/// Residuals up to this are no matter of reach.
const NEARLY_REACHED: f64 = 1e-6;

/// What may help an iteration that did not converge.
fn hint(residual: f64, history: &[f64]) -> &'static str {
    if residual <= NEARLY_REACHED {
        "They are nearly reached, but pose and final rates do not settle together: give final_joint_rates in place of \
         final_end_effector_twists, or final_joint_angles near the wanted pose to start from"
    } else if history.last().is_some_and(|last| last.is_finite()) {
        "They may be out of reach; or give final_joint_angles near the wanted pose to start from"
    } else {
        "The iteration diverged: give final_joint_angles near the wanted pose to start from, or a shorter duration, in which the \
         base moves less far"
    }
}

/// The first three and the last three residuals.
fn shortened(residuals: &[f64]) -> String {
    let list = |values: &[f64]| values.iter().map(|value| format!("{value:.1e}")).collect::<Vec<_>>().join(", ");
    match residuals {
        [start @ .., _, _, _] if start.len() > 3 => {
            format!("{}, …, {}", list(&residuals[..3]), list(&residuals[start.len()..]))
        }
        residuals => list(residuals),
    }
}

/// Newton's method over whole approaches: track exactly → errors of the end effector poses → step by the generalized
/// Jacobian → track.
///
/// The base turns along the path (the robot is non-holonomic), so the Jacobian of the final pose with respect to the
/// final joint angles is only approximately the generalized one, and the method converges linearly. Steps are damped
/// least squares, at most 0.5 rad, and halved where they do not reduce the residual. Every iteration takes the terminal
/// rates from the one before; both converge together, and after a step that is rejected the best pose is tracked again with
/// the rates that it gave. Yaws are reached up to whole turns.
///
/// # Errors
/// [`InverseKinematicsError`].
pub fn inverse_kinematics(
    model: &AnyModel<f64>,
    scenario: &Scenario,
    goals: &[EndEffectorGoal],
    sample: f64,
    tick: &mut dyn FnMut(),
) -> Result<InverseKinematics, InverseKinematicsError> {
    check_reach(scenario, goals, 1.0)?;
    let rates = match &scenario.approach.end {
        FinalRates::JointRates(rates) => rates.clone(),
        FinalRates::Rest | FinalRates::EndEffectorTwists(_) => vec![0.0; model.joints()],
    };
    let mut trial = Trial { scenario: scenario.clone(), rates };
    let mut best: Option<Step> = None;
    let (mut history, mut part, mut halvings) = (Vec::new(), 1.0, 0);
    // whether the best pose is tracked again, with the terminal rates of now
    let mut again = false;
    for iteration in 1..=MAX_ITERATIONS {
        let step = match trial.track(model, goals, sample, tick) {
            Ok(step) => Some(step),
            // a large step may end where the dynamics have no solution: it is shortened like one that ends far away
            Err(_) if best.is_some() => None,
            Err(error) => return Err(error.into()),
        };
        let residual = step.as_ref().map_or(f64::INFINITY, |step| step.residual);
        let has_new_rates = step.is_some();
        history.push(residual);
        let is_accepted = |step: &Step| {
            again || step.is_converged() || best.as_ref().is_none_or(|best| step.residual < best.residual)
        };
        if let Some(step) = step.filter(is_accepted) {
            if !std::mem::take(&mut again) {
                (part, halvings) = (1.0, 0);
            }
            if step.is_converged() {
                let singularity_margin = step.rates_margin;
                let equations: usize = goals.iter().map(EndEffectorGoal::len).sum();
                return Ok(InverseKinematics {
                    joint_angles: step.angles,
                    rates: TerminalRates { joint_rates: trial.rates, singularity_margin, iterations: iteration },
                    residual: step.residual,
                    iterations: iteration,
                    spare_joints: model.joints().cast_signed() - equations.cast_signed(),
                });
            }
            best = Some(step);
        } else if residual > TOLERANCE {
            // the residual of the best pose is that with earlier terminal rates, which no pose may reach with those of now
            (part, halvings, again) = (part * 0.5, halvings + 1, has_new_rates);
        }
        let Some(step) = best.as_ref().filter(|_| halvings <= MAX_HALVINGS) else { break };
        let part = if again { 0.0 } else { part };
        let moved = step.angles.iter().zip(step.change.iter()).map(|(angle, change)| angle + part * change);
        trial.scenario.approach.final_joint_angles = moved.collect();
    }
    let (residual, singularity_margin) = best.map_or((f64::INFINITY, 0.0), |best| (best.residual, best.margin));
    Err(InverseKinematicsError::NotConverged { iterations: history.len(), residual, history, singularity_margin })
}

/// The scenario with the final joint angles and the terminal rates of an iteration.
struct Trial {
    scenario: Scenario,
    rates: Vec<f64>,
}

/// The end of one tracked approach, and the step from it.
struct Step {
    angles: Vec<f64>,
    residual: f64,
    /// Of the scaled equations of the step.
    margin: f64,
    change: DVector<f64>,
    /// Of the equations of the terminal rates, or `margin` where there are none.
    rates_margin: f64,
    /// Largest change of a terminal rate, rad/s.
    rate_change: f64,
}

impl Step {
    fn is_converged(&self) -> bool {
        self.residual <= TOLERANCE && self.rate_change <= TOLERANCE
    }
}

impl Trial {
    /// Tracks one approach, then takes the terminal rates for the next one from its end.
    fn track(
        &mut self,
        model: &AnyModel<f64>,
        goals: &[EndEffectorGoal],
        sample: f64,
        tick: &mut dyn FnMut(),
    ) -> Result<Step, TerminalRatesError> {
        tick();
        let end = ApproachTracking::new(&self.scenario, sample).exact_end(model, &self.rates)?;
        let mut step = self.step(model, goals, &end)?;
        if let FinalRates::EndEffectorTwists(twists) = &self.scenario.approach.end {
            let (rates, margin) = rates_for(model, &end, twists)?;
            let changes = rates.iter().zip(&self.rates).map(|(a, b)| (a - b).abs());
            (step.rates_margin, step.rate_change) = (margin, changes.fold(0.0, f64::max));
            self.rates = rates;
        }
        Ok(step)
    }

    fn step(&self, model: &AnyModel<f64>, goals: &[EndEffectorGoal], end: &ApproachEnd) -> Result<Step, PhaseError> {
        let (_, jacobian) =
            reduced_matrices(model, &end.state.view()).map_err(|source| PhaseError { time: end.time, source })?;
        let mut rows = Vec::new();
        let arms = goals.iter().zip(&end.end_effector_poses).zip(&self.scenario.layout.arms);
        for (i, ((goal, pose), arm)) in arms.enumerate() {
            let reach = if arm.reach() > 0.0 { arm.reach() } else { 1.0 };
            rows.extend(goal.errors(pose).map(|(part, error)| {
                let unit = if part == 0 { 1.0 } else { reach };
                (3 * i + part, error / unit, unit)
            }));
        }
        let errors = DVector::from_iterator(rows.len(), rows.iter().map(|(_, error, _)| *error));
        let scaled = DMatrix::from_fn(rows.len(), jacobian.ncols(), |i, column| {
            let (row, _, unit) = rows[i];
            jacobian[(row, column)] / unit
        });
        let (change, margin) = damped_step(scaled, &errors);
        Ok(Step {
            angles: self.scenario.approach.final_joint_angles.clone(),
            residual: if errors.is_empty() { 0.0 } else { errors.amax() },
            margin,
            change,
            rates_margin: margin,
            rate_change: 0.0,
        })
    }
}

/// The damped least-squares step, at most [`MAX_STEP`], and the smallest singular value over the largest.
fn damped_step(jacobian: DMatrix<f64>, errors: &DVector<f64>) -> (DVector<f64>, f64) {
    let joints = jacobian.ncols();
    let svd = jacobian.svd(true, true);
    let largest = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let smallest = svd.singular_values.iter().copied().fold(f64::INFINITY, f64::min);
    let (Some(u), Some(v)) = (&svd.u, &svd.v_t) else { return (DVector::zeros(joints), 0.0) };
    if largest == 0.0 {
        return (DVector::zeros(joints), 0.0);
    }
    let damping = (DAMPING * largest).powi(2);
    let inverse = svd.singular_values.map(|value| value / (value * value + damping));
    let change = v.transpose() * (u.transpose() * errors).component_mul(&inverse);
    let longest = change.amax();
    let change = if longest > MAX_STEP { change * (MAX_STEP / longest) } else { change };
    (change, smallest / largest)
}

/// Refuses goals that are further away than so many times what can be reached.
pub(crate) fn check_reach(
    scenario: &Scenario,
    goals: &[EndEffectorGoal],
    times: f64,
) -> Result<(), InverseKinematicsError> {
    for (i, (goal, arm)) in goals.iter().zip(&scenario.layout.arms).enumerate() {
        let reach = goal
            .position()
            .and_then(|position| Reach::new(scenario, i, position))
            .filter(|reach| reach.distance > times * reach.limit);
        if let Some(Reach { distance, limit, .. }) = reach {
            return Err(InverseKinematicsError::OutOfReach { arm: arm.name.clone(), distance, limit });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
