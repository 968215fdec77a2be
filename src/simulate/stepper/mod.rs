//! One step of a phase, by any scheme and in any coordinates.

use crate::control::Control;
use crate::error::Error;
use crate::integrate::semi_implicit_euler::drift;
use crate::integrate::{Adaptive, GaussLegendre, RungeKutta4, SemiImplicitEuler};
use crate::scenario::{Coordinates, Integration, Scheme};
use crate::simulate::equation::Equation;
use crate::simulate::system::System;

/// Carries the integrated vector from one instant to another.
pub(crate) struct Flow<'a> {
    equation: Equation<'a>,
    stepper: Stepper,
    workspace: Vec<f64>,
    /// When the phase ends, s.
    duration: f64,
}

/// A scheme, with what it remembers.
enum Stepper {
    RungeKutta4,
    SemiImplicitEuler,
    GaussLegendre,
    Adaptive {
        tolerance: f64,
        solver: Adaptive,
        /// Until when the torques are held, and with them the solver may go on, s; `None` before it is started.
        until: Option<f64>,
    },
}

impl<'a> Flow<'a> {
    /// For a phase that starts at `x`.
    ///
    /// # Errors
    /// [`Error::Beside`] for reduced coordinates where there are bodies beside the robot, and what the model says.
    pub(crate) fn new(
        system: &'a System<'a>,
        integration: &Integration,
        duration: f64,
        x: &[f64],
    ) -> Result<Self, Error> {
        let equation = match (integration.coordinates, integration.scheme) {
            (Coordinates::Reduced, _) => Equation::reduced(system, x)?,
            (Coordinates::Full, Scheme::GaussLegendre) => Equation::canonical(system, x)?,
            (Coordinates::Full, _) => Equation::full(system),
        };
        let (stepper, vectors) = match integration.scheme {
            Scheme::RungeKutta4 => (Stepper::RungeKutta4, 3),
            Scheme::SemiImplicitEuler => (Stepper::SemiImplicitEuler, 1),
            Scheme::GaussLegendre => (Stepper::GaussLegendre, GaussLegendre::<f64>::WORKSPACE),
            Scheme::Adaptive { tolerance } => {
                (Stepper::Adaptive { tolerance, solver: Adaptive::new(tolerance), until: None }, 0)
            }
        };
        Ok(Self { equation, stepper, workspace: vec![0.0; vectors * x.len()], duration })
    }

    /// Carries `x` on from `time` to `end`, the next step.
    ///
    /// # Errors
    /// What model, law and integrator say.
    pub(crate) fn advance(
        &mut self,
        control: &mut dyn Control<f64>,
        [time, end]: [f64; 2],
        x: &mut [f64],
    ) -> Result<(), Error> {
        let Self { equation, stepper: Stepper::Adaptive { solver, until, .. }, duration, .. } = self else {
            return self.fixed(control, [time, end], x);
        };
        // times are multiples of the step, rounded: half a step tells them apart
        let half = 0.5 * (end - time);
        if until.is_none_or(|until| until < time + half) {
            let held = control.held_steps().map_or(*duration, |steps| time + f64::from(steps) * (end - time));
            let next = if held > *duration - half { *duration } else { held.max(end) };
            *until = Some(next);
            solver.start(time, next, x, &mut |t, x, rate| equation.derivative(control, t, x, rate))?;
        }
        let system = equation.system();
        let mut restore = |x: &mut [f64]| {
            let before = x.to_vec();
            system.restore(x).map(|()| before != x)
        };
        solver.advance(end, x, &mut |t, x, rate| equation.derivative(control, t, x, rate), &mut restore)?;
        self.equation.restore(x)
    }

    /// The vector at `time` within a step that starts at `start` with `x`, into `into`; what the solver remembers is left
    /// alone.
    ///
    /// # Errors
    /// As [`Self::advance`].
    pub(crate) fn within(
        &mut self,
        control: &mut dyn Control<f64>,
        [start, time]: [f64; 2],
        x: &[f64],
        into: &mut Vec<f64>,
    ) -> Result<(), Error> {
        into.clear();
        into.extend_from_slice(x);
        if time <= start {
            return Ok(());
        }
        let Self { equation, stepper: Stepper::Adaptive { tolerance, .. }, .. } = self else {
            return self.fixed(control, [start, time], into);
        };
        let mut solver = Adaptive::new(*tolerance).try_first(time - start);
        let mut derivative = |t: f64, x: &[f64], rate: &mut [f64]| equation.derivative(control, t, x, rate);
        solver.start(start, time, x, &mut derivative)?;
        solver.advance(time, into, &mut derivative, &mut |_| Ok(false))?;
        self.equation.restore(into)
    }

    /// d/dt of `x`, whatever is integrated.
    ///
    /// # Errors
    /// What model and law say.
    pub(crate) fn rate(
        &mut self,
        control: &mut dyn Control<f64>,
        time: f64,
        x: &[f64],
        rate: &mut [f64],
    ) -> Result<(), Error> {
        self.equation.derivative(control, time, x, rate)
    }

    /// One step of a scheme that takes the steps that it is given.
    fn fixed(&mut self, control: &mut dyn Control<f64>, [time, end]: [f64; 2], x: &mut [f64]) -> Result<(), Error> {
        let (equation, step) = (&mut self.equation, end - time);
        let wrong = Error::Length { quantity: "state vector", expected: x.len(), found: self.workspace.len() };
        match &self.stepper {
            Stepper::SemiImplicitEuler => {
                let mut euler = SemiImplicitEuler::new(&mut self.workspace);
                euler.kick(time, step, x, |t, x, rate| equation.derivative(control, t, x, rate))?;
                equation.recover(x)?;
                drift(step, x);
            }
            Stepper::GaussLegendre => {
                let mut gauss = GaussLegendre::new(&mut self.workspace).ok_or(wrong)?;
                equation.put_momenta(x)?;
                gauss.step(time, step, x, |t, x, rate| equation.canonical_derivative(control, t, x, rate))?;
                equation.put_rates(x)?;
            }
            Stepper::RungeKutta4 | Stepper::Adaptive { .. } => {
                let mut runge_kutta = RungeKutta4::new(&mut self.workspace).ok_or(wrong)?;
                runge_kutta.step(time, step, x, |t, x, rate| equation.derivative(control, t, x, rate))?;
            }
        }
        equation.restore(x)
    }
}
