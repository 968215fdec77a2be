//! Runge–Kutta steps of order 4.

use super::{Method, Properties};
use crate::control::Control;
use crate::error::Error;
use crate::integrate::RungeKutta4;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties = Properties { name: "rk4", is_adaptive: false, is_canonical: false };

pub(super) struct Steps {
    workspace: Vec<f64>,
}

impl Steps {
    pub(super) fn new(length: usize) -> Self {
        Self { workspace: vec![0.0; RungeKutta4::<f64>::WORKSPACE * length] }
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
        let mut integrator = RungeKutta4::new(&mut self.workspace)?;
        integrator.step(time, end - time, x, |t, x, rate| equation.derivative(control, t, x, rate))?;
        equation.restore(x)
    }
}
