//! An estimate of the error of the integrated path, which no conservation law shows: a second solution beside the first,
//! with other steps.
//!
//! Steps of n times the length give a solution whose error is nᵖ times as large, p being the order: the error is the
//! difference of the two over nᵖ − 1 (Richardson). It has what the motion makes of every step's error, and what feedback
//! leaves of it. n is 2, and 4, 8 or 16 for Runge–Kutta steps of a motion without feedback: that has no time constants shorter than
//! what its own steps follow, and a quarter of the steps costs half as much. More than 4 are for slow motions, which hardly turn in such
//! a step, and for differences that are small angles yet; where n changes, the second solution is put where its difference is that of
//! the new n. Each of the last steps, fewer than n, adds the difference of one of them and two of half its length. Where torques are held, the second takes steps of half the length,
//! and samples of its own, so that the law answers to its errors, too; a base torque is that of the first. Adaptive steps are
//! followed with a larger tolerance, and compared after a few of them: to end one at each step of the phase would take more of
//! them.
//!
//! The second solution starts with the error that the motion before has left, and so has what this motion makes of it.

use super::{Integrator, PathErrors, Steps};
use crate::control::Control;
use crate::error::Error;
use crate::scalar::{Real, Scalar};
use crate::simulate::equation::Equation;
use crate::state::{State, StateVector, split, split_mut};

/// Tolerance of the second solution over that of the first.
const LOOSER: f64 = 100.0;
/// Error over the difference of the two: a tenth, where the error follows the tolerance a hundredth.
const ADAPTIVE_SHARE: f64 = -0.1;
/// Adaptive steps of the second solution between two comparisons.
const COMPARED: f64 = 4.0;
/// Steps of the first solution to one of the second.
const STRIDE: u32 = 2;
/// The same of Runge–Kutta steps without feedback, from the longest; the last one at first, and where none is within the limits.
const FREE_STRIDES: [u32; 3] = [16, 8, 4];
/// Of these steps.
const FREE_ORDER: i32 = 4;
/// Their limits: the angle by which all joints and the base turn in a longer step at most, rad, of which the fourth power is the error of
/// the second solution; and its difference from the first, rad or m, which is to grow as a small one does.
const MOST_TURN: f64 = 0.05;
const MOST_DIFFERENCE: f64 = 1e-3;
/// Length of a step where torques are held, or where one is compared with two, over that of the first solution's.
const HALF: f64 = 0.5;
/// An error that no phase passes with, for a second solution that cannot be continued; rad, m.
const UNKNOWN: f64 = 1.0;

/// The second solution.
pub(super) struct Companion {
    steps: Box<dyn Steps>,
    x: Vec<f64>,
    /// At the end of its last step, with rates and with momenta.
    last_step: [Vec<f64>; 2],
    /// Steps over which this solution has not followed yet, s.
    pending: Option<[f64; 2]>,
    /// The number of steps that one of this solution is as long as.
    stride: u32,
    /// Whether that number follows the motion.
    is_free: bool,
    /// How many of these are pending.
    count: u32,
    /// The order of the steps; `None` where they follow from a tolerance.
    order: Option<i32>,
    /// The error over the difference of the first solution and this one.
    share: f64,
    /// Torques that the law holds for this solution, N m.
    held: Vec<f64>,
    error: f64,
    /// The first solution where this one is, or was last.
    first: Vec<f64>,
    /// The same at the end of what is pending, of adaptive steps.
    latest: Vec<f64>,
    is_lost: bool,
}

impl Companion {
    /// Of a solution that starts at `x`, over a phase of `duration`, s.
    pub(super) fn new(integrator: Integrator, duration: f64, x: &[f64], equation: &Equation<'_>) -> Self {
        let integrator = match integrator {
            Integrator::Adaptive { tolerance } => Integrator::Adaptive { tolerance: LOOSER * tolerance },
            fixed => fixed,
        };
        let steps = integrator.steps(duration, x.len(), equation.control.has_feedback());
        let order = integrator.properties().order;
        // implicit steps are long already, and steps of order 1 follow a motion less well
        let is_free = integrator == Integrator::RungeKutta4 && !equation.control.has_feedback();
        let stride = if is_free { FREE_STRIDES[2] } else { STRIDE };
        let share = match order {
            None => ADAPTIVE_SHARE,
            Some(order) if equation.control.held_steps().is_some() => share_of(HALF, order),
            Some(order) => share_of(stride.into(), order),
        };
        let (last_step, held) = ([Vec::new(), Vec::new()], vec![0.0; equation.system.model.joints()]);
        let (first, latest, mut x) = (x.to_vec(), x.to_vec(), x.to_vec());
        if let Ok(StateVector { positions, rates, .. }) = split_mut(&mut x) {
            for (half, errors) in [positions, rates].into_iter().zip(equation.system.start_error) {
                half.iter_mut().zip(errors).for_each(|(x, error)| *x -= error / share);
            }
        }
        Self {
            steps,
            x,
            last_step,
            pending: None,
            stride,
            is_free,
            count: 0,
            order,
            share,
            held,
            error: 0.0,
            first,
            latest,
            is_lost: false,
        }
    }

    /// Takes the sample of a law that holds its torques, before the first solution does.
    pub(super) fn begin_step(&mut self, equation: &mut Equation<'_>, time: f64) {
        if self.is_lost || equation.control.held_steps().is_none() {
            return;
        }
        let model = equation.system.model;
        let sample = State::from_vector(&self.x, model.joints())
            .and_then(|state| equation.control.sample_beside(time, model, &state, &mut self.held));
        if sample.is_err() {
            self.lose();
        }
    }

    /// Follows the first solution over a step, at whose end that is `x`.
    pub(super) fn follow(&mut self, equation: &mut Equation<'_>, span: [f64; 2], x: &[f64]) {
        if self.is_lost {
            return;
        }
        if is_at_limit(&equation.control) && self.order.is_some_and(|order| order > 1) {
            self.lower_order();
        }
        if self.order.is_none() && self.waits(equation, span) {
            return self.latest.copy_from_slice(x);
        }
        match self.exchanged(equation, |own, equation| own.advance(equation, span)) {
            Ok(false) => {}
            Ok(true) => {
                let difference = self.compare(x);
                if self.is_free {
                    self.choose_stride(span[1] - span[0], difference);
                }
            }
            Err(_) => self.lose(),
        }
    }

    /// Takes the error where the first solution is `x`; returns the largest difference of a position.
    fn compare(&mut self, x: &[f64]) -> f64 {
        let difference = largest_difference(x, &self.x);
        self.error = Real::maximum(self.error, self.share.abs() * difference);
        self.first.copy_from_slice(x);
        difference
    }

    /// Takes the longest steps that are within the limits, for steps of a length (s) of the first solution.
    fn choose_stride(&mut self, step: f64, difference: f64) {
        let joints = self.held.len();
        let rates = split(&self.x).map_or(&[][..], |x| x.rates);
        let turns = rates.iter().take(1).chain(rates.iter().skip(3).take(joints)).map(|rate| rate.abs()).sum::<f64>();
        let error = self.share.abs() * difference;
        let is_within = |stride: &u32| {
            let stride = f64::from(*stride);
            stride * step * turns <= MOST_TURN && error <= MOST_DIFFERENCE * share_of(stride, FREE_ORDER).abs()
        };
        let [.., shortest] = FREE_STRIDES;
        let stride = FREE_STRIDES.into_iter().find(is_within).unwrap_or(shortest);
        if stride != self.stride {
            self.stride = stride;
            self.take_share(share_of(stride.into(), FREE_ORDER));
        }
    }

    /// Takes the order as one from here on, with the same error so far.
    fn lower_order(&mut self) {
        (self.order, self.is_free) = (Some(1), false);
        self.take_share(share_of(self.stride.into(), 1));
    }

    /// Puts this solution where its difference from the first has this share in the same error.
    fn take_share(&mut self, share: f64) {
        let before = std::mem::replace(&mut self.share, share);
        self.x.iter_mut().zip(&self.first).for_each(|(x, first)| *x = first - (first - *x) * before / share);
    }

    /// The largest error of a position (rad, m), and those of the robot's positions and rates at the end; with those of the last steps
    /// that this solution has not followed, as far as they go until the phase ends at `time`.
    pub(super) fn errors(&mut self, equation: &mut Equation<'_>, time: f64) -> PathErrors {
        if self.order.is_none() && !self.is_lost {
            self.catch_up(equation);
        }
        let mut at_end = self.errors_of_robot(&self.first, self.share);
        if let Some([start, end]) = self.pending.take().filter(|_| !self.is_lost) {
            let step = (end - start) / f64::from(self.count);
            let count = (Scalar::minimum(end, time) - start) / step;
            match self.exchanged(equation, |own, equation| own.error_of_step(equation, [start, start + step])) {
                Ok((error, of_robot)) => {
                    self.error += count * error;
                    let sums = at_end.iter_mut().flatten().zip(of_robot.into_iter().flatten());
                    sums.for_each(|(sum, error)| *sum += count * error);
                }
                Err(_) => self.lose(),
            }
        }
        (self.error, at_end)
    }

    /// Follows over the adaptive steps that are pending.
    fn catch_up(&mut self, equation: &mut Equation<'_>) {
        let Some(span) = self.pending.take() else { return };
        match self.exchanged(equation, |own, equation| own.steps.advance_to_end(equation, span, &mut own.x)) {
            Ok(()) => {
                let latest = std::mem::take(&mut self.latest);
                self.compare(&latest);
            }
            Err(_) => self.lose(),
        }
    }

    /// Runs with the vectors at the end of this solution's last step.
    fn exchanged<R>(
        &mut self,
        equation: &mut Equation<'_>,
        run: impl FnOnce(&mut Self, &mut Equation<'_>) -> Result<R, Error>,
    ) -> Result<R, Error> {
        equation.exchange_last_step(&mut self.last_step);
        equation.control.exchange_held(&mut self.held);
        let result = run(self, equation);
        equation.control.exchange_held(&mut self.held);
        equation.exchange_last_step(&mut self.last_step);
        result
    }

    fn lose(&mut self) {
        (self.is_lost, self.error) = (true, Real::maximum(self.error, UNKNOWN));
    }

    /// Whether adaptive steps follow over this one later, with the next ones.
    fn waits(&mut self, equation: &Equation<'_>, [start, end]: [f64; 2]) -> bool {
        let from = self.pending.map_or(start, |[from, _]| from);
        let waits = end - from < COMPARED * self.steps.next_step() && equation.control.held_steps().is_none();
        if waits {
            self.pending = Some([from, end]);
        }
        waits
    }

    /// Advances it; returns whether it is as far as the first.
    fn advance(&mut self, equation: &mut Equation<'_>, span @ [_, end]: [f64; 2]) -> Result<bool, Error> {
        let from = self.pending.take().map_or(span[0], |[from, _]| from);
        if self.order.is_some() {
            if equation.control.held_steps().is_some() {
                return self.halves(equation, span).map(|()| true);
            }
            self.count += 1;
            if self.count < self.stride {
                self.pending = Some([from, end]);
                return Ok(false);
            }
            self.count = 0;
        }
        self.steps.advance_to_end(equation, [from, end], &mut self.x).map(|()| true)
    }

    /// Two steps of half the length.
    fn halves(&mut self, equation: &mut Equation<'_>, [start, end]: [f64; 2]) -> Result<(), Error> {
        let middle = f64::midpoint(start, end);
        self.steps.advance_to_end(equation, [start, middle], &mut self.x)?;
        self.steps.advance_to_end(equation, [middle, end], &mut self.x)
    }

    /// The errors of one step from here: the largest of a position, and those of the robot.
    fn error_of_step(&mut self, equation: &mut Equation<'_>, span: [f64; 2]) -> Result<(f64, [Vec<f64>; 2]), Error> {
        let share = share_of(HALF, self.order.unwrap_or_default());
        let mut whole = self.x.clone();
        self.steps.advance_to_end(equation, span, &mut whole)?;
        self.halves(equation, span)?;
        Ok((share * largest_difference(&whole, &self.x), self.errors_of_robot(&whole, share)))
    }

    /// A share of the differences of a vector and that of this solution, in positions and rates of the robot.
    fn errors_of_robot(&self, x: &[f64], share: f64) -> [Vec<f64>; 2] {
        let count = 3 + self.held.len();
        let [first, second] = [x, &self.x].map(|x| split(x).map_or([&[][..], &[]], |x| [x.positions, x.rates]));
        std::array::from_fn(|i| {
            let pairs = first[i].iter().zip(second[i]).take(count);
            pairs.map(|(first, second)| share * (first - second)).collect()
        })
    }
}

/// The error over the difference of a solution and one with steps of so many times the length, of an order.
fn share_of(length: f64, order: i32) -> f64 {
    -1.0 / (length.powi(order) - 1.0)
}

/// Whether a torque is at its limit, or a limit within the law acts, in the last state of a law that acts continuously: the
/// right side has kinks in time.
fn is_at_limit(law: &dyn Control<f64>) -> bool {
    let is_saturated = law.saturated().contains(&true) || law.base_torque().is_some_and(|base| base.saturated);
    (is_saturated || law.is_limited()) && law.held_steps().is_none()
}

/// Of the positions of two integrated vectors.
fn largest_difference(x: &[f64], y: &[f64]) -> f64 {
    let positions = split(x).map_or(0, |parts| parts.positions.len());
    let differences = x.iter().zip(y).take(positions).map(|(x, y)| (x - y).abs());
    differences.fold(0.0, |most: f64, difference| Real::maximum(most, difference))
}

#[cfg(test)]
mod tests;
