//! The classical Runge–Kutta method of fourth order with a fixed step.

use crate::error::Error;
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
    /// How many times its vectors' length the workspace is long.
    pub const WORKSPACE: usize = 3;

    /// An integrator for vectors of a third of the workspace's length.
    ///
    /// # Errors
    /// [`Error::Length`] where that is not whole.
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
    /// [`Error::Length`] where `x` is not as long as the integrator's vectors, and what `derivative` says;
    /// `x` is then as it was.
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
        derivative(time, x, slope)?;
        sum.copy_from_slice(slope);
        for (advance, weight) in [(half, two), (half, two), (step, T::ONE)] {
            for (s, (x, k)) in stage.iter_mut().zip(x.iter().zip(slope.iter())) {
                *s = *x + advance * *k;
            }
            derivative(time + advance, stage, slope)?;
            for (s, k) in sum.iter_mut().zip(slope.iter()) {
                *s += weight * *k;
            }
        }
        let sixth = step / T::constant(6.0);
        for (x, s) in x.iter_mut().zip(sum.iter()) {
            *x += sixth * *s;
        }
        Ok(())
    }
}
