//! Semi-implicit Euler: explicit in the rates, then the positions with the new rates.

use crate::error::Error;
use crate::linear::add_scaled;
use crate::scalar::Real;
use crate::state::{StateVector, split, split_mut};
use crate::validate::length;

/// A step changes the rates by their derivatives, then the positions by the *new* rates; the global error is O(step).
///
/// For vectors of positions, their rates and an [`ActuatorWork`](crate::state::ActuatorWork), see
/// [`vector_length`](crate::state::vector_length). One evaluation per step. The method is symplectic where the mass matrix
/// is constant; that of an arm is not, so that momentum and energy have errors of O(step).
#[derive(Debug)]
pub struct SemiImplicitEuler<'a, T> {
    slope: &'a mut [T],
}

impl<'a, T: Real> SemiImplicitEuler<'a, T> {
    /// An integrator for vectors of the workspace's length.
    pub fn new(workspace: &'a mut [T]) -> Self {
        Self { slope: workspace }
    }

    /// One step from `time` to `time + step`.
    ///
    /// # Errors
    /// [`Error::Length`] for an `x` of another length than the workspace, and those of `derivative`; `x` is then
    /// unchanged.
    pub fn step(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.update_rates(time, step, x, derivative)?;
        Self::update_positions(step, x)
    }

    /// The first part of a step: rates and work. The rates may be corrected before [`Self::update_positions`].
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn update_rates(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        mut derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        length("state vector", self.slope.len(), x.len())?;
        derivative(time, x, self.slope)?;
        let (StateVector { rates, work, .. }, slope) = (split_mut(x)?, split(self.slope)?);
        add_scaled(rates, step, slope.rates);
        add_scaled(work, step, slope.work);
        Ok(())
    }

    /// The second part of a step: positions by the rates in `x`.
    ///
    /// # Errors
    /// [`Error::StateVector`] unless `x` is an integrated vector.
    pub fn update_positions(step: T, x: &mut [T]) -> Result<(), Error> {
        let StateVector { positions, rates, .. } = split_mut(x)?;
        add_scaled(positions, step, rates);
        Ok(())
    }
}
