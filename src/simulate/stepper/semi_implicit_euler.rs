//! Semi-implicit Euler steps; in reduced coordinates the base twist is recovered before the positions move.

use super::{Method, Properties};
use crate::control::Control;
use crate::error::Error;
use crate::integrate::SemiImplicitEuler;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties =
    Properties { name: "semi_implicit_euler", is_adaptive: false, is_canonical: false };

pub(super) struct Steps {
    workspace: Vec<f64>,
}

impl Steps {
    pub(super) fn new(length: usize) -> Self {
        Self { workspace: vec![0.0; length] }
    }
}

impl Method for Steps {
    fn advance(
        &mut self,
        equation: &mut Equation<'_>,
        control: &mut dyn Control<f64>,
        [time, end]: [f64; 2],
        x: &mut [f64],
    ) -> Result<(), Error> {
        let step = end - time;
        let mut integrator = SemiImplicitEuler::new(&mut self.workspace);
        integrator.update_rates(time, step, x, |t, x, rate| equation.derivative(control, t, x, rate))?;
        equation.recover(x)?;
        SemiImplicitEuler::update_positions(step, x)?;
        equation.restore(x)
    }
}
