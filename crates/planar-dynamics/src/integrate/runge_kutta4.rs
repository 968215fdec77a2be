//! The classical Runge–Kutta method of fourth order.

use crate::error::Error;
use crate::linear::{add_scaled, copy};
use crate::read_again::{from_memory, read_again};
use crate::scalar::Real;
use crate::validate::length;

/// ẋ = f(t, x) by fourth-order Runge–Kutta steps; the global error is O(step⁴).
#[derive(Debug)]
pub struct RungeKutta4<'a, T> {
    slope: &'a mut [T],
    sum: &'a mut [T],
    stage: &'a mut [T],
}

impl<'a, T: Real> RungeKutta4<'a, T> {
    /// The length of the workspace over that of the vectors.
    pub const WORKSPACE: usize = 3;

    /// An integrator for vectors of a third of the workspace's length.
    ///
    /// # Errors
    /// [`Error::Length`] unless the workspace's length is a multiple of 3.
    pub fn new(workspace: &'a mut [T]) -> Result<Self, Error> {
        let n = workspace.len() / Self::WORKSPACE;
        length("integrator workspace", n * Self::WORKSPACE, workspace.len())?;
        let (slope, rest) = workspace.split_at_mut(n);
        let (sum, stage) = rest.split_at_mut(n);
        Ok(Self { slope, sum, stage })
    }

    /// One step from `time` to `time + step`.
    ///
    /// # Errors
    /// [`Error::Length`] for an `x` of another length than the integrator's vectors, and those of `derivative`; `x` is
    /// then unchanged.
    #[inline]
    pub fn step(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        mut derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let Self { slope, sum, stage } = self;
        length("state vector", slope.len(), x.len())?;
        let half = step * T::constant(0.5);
        let two = T::constant(2.0);
        sum.fill(T::ZERO);
        copy(x, stage);
        // one call in the text, which can then be inlined; the last stage is not used
        for (at, weight, next) in
            [(T::ZERO, T::ONE, half), (half, two, half), (half, two, step), (step, T::ONE, T::ZERO)]
        {
            derivative(time + at, stage, slope)?;
            let slope = from_memory(slope);
            let places = sum.iter_mut().zip(stage.iter_mut());
            for ((sum, stage), (x, slope)) in places.zip(x.iter().zip(slope.iter())) {
                *sum += weight * *slope;
                *stage = *x + next * *slope;
            }
        }
        // not kept from the last stage
        read_again(&mut *x);
        add_scaled(x, step / T::constant(6.0), sum);
        Ok(())
    }
}
