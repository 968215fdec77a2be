//! Terminal joint rates of the approach from the desired end effector twists at its end, by the generalized Jacobian.
//!
//! # Example
//! ```
//! use planar_capture::capture::approach::{ApproachTracking, terminal_rates::terminal_rates};
//! use planar_capture::registry;
//! use planar_capture::scenario::{Scenario, Tracking};
//! use planar_capture::simulate::event::NoEvents;
//!
//! let path = "scenarios/raina_shah_2017.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! (scenario.approach.tracking, scenario.approach.step) = (Tracking::InverseDynamics, 0.05);
//! let approach = ApproachTracking::new(&scenario, 1.0);
//! // the first end effector arrives at 0.1 m/s against the x axis, the second one along it, at any yaw rate
//! let wanted = [[None, Some(-0.1), Some(0.0)], [None, Some(0.1), Some(0.0)]];
//! let rates = terminal_rates(&*robot, &approach, &wanted, &mut || ())?.joint_rates;
//! let phase = approach.track(&*robot, &rates, &mut NoEvents, &mut || ())?;
//! let twists = &phase.end().end_effector_twists;
//! assert!((twists[0][1] + 0.1).abs() < 1e-6 && (twists[1][1] - 0.1).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::capture::approach::ApproachTracking;
use crate::capture::approach::exact_end::ApproachEnd;
use crate::capture::reduced_matrices::reduced_matrices;
use crate::dynamics::AnyModel;
use crate::scenario::EndEffectorTwistGoal;
use crate::simulate::PhaseError;
use nalgebra::DVector;

/// Largest number of fixed-point iterations; each gains several digits.
const MAX_ITERATIONS: usize = 60;
/// Largest change of a joint rate in a converged iteration, relative to the largest rate.
const TOLERANCE: f64 = 1e-13;
/// Longest secant, in changes of the last iteration: a contraction by half makes it 1.
const LONGEST: f64 = 1.0;
/// Largest error of the twists, relative to the largest component.
const RESIDUAL_TOLERANCE: f64 = 1e-9;

/// Why no terminal rates were found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TerminalRatesError {
    /// The approach could not be tracked.
    #[error("while the terminal rates were computed, {0}")]
    PhaseError(#[from] PhaseError),
    /// The terminal rates grew until their approach could not be tracked, or ended in a singular pose.
    #[error(
        "no terminal joint rates were found for the wanted end effector twists: in iteration {iteration}, at up to \
         {largest_rate:.3e} rad/s, the approach ends in a pose that is close to singular (generalized Jacobian: \
         smallest/largest singular value {singularity_margin:.1e}), or not at all. Choose other final_joint_angles, or final_end_effector_twists that the arms can \
         give{}",
        source.as_ref().map(|source| format!(" ({source})")).unwrap_or_default()
    )]
    Diverged {
        /// The iteration that failed.
        iteration: usize,
        /// rad/s.
        largest_rate: f64,
        /// Of the last pose.
        singularity_margin: f64,
        /// Why; `None` where the final pose has become singular.
        source: Option<PhaseError>,
    },
    /// The generalized Jacobian at the final pose cannot give the desired twists.
    #[error(
        "the wanted end effector twists are out of reach at the final pose: the generalized Jacobian ({rows} × {columns}, singular \
         values {largest:.3e} to {smallest:.3e}) misses them by {miss:.3e} (m/s or rad/s). Choose other \
         final_joint_angles, or final_end_effector_twists that the arms can give"
    )]
    Unreachable {
        /// 3 per arm.
        rows: usize,
        /// Joints.
        columns: usize,
        /// Largest singular value.
        largest: f64,
        /// Smallest singular value.
        smallest: f64,
        /// Largest component of the twist that is missed.
        miss: f64,
    },
    /// The iteration did not converge.
    #[error(
        "the terminal rates did not converge: after {iterations} iterations they still change by {change:.3e} rad/s"
    )]
    NotConverged {
        /// How many were made.
        iterations: usize,
        /// Largest change in the last one, rad/s.
        change: f64,
    },
}

/// Terminal joint rates θ̇(T) such that `J(q(T)) θ̇(T)` is the desired end effector twist for a robot from rest.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TerminalRates {
    /// θ̇(T), rad/s, the final rates of the trajectory.
    pub joint_rates: Vec<f64>,
    /// Smallest singular value of the generalized Jacobian at the final pose over its largest.
    pub singularity_margin: f64,
    /// How many ends of approaches were computed.
    pub iterations: usize,
}

/// The fixed point of: the end of an exactly tracked approach → final base pose → J⁻¹ → terminal rates → its end.
///
/// The base turns along the path (the robot is non-holonomic), so the final pose depends on the terminal rates, but
/// weakly: the iteration contracts. What it depends on is one number, the final yaw of the base, so that the secant
/// through the last two iterations (Anderson 1965, with one step back) has half of them left.
///
/// # Errors
/// [`TerminalRatesError`].
pub fn terminal_rates(
    model: &AnyModel<f64>,
    approach: &ApproachTracking<'_>,
    goals: &[EndEffectorTwistGoal],
    tick: &mut dyn FnMut(),
) -> Result<TerminalRates, TerminalRatesError> {
    let mut rates = DVector::zeros(model.joints());
    // the last image and its change
    let mut before: Option<[DVector<f64>; 2]> = None;
    let (mut change, mut size, mut singularity_margin) = (f64::INFINITY, 0.0, 0.0);
    for iteration in 1..=MAX_ITERATIONS {
        tick();
        let end = approach.exact_end(model, rates.as_slice()).map_err(|source| {
            if iteration == 1 {
                return TerminalRatesError::PhaseError(source);
            }
            let source = Some(source);
            TerminalRatesError::Diverged { iteration, largest_rate: size, singularity_margin, source }
        })?;
        let (next, margin) = rates_for(model, &end, goals).map_err(|error| match error {
            // the goals were in reach before
            TerminalRatesError::Unreachable { largest, smallest, .. } if iteration > 1 => {
                let singularity_margin = smallest / largest;
                TerminalRatesError::Diverged { iteration, largest_rate: size, singularity_margin, source: None }
            }
            error => error,
        })?;
        let next = DVector::from_vec(next);
        let difference = &next - &rates;
        (change, size, singularity_margin) = (difference.amax(), next.amax(), margin);
        if change <= TOLERANCE * size {
            let joint_rates = next.data.into();
            return Ok(TerminalRates { joint_rates, singularity_margin, iterations: iteration });
        }
        rates = before.as_ref().and_then(|before| secant(before, [&next, &difference])).unwrap_or_else(|| next.clone());
        before = Some([next, difference]);
    }
    Err(TerminalRatesError::NotConverged { iterations: MAX_ITERATIONS, change })
}

/// Where the line through the last two changes is nearest to zero, in the line of their images; `None` where they show no
/// contraction.
fn secant([image, change]: &[DVector<f64>; 2], [next, next_change]: [&DVector<f64>; 2]) -> Option<DVector<f64>> {
    let fall = next_change - change;
    let part = fall.dot(next_change) / fall.norm_squared();
    (part.abs() <= LONGEST).then(|| next - (next - image) * part)
}

/// The joint rates that give the desired twists in a state, rad/s, and the singularity margin there.
pub(crate) fn rates_for(
    model: &AnyModel<f64>,
    ApproachEnd { state, end_effector_twists, time, .. }: &ApproachEnd,
    goals: &[EndEffectorTwistGoal],
) -> Result<(Vec<f64>, f64), TerminalRatesError> {
    let (_, jacobian) = reduced_matrices(model, &state.view()).map_err(|source| PhaseError { time: *time, source })?;
    // t_e = J θ̇ + the part of the robot's momentum, which is zero for a robot at rest
    let momentum_part = DVector::from_column_slice(end_effector_twists.as_flattened())
        - &jacobian * DVector::from_column_slice(&state.joint_rates);
    let goals = goals.as_flattened().iter().enumerate();
    let (selected, values): (Vec<usize>, Vec<f64>) =
        goals.filter_map(|(row, value)| Some((row, (*value)? - momentum_part[row]))).unzip();
    let (jacobian, right) = (jacobian.select_rows(&selected), DVector::from_vec(values));
    let svd = jacobian.clone().svd(true, true);
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    let (rows, columns) = jacobian.shape();
    let unreachable = |miss| TerminalRatesError::Unreachable { rows, columns, largest, smallest, miss };
    let rates = svd.solve(&right, largest * 1e-12).map_err(|_| unreachable(right.amax()))?;
    let miss = (&jacobian * &rates - &right).amax();
    if miss > RESIDUAL_TOLERANCE * right.amax() {
        return Err(unreachable(miss));
    }
    let margin = if largest > 0.0 { smallest / largest } else { 0.0 };
    Ok((rates.data.into(), margin))
}

#[cfg(test)]
mod tests;
