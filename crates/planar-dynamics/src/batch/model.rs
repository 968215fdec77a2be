//! What a batch needs of a model; for generated code alone.

use super::arrays::{Accelerations, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Targets};
use super::block::{Number, Place};
use crate::status::Status;

/// A generated model of which batches can be computed: `Model<f64>`.
///
/// The methods compute the instances of a place in blocks of B. They write the results of those that are done, and the
/// statuses of the others.
pub trait BatchModel {
    /// The model with another scalar.
    type Of<T: Number>;

    /// Number of arms.
    const ARMS: usize;
    /// Number of joints.
    const JOINTS: usize;

    /// This model.
    fn with_scalar<T: Number>(&self) -> Self::Of<T>;

    /// Whether all parameters are finite.
    fn is_finite(&self) -> bool;

    /// See [`Batch::forward_dynamics`](super::Batch::forward_dynamics).
    fn forward_dynamics<T: Number, const B: usize>(
        model: &Self::Of<T>,
        states: &States<'_>,
        joint_torques: &[f64],
        results: &mut Accelerations<'_>,
        place: Place,
        statuses: &mut [Status],
    );

    /// See [`Batch::reduced_dynamics`](super::Batch::reduced_dynamics).
    fn reduced_dynamics<T: Number, const B: usize>(
        model: &Self::Of<T>,
        states: &States<'_>,
        results: &mut ReducedDynamics<'_>,
        place: Place,
        statuses: &mut [Status],
    );

    /// See [`Batch::reduced_impact`](super::Batch::reduced_impact).
    fn reduced_impact<T: Number, const B: usize>(
        model: &Self::Of<T>,
        states: &States<'_>,
        targets: &Targets<'_>,
        results: &mut ReducedImpact<'_>,
        place: Place,
        statuses: &mut [Status],
    );

    /// See [`Batch::full_impact`](super::Batch::full_impact).
    fn full_impact<T: Number, const B: usize>(
        model: &Self::Of<T>,
        states: &States<'_>,
        targets: &Targets<'_>,
        results: &mut FullImpact<'_>,
        place: Place,
        statuses: &mut [Status],
    );

    /// See [`Batch::runge_kutta_step`](super::Batch::runge_kutta_step).
    fn runge_kutta_step<T: Number, const B: usize>(
        model: &Self::Of<T>,
        states: &States<'_>,
        joint_torques: &[f64],
        step: f64,
        after: &mut StatesAfter<'_>,
        place: Place,
        statuses: &mut [Status],
    );
}
