//! The classical Runge–Kutta method of fourth order.

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::formulation::accelerations;
use crate::linear::{add_scaled, copy};
use crate::read_again::{from_memory, read_again};
use crate::scalar::Real;
use crate::state::{StateVector, split, split_mut};
use crate::validate::length;

/// The length of vectors that a robot's step has of its own: numbers of a vector whose length the compiler knows are then in
/// registers, as in a loop written by hand. None where registers are few.
const OWN: usize = if cfg!(target_arch = "arm") { 0 } else { 32 };

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
    /// then unchanged. A number that overflows in the last sum is one of `x`, and an error of the next step's.
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
        sum.fill(T::ZERO);
        copy(x, stage);
        // one call in the text, which can then be inlined
        for (at, weight, next) in stages(step) {
            derivative(time + at, stage, slope)?;
            advance(sum, stage, x, from_memory(slope), weight, next);
        }
        // not kept from the last stage
        read_again(&mut *x);
        add_scaled(x, step / T::constant(6.0), sum);
        Ok(())
    }

    /// As [`step`](Self::step) of [`derivative`](crate::formulation::derivative), with its bits: a step of a robot and free bodies
    /// under a control law. The slopes of the positions are not copied, they are the rates of the stage. `torques` (joints) holds
    /// those of the last stage afterwards. Vectors of up to 32 numbers are on the stack instead of in the workspace, except on Arm.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    #[cfg_attr(target_arch = "arm", inline)]
    #[cfg_attr(not(target_arch = "arm"), inline(always))]
    #[allow(clippy::inline_always, reason = "the caller knows the lengths")]
    pub fn robot_step<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        control: &mut (impl Control<T, M> + ?Sized),
        time: T,
        step: T,
        x: &mut [T],
        torques: &mut [T],
    ) -> Result<(), Error> {
        length("state vector", self.slope.len(), x.len())?;
        let mut own = [[T::ZERO; OWN]; 3];
        let [slope, sum, stage] = own.each_mut().map(|vector| vector.get_mut(..x.len()).filter(|_| OWN > 0));
        let [slope, sum, stage] = [slope.unwrap_or(self.slope), sum.unwrap_or(self.sum), stage.unwrap_or(self.stage)];
        // number by number: where the compiler knows that they are zeros and copies, it calls functions for memory, which take
        // up to ten instructions for each
        let zero = read_again(T::ZERO);
        for ((sum, stage), x) in sum.iter_mut().zip(stage.iter_mut()).zip(x.iter()) {
            (*sum, *stage) = (zero, *x - zero);
        }
        let StateVector { rates: slopes, work: work_slopes, .. } = split_mut(slope)?;
        for (at, weight, next) in stages(step) {
            accelerations(model, control, time + at, stage, slopes, work_slopes, torques)?;
            let x = read_again(&*x).get(..sum.len()).unwrap_or_default();
            let (sum, x, stage) = (split_mut(sum)?, split(x)?, split_mut(stage)?);
            advance(sum.positions, stage.positions, x.positions, stage.rates, weight, next);
            advance(sum.rates, stage.rates, x.rates, slopes, weight, next);
            advance(sum.work, stage.work, x.work, work_slopes, weight, next);
        }
        let x = read_again(x).get_mut(..sum.len()).unwrap_or_default();
        add_scaled(x, step / T::constant(6.0), sum);
        Ok(())
    }
}

/// Of each stage: its time after the start, its weight, and how far along its slope the next one is; the last is not used.
#[inline]
fn stages<T: Real>(step: T) -> [(T, T, T); 4] {
    let (half, two) = (step * T::constant(0.5), T::constant(2.0));
    [(T::ZERO, T::ONE, half), (half, two, half), (half, two, step), (step, T::ONE, T::ZERO)]
}

/// Adds the weighted slopes to the sums, and takes the next stage from them.
#[inline]
fn advance<T: Real>(sum: &mut [T], stage: &mut [T], x: &[T], slopes: &[T], weight: T, next: T) {
    for ((sum, stage), (x, slope)) in sum.iter_mut().zip(stage).zip(x.iter().zip(slopes)) {
        *sum += weight * *slope;
        *stage = *x + next * *slope;
    }
}
