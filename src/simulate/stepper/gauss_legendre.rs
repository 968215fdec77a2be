//! Gauss–Legendre steps of order 6, in canonical variables.

use super::{Method, Properties};
use crate::control::Control;
use crate::error::Error;
use crate::integrate::GaussLegendre;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties = Properties { name: "gauss_legendre", is_adaptive: false, is_canonical: true };

pub(super) struct Steps {
    workspace: Vec<f64>,
}

impl Steps {
    pub(super) fn new(length: usize) -> Self {
        Self { workspace: vec![0.0; GaussLegendre::<f64>::WORKSPACE * length] }
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
        let mut integrator = GaussLegendre::new(&mut self.workspace)?;
        equation.convert_to_momenta(x)?;
        integrator.step(time, end - time, x, |t, x, rate| equation.canonical_derivative(control, t, x, rate))?;
        equation.convert_to_rates(x)?;
        equation.restore(x)
    }
}
