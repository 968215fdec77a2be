//! Adaptive steps, with dense output within each and where a step of the phase ends.

use super::{Properties, Steps};
use crate::error::Error;
use crate::integrate::{Adaptive, Motion};
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties =
    Properties { name: "adaptive", is_adaptive: true, is_canonical: false, order: None, path_divisions: 10 };

/// Most steps of a phase of few steps of its own, which take minutes. Stiff laws need more, as an explicit integrator's
/// steps are no longer than their shortest time constants.
const MOST_STEPS: f64 = 1e6;
/// Most in each of the phase's own steps, where these are more.
const MOST_IN_ONE: f64 = 10.0;
/// Steps after which those to come are counted by the mean of these. A law that was stiff for so many does not cease to
/// be: the steps of order 9 follow a transient in some ten of them.
const COUNTED: u64 = 20_000;

pub(super) struct AdaptiveSteps {
    solver: Adaptive,
    /// When the phase ends, s.
    duration: f64,
    /// Until when the torques are held, and with them the solver may go on, s; `None` before it is started.
    until: Option<f64>,
    /// Number of steps and time at the last count.
    counted: (u64, f64),
}

impl AdaptiveSteps {
    pub(super) fn new(tolerance: f64, duration: f64, has_feedback: bool) -> Self {
        let solver = if has_feedback { Adaptive::with_feedback(tolerance) } else { Adaptive::new(tolerance) };
        Self { solver, duration, until: None, counted: (0, 0.0) }
    }

    /// Refuses a phase that would have too many steps; `time` is within one of its own of this length, s.
    fn count(&mut self, time: f64, length: f64) -> Result<(), Error> {
        let (attempts, (before, start)) = (self.solver.attempts(), self.counted);
        if attempts - before < COUNTED {
            return Ok(());
        }
        self.counted = (attempts, time);
        #[allow(clippy::cast_precision_loss, reason = "there are not so many")]
        let [all, last] = [attempts, attempts - before].map(|steps| steps as f64);
        let step = (time - start) / last;
        let needed = all + (self.duration - time) / step;
        let most = MOST_STEPS.max(MOST_IN_ONE * self.duration / length);
        // a mean of zero makes infinitely many
        if needed <= most { Ok(()) } else { Err(Error::Steps { step, needed, most }) }
    }
}

impl Motion for Equation<'_> {
    fn derivative(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        Equation::derivative(self, time, x, rate)
    }

    fn restore(&mut self, x: &mut [f64]) -> Result<bool, Error> {
        if self.system.constraints.is_empty() {
            return Ok(false);
        }
        let before = x.to_vec();
        self.system.restore(x).map(|()| before != x)
    }
}

impl Steps for AdaptiveSteps {
    fn advance(&mut self, equation: &mut Equation<'_>, span: [f64; 2], from: f64, x: &mut [f64]) -> Result<f64, Error> {
        let Self { solver, duration, until, .. } = self;
        let [time, end] = span;
        // times are multiples of the step, rounded: half a step tells them apart
        let half = 0.5 * (end - time);
        if from <= time && until.is_none_or(|until| until < time + half) {
            let held =
                equation.control.law.held_steps().map_or(*duration, |steps| time + f64::from(steps) * (end - time));
            let next = if held > *duration - half { *duration } else { held.max(end) };
            *until = Some(next);
            solver.start(time, next, x, equation)?;
        }
        let reached = solver.advance([from, end], x, equation)?;
        self.count(reached, end - time)?;
        equation.restore(x).map(|()| reached)
    }

    fn next_step(&self) -> f64 {
        self.solver.next_step()
    }

    fn fourth_derivative(&self) -> f64 {
        self.solver.fourth_derivative()
    }

    fn within(&mut self, equation: &mut Equation<'_>, [_, time]: [f64; 2], x: &mut [f64]) -> Result<(), Error> {
        self.solver.interpolate(time, x, equation)?;
        equation.restore(x)
    }
}

#[cfg(test)]
mod tests;
