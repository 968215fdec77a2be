//! Verner's pair of orders 9 and 8 with adaptive steps, by the crate `differential-equations`, which only this folder
//! uses.

use super::entries::Entries;
use crate::error::Error;
use differential_equations::error::Error as SolverError;
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::{Adaptive as Steps, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use std::cell::{Cell, RefCell};
use std::fmt;

/// f of ẋ = f(t, x), into its last argument.
pub type Derivative<'a> = dyn FnMut(f64, &[f64], &mut [f64]) -> Result<(), Error> + 'a;

/// 16 stages, 26 with those of the interpolant.
type Solver = ExplicitRungeKutta<Ordinary, Steps, f64, Entries, 9, 16, 26>;

/// ẋ = f(t, x) by Verner's "most efficient" pair 9(8) with an interpolant of order 9 (`rkv989e`).
///
/// Steps are as long as the error estimate allows, `|error| ≤ tolerance (1 + |x|)` per step for every entry of x, and
/// continue beyond the requested times, at which x comes from the interpolant. Each accepted step takes 26 evaluations,
/// each rejected one 15. Of the crate's methods this one has an interpolant as accurate as its steps.
pub struct Adaptive {
    /// Some 12 kB of tables.
    solver: Box<Solver>,
    tolerance: f64,
    /// f may change after this time, s.
    end: f64,
    /// Next step, s, before it is shortened to end at `end`.
    next_step: f64,
    /// Steps taken or rejected so far.
    attempts: u64,
}

impl fmt::Debug for Adaptive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Adaptive").field("tolerance", &self.tolerance).field("end", &self.end).finish_non_exhaustive()
    }
}

impl Adaptive {
    /// Smallest tolerance: rounding errors are larger than a smaller one.
    pub const SMALLEST_TOLERANCE: f64 = 1e-14;

    /// With this tolerance, relative and absolute; to be [started](Self::start).
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        let solver = Solver::rkv989e().rtol(tolerance).atol(tolerance).max_steps(usize::MAX);
        Self { solver: Box::new(solver), tolerance, end: 0.0, next_step: 0.0, attempts: 0 }
    }

    /// Starts at `x`; f holds until `end`. Where it was started before, the last step's length is tried first.
    ///
    /// # Errors
    /// Those of `derivative`.
    pub fn start(&mut self, time: f64, end: f64, x: &[f64], derivative: &mut Derivative<'_>) -> Result<(), Error> {
        let least = f64::EPSILON * time.abs().max(end.abs()).max(f64::MIN_POSITIVE);
        self.end = end.max(time + 4.0 * least);
        self.solver.h0 = self.next_step.min(self.end - time); // 0: the solver estimates one
        let problem = Problem::new(derivative);
        let result = self.solver.init(&problem, time, self.end, &Entries(x.to_vec()));
        self.next_step = self.solver.h();
        problem.result(result).map_err(|why| why.unwrap_or(self.stuck()))
    }

    /// Steps until x is known at a time after `from`, for which the last step was taken: at `time`, or at the end of a
    /// step before it. Writes x to `into` and returns its time. `time` is no later than the end.
    ///
    /// Before a step `restore` may change the x that it starts from, and says whether it did.
    ///
    /// # Errors
    /// [`Error::Tolerance`] where steps become too short, and those of `derivative` and `restore`.
    pub fn advance(
        &mut self,
        [from, time]: [f64; 2],
        into: &mut [f64],
        derivative: &mut Derivative<'_>,
        restore: &mut dyn FnMut(&mut [f64]) -> Result<bool, Error>,
    ) -> Result<f64, Error> {
        // `end` may be a sum of steps, rounded to before the requested time
        let wanted = time.min(self.end);
        let rounding = 4.0 * f64::EPSILON * self.end.abs();
        if wanted > self.solver.t() + rounding && from + rounding >= self.solver.t() {
            let mut x = self.solver.y().0.clone();
            if restore(&mut x)? {
                self.start(self.solver.t(), self.end, &x, derivative)?;
            }
            self.step(derivative)?;
        }
        let now = self.solver.t();
        let reached = if wanted > now + rounding { now } else { time };
        self.interpolate(reached, into).map(|()| reached)
    }

    /// x at a time within the last step.
    ///
    /// # Errors
    /// None that its steps have not had.
    pub fn interpolate(&mut self, time: f64, into: &mut [f64]) -> Result<(), Error> {
        let (before, now) = (self.solver.t_prev(), self.solver.t());
        if time >= now || before >= now {
            into.copy_from_slice(&self.solver.y().0);
            return Ok(());
        }
        let x = self.solver.interpolate(time.max(before)).map_err(|_| self.stuck())?;
        into.copy_from_slice(&x.0);
        Ok(())
    }

    /// The number of steps taken or rejected so far.
    #[must_use]
    pub fn attempts(&self) -> u64 {
        self.attempts
    }

    /// One accepted step.
    fn step(&mut self, derivative: &mut Derivative<'_>) -> Result<(), Error> {
        let start = self.solver.t();
        loop {
            let left = self.end - start;
            let cut = self.solver.h() > left;
            if cut {
                self.next_step = self.solver.h();
                self.solver.set_h(left);
            }
            let problem = Problem::new(derivative);
            self.attempts += 1;
            let result = self.solver.step(&problem);
            problem.result(result).map_err(|why| why.unwrap_or(self.stuck()))?;
            if self.solver.t() > start {
                self.next_step = if cut { self.next_step.max(self.solver.h()) } else { self.solver.h() };
                return Ok(());
            }
            if start + self.solver.h() <= start {
                return Err(self.stuck());
            }
        }
    }

    fn stuck(&self) -> Error {
        Error::Tolerance { tolerance: self.tolerance, step: self.solver.h() }
    }
}

/// f in the crate's form, which cannot return errors: the first error is kept.
struct Problem<'a, 'd> {
    derivative: RefCell<&'a mut Derivative<'d>>,
    failure: Cell<Option<Error>>,
}

impl<'a, 'd> Problem<'a, 'd> {
    fn new(derivative: &'a mut Derivative<'d>) -> Self {
        Self { derivative: RefCell::new(derivative), failure: Cell::new(None) }
    }

    /// The error of f, or `None` as the error of the solver.
    fn result<X>(self, result: Result<X, SolverError<f64, Entries>>) -> Result<(), Option<Error>> {
        match (self.failure.get(), result) {
            (Some(failure), _) => Err(Some(failure)),
            (None, Err(_)) => Err(None),
            (None, Ok(_)) => Ok(()),
        }
    }
}

impl ODE<f64, Entries> for Problem<'_, '_> {
    fn diff(&self, time: f64, Entries(x): &Entries, Entries(rate): &mut Entries) {
        if self.failure.get().is_some() {
            return rate.fill(0.0);
        }
        if let Err(failure) = (*self.derivative.borrow_mut())(time, x, rate) {
            self.failure.set(Some(failure));
            rate.fill(0.0);
        }
    }
}
