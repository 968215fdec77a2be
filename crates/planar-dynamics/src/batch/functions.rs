//! The functions of a batch.

use super::arrays::{Accelerations, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Targets};
use super::block::{Number, Place};
use super::dispatch::{Detected, Instructions, Kernel};
use super::model::BatchModel;
use crate::error::Error;
use crate::status::Status;
use crate::validate::length;
use core::marker::PhantomData;

/// Functions of N instances of a robot, with an instruction set of the choice `I`.
///
/// Each writes the status of every instance, and its results where that is [`Status::Done`]; those of others stay as they
/// were. The conditions for a result are those of the model's traits.
///
/// # Errors
/// [`Error::Length`] of a matrix that has not N columns, N being the number of statuses; nothing is then written.
#[derive(Debug)]
pub struct Batch<'m, M, I = Detected> {
    model: &'m M,
    instructions: PhantomData<I>,
}

impl<'m, M: BatchModel> Batch<'m, M> {
    /// With the best instruction set of the processor.
    pub const fn new(model: &'m M) -> Self {
        Self::with_instructions(model)
    }
}

impl<'m, M: BatchModel, I: Instructions> Batch<'m, M, I> {
    /// With a choice of the instruction set: `Batch::<_, Avx2>::with_instructions(&robot)`.
    pub const fn with_instructions(model: &'m M) -> Self {
        Self { model, instructions: PhantomData }
    }

    /// Accelerations under joint torques alone; see [`ForwardDynamics`](crate::dynamics::ForwardDynamics).
    ///
    /// - `joint_torques`: a row per joint; N m.
    ///
    /// # Errors
    /// See [`Batch`].
    pub fn forward_dynamics(
        &self,
        states: &States<'_>,
        joint_torques: &[f64],
        results: &mut Accelerations<'_>,
        statuses: &mut [Status],
    ) -> Result<(), Error> {
        let count = statuses.len();
        check_states::<M>(states, count)?;
        rows("joint_torques", M::JOINTS, count, joint_torques)?;
        rows("base accelerations", 3, count, results.base)?;
        rows("joint accelerations", M::JOINTS, count, results.joints)?;
        I::run(&mut ForwardDynamicsCall { model: self.model, states, joint_torques, results }, statuses);
        Ok(())
    }

    /// Generalized inertia, bias and Jacobian of eq. (2); see [`ReducedDynamics`](crate::dynamics::ReducedDynamics).
    ///
    /// # Errors
    /// See [`Batch`].
    pub fn reduced_dynamics(
        &self,
        states: &States<'_>,
        results: &mut ReducedDynamics<'_>,
        statuses: &mut [Status],
    ) -> Result<(), Error> {
        let count = statuses.len();
        check_states::<M>(states, count)?;
        rows("generalized_inertia", M::JOINTS * M::JOINTS, count, results.generalized_inertia)?;
        rows("generalized_bias", M::JOINTS, count, results.generalized_bias)?;
        rows("generalized_jacobian", 3 * M::ARMS * M::JOINTS, count, results.generalized_jacobian)?;
        I::run(&mut ReducedDynamicsCall { model: self.model, states, results }, statuses);
        Ok(())
    }

    /// G, H and the joint rates after the paper's impact; see [`Impact::reduced_impact`](crate::dynamics::Impact).
    ///
    /// # Errors
    /// See [`Batch`].
    pub fn reduced_impact(
        &self,
        states: &States<'_>,
        targets: &Targets<'_>,
        results: &mut ReducedImpact<'_>,
        statuses: &mut [Status],
    ) -> Result<(), Error> {
        let count = statuses.len();
        check_states::<M>(states, count)?;
        check_targets::<M>(targets, count)?;
        rows("impact_matrix", M::JOINTS * M::JOINTS, count, results.impact_matrix)?;
        rows("impact_momentum", M::JOINTS, count, results.impact_momentum)?;
        rows("joint_rates_after", M::JOINTS, count, results.joint_rates_after)?;
        I::run(&mut ReducedImpactCall { model: self.model, states, targets, results }, statuses);
        Ok(())
    }

    /// Velocities after the exact impact; see [`Impact::full_impact`](crate::dynamics::Impact).
    ///
    /// # Errors
    /// See [`Batch`].
    pub fn full_impact(
        &self,
        states: &States<'_>,
        targets: &Targets<'_>,
        results: &mut FullImpact<'_>,
        statuses: &mut [Status],
    ) -> Result<(), Error> {
        let count = statuses.len();
        check_states::<M>(states, count)?;
        check_targets::<M>(targets, count)?;
        rows("base_twists_after", 3, count, results.base_twists_after)?;
        rows("joint_rates_after", M::JOINTS, count, results.joint_rates_after)?;
        I::run(&mut FullImpactCall { model: self.model, states, targets, results }, statuses);
        Ok(())
    }

    /// The states after one step of [`RungeKutta4`](crate::integrate::RungeKutta4) of `step` s under constant joint
    /// torques. An instance has no result where one of its four stages has none.
    ///
    /// # Errors
    /// See [`Batch`].
    pub fn runge_kutta_step(
        &self,
        states: &States<'_>,
        joint_torques: &[f64],
        step: f64,
        after: &mut StatesAfter<'_>,
        statuses: &mut [Status],
    ) -> Result<(), Error> {
        let count = statuses.len();
        check_states::<M>(states, count)?;
        rows("joint_torques", M::JOINTS, count, joint_torques)?;
        let StatesAfter { base_poses, joint_angles, base_twists, joint_rates } = &*after;
        check_states::<M>(&States { base_poses, joint_angles, base_twists, joint_rates }, count)?;
        I::run(&mut RungeKuttaCall { model: self.model, states, joint_torques, step, results: after }, statuses);
        Ok(())
    }
}

/// A function of [`BatchModel`] with its arguments.
macro_rules! call {
    ($call:ident<$short:lifetime, $long:lifetime>, $function:ident($($argument:ident: $type:ty),*) -> $results:ty) => {
        struct $call<$short, $long, M> {
            model: &$short M,
            $($argument: $type,)*
            results: &$short mut $results,
        }

        impl<M: BatchModel> Kernel for $call<'_, '_, M> {
            type Model<T: Number> = M::Of<T>;

            fn model<T: Number>(&self) -> M::Of<T> {
                self.model.with_scalar()
            }

            fn is_finite(&self) -> bool {
                self.model.is_finite()
            }

            #[inline(always)]
            fn evaluate<T: Number, const B: usize>(
                &mut self,
                model: &M::Of<T>,
                place: Place,
                statuses: &mut [Status],
            ) {
                M::$function::<T, B>(model, $(self.$argument,)* self.results, place, statuses);
            }
        }
    };
}

call!(ForwardDynamicsCall<'c, 'd>, forward_dynamics(states: &'c States<'c>, joint_torques: &'c [f64])
    -> Accelerations<'d>);
call!(ReducedDynamicsCall<'c, 'd>, reduced_dynamics(states: &'c States<'c>) -> ReducedDynamics<'d>);
call!(ReducedImpactCall<'c, 'd>, reduced_impact(states: &'c States<'c>, targets: &'c Targets<'c>)
    -> ReducedImpact<'d>);
call!(FullImpactCall<'c, 'd>, full_impact(states: &'c States<'c>, targets: &'c Targets<'c>) -> FullImpact<'d>);
call!(RungeKuttaCall<'c, 'd>, runge_kutta_step(states: &'c States<'c>, joint_torques: &'c [f64], step: f64)
    -> StatesAfter<'d>);

fn check_states<M: BatchModel>(states: &States<'_>, count: usize) -> Result<(), Error> {
    rows("base_poses", 3, count, states.base_poses)?;
    rows("joint_angles", M::JOINTS, count, states.joint_angles)?;
    rows("base_twists", 3, count, states.base_twists)?;
    rows("joint_rates", M::JOINTS, count, states.joint_rates)
}

fn check_targets<M: BatchModel>(targets: &Targets<'_>, count: usize) -> Result<(), Error> {
    rows("target masses", M::ARMS, count, targets.masses)?;
    rows("target inertias", M::ARMS, count, targets.inertias)?;
    rows("target contacts", 2 * M::ARMS, count, targets.contacts)?;
    rows("target twists", 3 * M::ARMS, count, targets.twists)
}

/// [`Error::Length`] unless a matrix has so many rows and columns.
fn rows(quantity: &'static str, rows: usize, columns: usize, matrix: &[f64]) -> Result<(), Error> {
    length(quantity, rows * columns, matrix.len())
}
