//! End rates of the approach, designed from the end effector twists that are wanted at contact.

use crate::capture::approach::Approach;
use crate::dynamics::Model;
use crate::owned::RobotState;
use crate::scenario::EndEffectorTwistGoal;
use crate::simulate::{Phase, PhaseError, Sample};
use nalgebra::{DMatrix, DVector};

/// Fixed-point iterations before giving up; each gains several digits.
const MOST_ITERATIONS: usize = 60;
/// Two iterations agree when no joint rate differs by more than this part of the largest.
const AGREEMENT: f64 = 1e-13;
/// What of the wanted twist may be missed where the generalized Jacobian cannot give it.
const MISS: f64 = 1e-9;

/// Why no end rates were found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TerminalRatesError {
    /// The approach could not be tracked.
    #[error("while the end rates were designed, {0}")]
    PhaseError(#[from] PhaseError),
    /// The end rates grew until their approach could not be tracked.
    #[error(
        "the end rates that the wanted tip twists ask for grow without bound, to {largest_rate:.3e} rad/s in round \
         {iteration}: the final pose is close to singular (generalized Jacobian: smallest/largest singular value \
         {singularity_margin:.1e}). Choose other final_joint_angles, or final_end_effector_twists that the arms can \
         give ({source})"
    )]
    Diverged {
        /// The round that failed.
        iteration: usize,
        /// rad/s.
        largest_rate: f64,
        /// Of the round before.
        singularity_margin: f64,
        /// How it failed.
        source: PhaseError,
    },
    /// The wanted twist is out of reach at the final pose.
    #[error(
        "the wanted tip twists are out of reach at the final pose: the generalized Jacobian ({rows} × {columns}, singular \
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
    /// The iteration goes on and on.
    #[error("the end rates did not settle: after {iterations} iterations they still change by {change:.3e} rad/s")]
    Unsettled {
        /// How many were made.
        iterations: usize,
        /// Largest change in the last one, rad/s.
        change: f64,
    },
}

/// End rates θ̇(T) such that `J(q(T)) θ̇(T)` is the wanted end effector twist, and what the design saw.
#[derive(Clone, Debug, PartialEq)]
pub struct TerminalRates {
    /// rad/s, to be put into the trajectory.
    pub joint_rates: Vec<f64>,
    /// Smallest singular value of the generalized Jacobian at the final pose over its largest.
    pub singularity_margin: f64,
    /// How many approaches were tracked.
    pub iterations: usize,
}

/// The fixed point of: track the approach exactly → final base pose → J⁻¹ → end rates → track.
///
/// The base turns with the path (the robot is non-holonomic), so the final pose depends on the end rates,
/// weakly: the iteration contracts.
///
/// # Errors
/// [`TerminalRatesError`], with the numbers.
pub fn terminal_rates(
    model: &dyn Model<f64>,
    approach: &Approach<'_>,
    wanted: &[EndEffectorTwistGoal],
    tick: &mut dyn FnMut(),
) -> Result<TerminalRates, TerminalRatesError> {
    let mut rates = vec![0.0; model.joints()];
    let (mut change, mut size, mut singularity_margin) = (f64::INFINITY, 0.0, 0.0);
    for iteration in 1..=MOST_ITERATIONS {
        let phase = approach.track_exactly(model, &rates, tick).map_err(|source| match iteration {
            1 => TerminalRatesError::PhaseError(source),
            _ => TerminalRatesError::Diverged { iteration, largest_rate: size, singularity_margin, source },
        })?;
        let (next, margin) = rates_for(model, &phase, wanted)?;
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, x| most.max(x.abs()));
        change = largest(&mut next.iter().zip(&rates).map(|(a, b)| a - b));
        size = largest(&mut next.iter().copied());
        (rates, singularity_margin) = (next, margin);
        if change <= AGREEMENT * size {
            return Ok(TerminalRates { joint_rates: rates, singularity_margin, iterations: iteration });
        }
    }
    Err(TerminalRatesError::Unsettled { iterations: MOST_ITERATIONS, change })
}

/// Joint rates that give the wanted twists at the end of a phase, and the singularity margin there.
pub(crate) fn rates_for(
    model: &dyn Model<f64>,
    phase: &Phase,
    wanted: &[EndEffectorTwistGoal],
) -> Result<(Vec<f64>, f64), TerminalRatesError> {
    let joints = model.joints();
    let Some(Sample { state, end_effector_twists, time, .. }) = phase.end() else {
        return Ok((vec![0.0; joints], 0.0));
    };
    let jacobian = generalized_jacobian(model, state).map_err(|source| PhaseError { time: *time, source })?;
    // t_e = J joint_rates + what the robot's momentum alone gives (zero for a robot at rest)
    let momentum_part = DVector::from_column_slice(end_effector_twists.as_flattened())
        - &jacobian * DVector::from_column_slice(&state.joint_rates);
    // the rows of what is wanted
    let wanted: Vec<(usize, f64)> =
        wanted.as_flattened().iter().enumerate().filter_map(|(row, part)| Some((row, (*part)?))).collect();
    let rows = wanted.len();
    let jacobian = DMatrix::from_fn(rows, joints, |i, j| wanted.get(i).map_or(0.0, |(row, _)| jacobian[(*row, j)]));
    let right = DVector::from_iterator(rows, wanted.iter().map(|(row, part)| part - momentum_part[*row]));
    let svd = jacobian.clone().svd(true, true);
    let (largest, smallest) = (svd.singular_values.max(), svd.singular_values.min());
    let unreachable = |miss| TerminalRatesError::Unreachable { rows, columns: joints, largest, smallest, miss };
    let Ok(rates) = svd.solve(&right, largest * 1e-12) else {
        return Err(unreachable(right.amax()));
    };
    let miss = (&jacobian * &rates - &right).amax();
    if miss > MISS * right.amax() {
        return Err(unreachable(miss));
    }
    let margin = if largest > 0.0 { smallest / largest } else { 0.0 };
    Ok((rates.iter().copied().collect(), margin))
}

/// J at a state: 3 per arm × joints.
pub(crate) fn generalized_jacobian(
    model: &dyn Model<f64>,
    state: &RobotState,
) -> Result<DMatrix<f64>, crate::error::Error> {
    let (joints, rows) = (model.joints(), 3 * model.arms());
    let mut inertia = vec![0.0; joints * joints];
    let mut bias = vec![0.0; joints];
    let mut jacobian = vec![0.0; rows * joints];
    model.reduced_dynamics(&state.view(), &mut inertia, &mut bias, &mut jacobian)?;
    Ok(DMatrix::from_row_slice(rows, joints, &jacobian))
}
