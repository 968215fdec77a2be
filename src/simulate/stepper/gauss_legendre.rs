//! Gauss–Legendre steps of order 6, in canonical variables.

use super::{Properties, Steps};
use crate::integrate::GaussLegendre;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties =
    Properties { name: "gauss_legendre", is_adaptive: false, is_canonical: true, order: Some(6), path_divisions: 7 };

pub(super) fn steps(length: usize) -> impl Steps {
    let mut workspace = vec![0.0; GaussLegendre::<f64>::WORKSPACE * length];
    move |equation: &mut Equation<'_>, [time, end]: [f64; 2], x: &mut [f64]| {
        let mut integrator = GaussLegendre::new(&mut workspace)?;
        equation.convert_to_momenta(x)?;
        integrator.step(time, end - time, x, |t, x, rate| equation.canonical_derivative(t, x, rate))?;
        equation.convert_to_rates(x)?;
        equation.restore(x)
    }
}
