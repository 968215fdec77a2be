//! Euler's method with the new rates in the positions.

use crate::error::Error;
use crate::scalar::Real;
use crate::state::{StateVectorMut, split, split_mut};
use crate::validate::length;

/// Rates by their derivatives, then positions by the *new* rates; the global error is O(step).
///
/// For vectors of positions, their rates and an [`ActuatorWork`](crate::state::ActuatorWork), see
/// [`vector_length`](crate::state::vector_length). One evaluation per step. Where the mass matrix is constant the
/// method is symplectic (symplectic Euler, the method of most game engines); the mass matrix of an arm is not, so that
/// momentum and energy stray by O(step).
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
    /// [`Error::Length`] where `x` is not as long as the workspace, and what `derivative` says; `x` is then as it was.
    pub fn step(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.kick(time, step, x, derivative)?;
        drift(step, x)
    }

    /// The first half of a step: rates and work. What may be done to the rates then comes before [`drift`].
    ///
    /// # Errors
    /// As [`Self::step`].
    pub fn kick(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        mut derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        length("state vector", self.slope.len(), x.len())?;
        derivative(time, x, self.slope)?;
        let positions = split(x)?.positions.len();
        for (x, slope) in x.iter_mut().zip(self.slope.iter()).skip(positions) {
            *x += step * *slope;
        }
        Ok(())
    }
}

/// The second half of a step: positions by the rates in `x`.
///
/// # Errors
/// [`Error::StateVector`] where `x` is no state.
pub fn drift<T: Real>(step: T, x: &mut [T]) -> Result<(), Error> {
    let StateVectorMut { positions, rates, .. } = split_mut(x)?;
    for (position, rate) in positions.iter_mut().zip(rates.iter()) {
        *position += step * *rate;
    }
    Ok(())
}
