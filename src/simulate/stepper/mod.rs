//! Steps of a phase by any integrator in any coordinates.
//!
//! # Example
//! ```
//! use planar_capture::control::ZeroTorque;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::stepper::{Integration, Integrator};
//! use planar_capture::simulate::{Timing, event::NoEvents, simulate, system::System};
//!
//! let robot = Model::<f64>::default();
//! let (joint_angles, joint_rates) = (vec![0.3, -1.2, 0.7], vec![0.5, -0.8, 0.4]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let drift = |integrator: Integrator| {
//!     let integration = Integration { integrator, ..Integration::default() };
//!     let timing = Timing { duration: 5.0, step: 0.1, sample: 1.0, integration, kink: None };
//!     let system = System::alone(&robot);
//!     simulate(&system, &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || ()).map(|phase| phase.drift)
//! };
//! // in canonical variables the momentum is conserved whatever the step, else by small steps alone
//! assert!(drift(Integrator::GaussLegendre)?.momentum_drift < 1e-13);
//! assert!(drift(Integrator::SemiImplicitEuler)?.momentum_drift > 1e-6);
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

mod adaptive;
mod companion;
mod gauss_legendre;
mod runge_kutta4;
mod semi_implicit_euler;

use crate::control::Control;
use crate::error::Error;
use crate::scalar::Real;
use crate::simulate::Timing;
use crate::simulate::equation::{Equation, FormulationWorkspace};
use crate::simulate::inertial_frame::InertialFrame;
use crate::simulate::moving_frame::MovingFrame;
use crate::simulate::system::System;
use crate::state::State;
use companion::Companion;

/// The largest error of a position (rad, m), and those of the robot's positions and rates at the end.
pub(crate) type PathErrors = (f64, [Vec<f64>; 2]);

/// By which integrator, in which coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Integration {
    /// The integrator.
    pub integrator: Integrator,
    /// What is integrated.
    pub coordinates: Formulation,
}

/// What is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Formulation {
    /// Base and joints.
    #[default]
    Full,
    /// The joints and the base pose; the base twist follows from the momentum.
    Reduced,
}

/// Name and abilities of an integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// As scenarios have it.
    pub name: &'static str,
    /// Whether its steps follow from a tolerance.
    pub is_adaptive: bool,
    /// Whether it integrates canonical variables, and only those.
    pub is_canonical: bool,
    /// The order of its steps; `None` where they follow from a tolerance.
    pub order: Option<i32>,
    /// Most bisections of a step until cubics are the path within it; 0 where they are as exact as its steps.
    pub path_divisions: u32,
}

/// An integrator. Each has a file of its own with its properties and steps; this file lists them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Integrator {
    /// Classical Runge–Kutta steps of order 4.
    #[default]
    RungeKutta4,
    /// Rates, then positions by the new rates: order 1.
    SemiImplicitEuler,
    /// Gauss–Legendre steps of order 6 in canonical variables: symplectic, conserves both momenta.
    GaussLegendre,
    /// Adaptive steps by Verner's pair of orders 9 and 8, under a control law also by Dormand and Prince's formula of order 8.
    Adaptive {
        /// Relative and absolute, of each step.
        tolerance: f64,
    },
}

impl Integrator {
    /// The default tolerance: the error of the paper's approach is then less than 1e-10 in every position and rate (SI).
    pub const DEFAULT_TOLERANCE: f64 = 1e-10;

    /// All integrators.
    pub const ALL: &'static [Self] = &[
        Self::RungeKutta4,
        Self::SemiImplicitEuler,
        Self::GaussLegendre,
        Self::Adaptive { tolerance: Self::DEFAULT_TOLERANCE },
    ];

    /// Its properties.
    #[must_use]
    pub const fn properties(self) -> Properties {
        match self {
            Self::RungeKutta4 => runge_kutta4::PROPERTIES,
            Self::SemiImplicitEuler => semi_implicit_euler::PROPERTIES,
            Self::GaussLegendre => gauss_legendre::PROPERTIES,
            Self::Adaptive { .. } => adaptive::PROPERTIES,
        }
    }

    /// Its steps, for a phase of `duration` (s) and vectors of `length`, under a law with feedback or without.
    fn steps(self, duration: f64, length: usize, has_feedback: bool) -> Box<dyn Steps> {
        match self {
            Self::RungeKutta4 => Box::new(runge_kutta4::steps(length)),
            Self::SemiImplicitEuler => Box::new(semi_implicit_euler::steps(length)),
            Self::GaussLegendre => Box::new(gauss_legendre::steps(length)),
            Self::Adaptive { tolerance } => Box::new(adaptive::AdaptiveSteps::new(tolerance, duration, has_feedback)),
        }
    }
}

/// The integrated vector at a time within a part of a step, into the last argument.
pub(crate) type StateAt<'a> = dyn FnMut(f64, &mut Vec<f64>) -> Result<(), Error> + 'a;

/// The steps of one integrator, with its data between them.
trait Steps {
    /// Advances `x` over a part of the next step, `span` (from, to; s), of which it has come to `from`; returns where
    /// the part ends.
    fn advance(&mut self, equation: &mut Equation<'_>, span: [f64; 2], from: f64, x: &mut [f64]) -> Result<f64, Error>;

    /// Advances `x` from the start of the last part to a time within it, without changing the data for the next one.
    fn within(&mut self, equation: &mut Equation<'_>, span: [f64; 2], x: &mut [f64]) -> Result<(), Error>;

    /// The length of the next step where it follows from a tolerance, s; 0 before it is known.
    fn next_step(&self) -> f64 {
        0.0
    }

    /// A bound of the fourth derivative of every entry over the last part, in its unit per s⁴; infinite where none is known.
    fn fourth_derivative(&self) -> f64 {
        f64::INFINITY
    }

    /// Advances `x` over the whole step.
    fn advance_to_end(
        &mut self,
        equation: &mut Equation<'_>,
        [start, end]: [f64; 2],
        x: &mut [f64],
    ) -> Result<(), Error> {
        let mut time = start;
        while time < end {
            let until = equation.smooth_until([time, end]);
            time = self.advance(equation, [start, until], time, x)?;
        }
        Ok(())
    }
}

/// An integrator whose steps are independent is the function that advances `x`.
impl<F: FnMut(&mut Equation<'_>, [f64; 2], &mut [f64]) -> Result<(), Error>> Steps for F {
    fn advance(&mut self, equation: &mut Equation<'_>, span: [f64; 2], from: f64, x: &mut [f64]) -> Result<f64, Error> {
        self(equation, [from, span[1]], x).map(|()| span[1])
    }

    fn within(&mut self, equation: &mut Equation<'_>, span: [f64; 2], x: &mut [f64]) -> Result<(), Error> {
        self(equation, span, x)
    }
}

/// Advances the integrated vector of a phase.
pub(crate) struct Stepper<'a> {
    equation: Equation<'a>,
    steps: Box<dyn Steps>,
    companion: Companion,
    /// At the end of a part of a step, with rates and with momenta.
    last_part: [Vec<f64>; 2],
    /// What is integrated in.
    frame: MovingFrame,
    /// The vector in that frame at the start of the last part of a step.
    start: Vec<f64>,
    /// The same at the end of the part, where it is not that of the inertial frame.
    end: Vec<f64>,
}

impl<'a> Stepper<'a> {
    /// For a phase that starts at `x`.
    pub(crate) fn new(
        system: &'a System<'a>,
        control: &'a mut dyn Control<f64>,
        timing: &Timing,
        x: &[f64],
    ) -> Result<Self, Error> {
        let Timing { duration, integration, .. } = *timing;
        let frame = MovingFrame::of(system, x, duration)?;
        let mut moving = x.to_vec();
        frame.enter(0.0, &mut moving)?;
        if frame.is_moving() {
            // far away the poses that begin constraints are rounded
            system.restore(&mut moving)?;
        }
        let form = match (integration.coordinates, integration.integrator.properties().is_canonical) {
            (Formulation::Reduced, _) => FormulationWorkspace::reduced(system, &moving)?,
            (Formulation::Full, true) => FormulationWorkspace::canonical(system, &moving)?,
            (Formulation::Full, false) => FormulationWorkspace::Full,
        };
        let law = InertialFrame { law: control, origin: frame.origin, velocity: frame.velocity };
        let kink = timing.kink.filter(|_| !integration.integrator.properties().is_adaptive);
        let equation = Equation::new(system, law, kink, form);
        let steps = integration.integrator.steps(duration, x.len(), equation.control.has_feedback());
        let companion = Companion::new(integration.integrator, duration, &moving, &equation);
        let last_part = [Vec::new(), Vec::new()];
        Ok(Self { equation, steps, companion, last_part, frame, start: moving.clone(), end: moving })
    }

    /// Begins a step of the control law at `x`, before its torques are evaluated.
    pub(crate) fn begin_step(&mut self, time: f64, x: &[f64]) -> Result<(), Error> {
        self.companion.begin_step(&mut self.equation, time);
        let Equation { system, control, .. } = &mut self.equation;
        control.law.begin_step(time, system.model, &State::from_vector(x, system.model.joints())?)
    }

    /// The control law.
    pub(crate) fn control(&mut self) -> &mut dyn Control<f64> {
        self.equation.control.law
    }

    /// Advances `x` over a part of the next step, of which it has come to `from`; returns where the part ends: within it
    /// [`within`](Self::within) has the motion.
    pub(crate) fn advance(&mut self, span: [f64; 2], from: f64, x: &mut [f64]) -> Result<f64, Error> {
        let Self { equation, steps, companion, frame, start, end, .. } = self;
        let moving = if frame.is_moving() { &mut end[..] } else { &mut *x };
        start.copy_from_slice(moving);
        let until = equation.smooth_until([from, span[1]]);
        let reached = steps.advance(equation, [span[0], until], from, moving)?;
        if reached >= span[1] {
            companion.follow(equation, span, moving);
        }
        if frame.is_moving() {
            x.copy_from_slice(end);
            frame.leave(reached, x)?;
        }
        Ok(reached)
    }

    /// A bound of the fourth derivative of every entry of `x` over the last part, in its unit per s⁴; infinite where none is known,
    /// as where states are moved onto constraints.
    pub(crate) fn fourth_derivative(&self) -> f64 {
        if self.equation.system.constraints.is_empty() { self.steps.fourth_derivative() } else { f64::INFINITY }
    }

    /// The estimated errors of a phase that ends at `time`.
    pub(crate) fn path_errors(&mut self, time: f64) -> PathErrors {
        let (error, at_end) = self.companion.errors(&mut self.equation, time);
        (Real::maximum(error, self.frame.rounding(time)), at_end)
    }

    /// The vector where the last part of a step ends, in the frame that is integrated in; in the inertial frame it is `x`.
    pub(crate) fn moving<'s>(&'s self, x: &'s [f64]) -> &'s [f64] {
        if self.frame.is_moving() { &self.end } else { x }
    }

    /// A vector in the frame that is integrated in.
    pub(crate) fn moved(&self, time: f64, x: &[f64]) -> Result<Vec<f64>, Error> {
        let mut moving = x.to_vec();
        self.frame.enter(time, &mut moving)?;
        Ok(moving)
    }

    /// The vector at `time` within the last part of a step, which starts at `start`, into `into`.
    pub(crate) fn within(&mut self, span @ [start, time]: [f64; 2], into: &mut Vec<f64>) -> Result<(), Error> {
        self.moving_within(span, into)?;
        self.frame.leave(time.max(start), into)
    }

    /// Ends the last part of a step within it, at `time`, with the vector there in `x`.
    pub(crate) fn end_at(&mut self, span @ [_, time]: [f64; 2], x: &mut Vec<f64>) -> Result<(), Error> {
        self.moving_within(span, x)?;
        self.end.clone_from(x);
        self.frame.leave(time, x)
    }

    fn moving_within(&mut self, [start, time]: [f64; 2], into: &mut Vec<f64>) -> Result<(), Error> {
        into.clone_from(&self.start);
        if time <= start {
            return Ok(());
        }
        self.equation.exchange_last_step(&mut self.last_part);
        let found = self.steps.within(&mut self.equation, [start, time], into);
        self.equation.exchange_last_step(&mut self.last_part);
        found
    }

    /// d/dt of `x`.
    pub(crate) fn rate(&mut self, time: f64, x: &[f64], rate: &mut [f64]) -> Result<(), Error> {
        let moving = self.moved(time, x)?;
        self.equation.derivative(time, &moving, rate)?;
        self.frame.leave_rate(rate)
    }
}

#[cfg(test)]
mod tests;
