//! Semi-implicit Euler steps; in reduced coordinates the base twist is recovered before the positions move.

use super::{Properties, Steps};
use crate::integrate::SemiImplicitEuler;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties = Properties {
    name: "semi_implicit_euler",
    is_adaptive: false,
    is_canonical: false,
    order: Some(1),
    path_divisions: 0,
};

pub(super) fn steps(length: usize) -> impl Steps {
    let mut workspace = vec![0.0; length];
    move |equation: &mut Equation<'_>, [time, end]: [f64; 2], x: &mut [f64]| {
        let step = end - time;
        let mut integrator = SemiImplicitEuler::new(&mut workspace);
        integrator.update_rates(time, step, x, |t, x, rate| equation.derivative(t, x, rate))?;
        equation.recover(x)?;
        SemiImplicitEuler::update_positions(step, x)?;
        equation.restore(x)
    }
}
