//! The classical Runge–Kutta method of fourth order.

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::formulation::accelerations;
use crate::linear::{add_scaled, copy};
use crate::read_again::{from_memory, read_again};
use crate::scalar::Real;
use crate::state::{StateVector, split, split_mut, vector_length};
use crate::validate::{all_finite, is_regular, length};

/// Vectors of up to so many numbers are a robot's step's own: numbers of a vector whose length the compiler knows are then in
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
    /// those of the last stage afterwards. Vectors of up to 32 numbers are on the stack instead of in the workspace, except on Arm;
    /// whether such a step is regular and finite is asked at its end, and where it is not, its stages are computed again, to see
    /// which of them is not: the law is then asked twice, first about what follows after such a stage, too, which may be NaN.
    ///
    /// It is as fast as a step written by hand where model, law and vectors are of known lengths (arrays, not `Vec`s) and in the
    /// function that calls it. [`Control::begin_step`] is left to the caller.
    ///
    /// # Errors
    /// As [`step`](Self::step): of the robot's numbers. Work and free bodies are not looked at.
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
        // the number of joints is known to the compiler where the vector's length is not: a large robot has no four stages in its text
        if OWN > 0 && x.len().max(vector_length(model.joints())) <= OWN {
            // an error of the law may be one of a stage after that which is not regular
            if let Ok(true) = step_at_once(model, control, time, step, x, torques) {
                return Ok(());
            }
        }
        self.step_by_stages(model, control, time, step, x, torques)
    }

    /// The step in the workspace, with a look at each stage. As a part of [`robot_step`](Self::robot_step), it would make that 3 % longer
    /// where vectors have four lanes.
    #[inline]
    fn step_by_stages<M: Model<T> + ?Sized>(
        &mut self,
        model: &M,
        control: &mut (impl Control<T, M> + ?Sized),
        time: T,
        step: T,
        x: &mut [T],
        torques: &mut [T],
    ) -> Result<(), Error> {
        let Self { slope, sum, stage } = self;
        // number by number: where the compiler knows that they are zeros and copies, it calls functions for memory, which take
        // up to ten instructions for each
        let zero = read_again(T::ZERO);
        for ((sum, stage), x) in sum.iter_mut().zip(stage.iter_mut()).zip(x.iter()) {
            (*sum, *stage) = (zero, *x - zero);
        }
        for (at, weight, next) in stages(step) {
            let x = read_again(&*x).get(..sum.len()).unwrap_or_default();
            robot_stage::<_, _, true>(model, control, (time + at, weight, next), x, [slope, sum, stage], torques)?;
        }
        let x = read_again(x).get_mut(..sum.len()).unwrap_or_default();
        add_scaled(x, step / T::constant(6.0), sum);
        Ok(())
    }
}

/// The step, or false, where it is not regular and finite; `x` is then unchanged. Each branch between stages would keep numbers
/// in memory, and a stage wait for them.
#[inline(always)]
#[allow(clippy::inline_always, reason = "the caller knows the lengths")]
fn step_at_once<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    control: &mut (impl Control<T, M> + ?Sized),
    time: T,
    step: T,
    x: &mut [T],
    torques: &mut [T],
) -> Result<bool, Error> {
    let (mut start, mut slope, mut sum, mut stage) = ([T::ZERO; OWN], [T::ZERO; OWN], [T::ZERO; OWN], [T::ZERO; OWN]);
    let [start, slope, sum, stage] = [
        start.get_mut(..x.len()).unwrap_or_default(),
        slope.get_mut(..x.len()).unwrap_or_default(),
        sum.get_mut(..x.len()).unwrap_or_default(),
        stage.get_mut(..x.len()).unwrap_or_default(),
    ];
    copy(x, start);
    copy(x, stage);
    let [first, second, third, fourth] = stages(step).map(|(at, weight, next)| (time + at, weight, next));
    // slopes depend on all numbers but the place of the base: the places of all stages are finite where their sum is
    let mut places = [T::ZERO; 3];
    // four times in the text: of a loop's vectors, the numbers would not be in registers
    let pivots = [
        robot_stage::<_, _, false>(model, control, first, start, [slope, sum, add(stage, &mut places)], torques)?,
        robot_stage::<_, _, false>(model, control, second, start, [slope, sum, add(stage, &mut places)], torques)?,
        robot_stage::<_, _, false>(model, control, third, start, [slope, sum, add(stage, &mut places)], torques)?,
        robot_stage::<_, _, false>(model, control, fourth, start, [slope, sum, add(stage, &mut places)], torques)?,
    ];
    if !(pivots.into_iter().fold(true, |all, pivot| all & is_regular(pivot)) && all_finite([sum, &places])) {
        return Ok(false);
    }
    add_scaled(x, step / T::constant(6.0), sum);
    Ok(true)
}

/// The same vector, whose first numbers are added to the sums.
#[inline(always)]
#[allow(clippy::inline_always, reason = "the caller knows the lengths")]
fn add<'v, T: Real>(vector: &'v mut [T], sums: &mut [T; 3]) -> &'v mut [T] {
    add_scaled(sums, T::ONE, vector);
    vector
}

/// One stage at its time, with its weight and the next stage's distance: slopes, sums and the next stage, and the smallest
/// pivot, unless it is `CHECKED` here.
#[cfg_attr(target_arch = "arm", inline)]
#[cfg_attr(not(target_arch = "arm"), inline(always))]
#[allow(clippy::inline_always, reason = "the caller knows the lengths")]
fn robot_stage<T: Real, M: Model<T> + ?Sized, const CHECKED: bool>(
    model: &M,
    control: &mut (impl Control<T, M> + ?Sized),
    (time, weight, next): (T, T, T),
    x: &[T],
    [slope, sum, stage]: [&mut [T]; 3],
    torques: &mut [T],
) -> Result<T, Error> {
    let StateVector { rates: slopes, work: work_slopes, .. } = split_mut(slope)?;
    let pivot = accelerations::<_, _, CHECKED>(model, control, time, stage, slopes, work_slopes, torques)?;
    let (sum, x, stage) = (split_mut(sum)?, split(x)?, split_mut(stage)?);
    advance(sum.positions, stage.positions, x.positions, stage.rates, weight, next);
    advance(sum.rates, stage.rates, x.rates, slopes, weight, next);
    advance(sum.work, stage.work, x.work, work_slopes, weight, next);
    Ok(pivot)
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
        *sum = T::mul_add(*slope, weight, *sum);
        *stage = T::mul_add(*slope, next, *x);
    }
}
