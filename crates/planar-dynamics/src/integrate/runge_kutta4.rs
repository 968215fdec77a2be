//! The classical Runge–Kutta method of fourth order.

use crate::control::Control;
use crate::dynamics::Model;
use crate::error::Error;
use crate::formulation::accelerations;
use crate::linear::copy;
use crate::read_again::{from_memory, read_again};
use crate::scalar::Real;
use crate::state::{State, split, split_mut};
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
        // adding to negative zeros leaves all bits
        sum.fill(-T::ZERO);
        copy(x, stage);
        // one call in the text, which can then be inlined
        for (at, weight, next) in stages(step) {
            derivative(time + at, stage, slope)?;
            advance(sum, stage, x, from_memory(slope), weight, next);
        }
        // not kept from the last stage
        read_again(&mut *x);
        end(x, step, sum);
        Ok(())
    }

    /// As [`step`](Self::step) of [`derivative`](crate::formulation::derivative), with its bits: a step of a robot and free bodies
    /// under a control law. The slopes of the positions are not copied, they are the rates of the stage. `torques` (joints) holds
    /// those of the last stage afterwards. [`Control::begin_step`] is left to the caller.
    ///
    /// A generated model of up to 11 joints, without bodies and a base torque, takes its step in arrays on the stack, except on 32-bit Arm:
    /// whether it is regular and finite is asked at its end, and where it is not, its stages are computed again, to see which of them
    /// is not. The law is then asked twice, first also at the stages that follow on such a one, whose numbers may be NaN. One with a
    /// base torque is asked once more at the start of a step. Such a step is one call where the type of the model is not known; where law
    /// and vectors are of known lengths, too (arrays, not `Vec`s), it takes little more than one written by hand.
    ///
    /// # Errors
    /// As [`step`](Self::step): of the robot's numbers. Work and free bodies are not looked at.
    ///
    /// # Example
    /// ```
    /// use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
    /// use planar_dynamics::control::ProportionalDerivative;
    /// use planar_dynamics::dynamics::MomentumAndEnergy;
    /// use planar_dynamics::integrate::RungeKutta4;
    /// use planar_dynamics::state::{State, vector_length};
    /// use planar_dynamics::trajectory::{PointToPoint, Quartic};
    ///
    /// const LENGTH: usize = vector_length(JOINTS);
    /// let robot = Model::<f64>::default();
    /// let motion = PointToPoint { initial_angles: &[0.0; JOINTS], final_angles: &[0.1; JOINTS], duration: 1.0 };
    /// let trajectory = Quartic { motion, final_rates: &[0.0; JOINTS] };
    /// let (proportional_gain, derivative_gain) = (&[400.0; JOINTS], &[200.0; JOINTS]);
    /// let mut law = ProportionalDerivative { trajectory, proportional_gain, derivative_gain };
    /// // at rest, all angles 0
    /// let (mut x, mut torques) = ([0.0; LENGTH], [0.0; JOINTS]);
    /// let mut workspace = [0.0; RungeKutta4::<f64>::WORKSPACE * LENGTH];
    /// let mut integrator = RungeKutta4::new(&mut workspace)?;
    /// for step in 0..1000 {
    ///     integrator.robot_step(&robot, &mut law, f64::from(step) * 1e-3, 1e-3, &mut x, &mut torques)?;
    /// }
    /// let end = State::from_vector(&x, JOINTS)?;
    /// assert!(end.joint_angles.iter().all(|angle| (angle - 0.1).abs() < 0.02), "{:?}", end.joint_angles);
    /// // no force acts on the robot: its momentum is that of the start
    /// assert!(MomentumAndEnergy::momentum(&robot, &end)?.angular_momentum.abs() < 1e-9);
    /// # Ok::<(), planar_dynamics::error::Error>(())
    /// ```
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
        // an error of the law may be one of a stage after that which is not regular
        let mut torques_at = |time: T, x: &[T], torques: &mut [T]| {
            control.joint_torques(time, model, &State::from_vector(x, model.joints()).ok()?, torques).ok()?;
            control.base_torque().is_none().then_some(())
        };
        if model.step_at_once(Some(&mut torques_at), [time, step], x, torques).is_some() {
            return Ok(());
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
            (*sum, *stage) = (-zero, *x - zero);
        }
        for (at, weight, next) in stages(step) {
            let x = read_again(&*x).get(..sum.len()).unwrap_or_default();
            robot_stage(model, control, (time + at, weight, next), x, [slope, sum, stage], torques)?;
        }
        let x = read_again(x).get_mut(..sum.len()).unwrap_or_default();
        end(x, step, sum);
        Ok(())
    }
}

/// One stage at its time, with its weight and the next stage's distance: slopes, sums and the next stage.
#[inline]
fn robot_stage<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    control: &mut (impl Control<T, M> + ?Sized),
    (time, weight, next): (T, T, T),
    x: &[T],
    [slope, sum, stage]: [&mut [T]; 3],
    torques: &mut [T],
) -> Result<(), Error> {
    let slopes = split_mut(slope)?.rates;
    let work_slopes = accelerations(model, control, time, stage, slopes, torques)?;
    let (sum, x, stage) = (split_mut(sum)?, split(x)?, split_mut(stage)?);
    advance(sum.positions, stage.positions, x.positions, stage.rates, weight, next);
    advance(sum.rates, stage.rates, x.rates, slopes, weight, next);
    advance(sum.work, stage.work, x.work, &work_slopes, weight, next);
    Ok(())
}

/// Of each stage: its time after the start, its weight, and how far along its slope the next one is; the last is not used.
#[inline]
pub(super) fn stages<T: Real>(step: T) -> [(T, T, T); 4] {
    let (half, two) = (step * T::constant(0.5), T::constant(2.0));
    [(T::ZERO, T::ONE, half), (half, two, half), (half, two, step), (step, T::ONE, T::ZERO)]
}

/// The vector at the end of a step, by the sums of its slopes.
fn end<T: Real>(x: &mut [T], step: T, sum: &[T]) {
    let sixth = step / T::constant(6.0);
    for (x, sum) in x.iter_mut().zip(sum) {
        *x = T::mul_add(*sum, sixth, *x);
    }
}

/// Adds the weighted slopes to the sums, and takes the next stage from them.
#[inline]
fn advance<T: Real>(sum: &mut [T], stage: &mut [T], x: &[T], slopes: &[T], weight: T, next: T) {
    for ((sum, stage), (x, slope)) in sum.iter_mut().zip(stage).zip(x.iter().zip(slopes)) {
        *sum = T::mul_add(*slope, weight, *sum);
        *stage = T::mul_add(*slope, next, *x);
    }
}
