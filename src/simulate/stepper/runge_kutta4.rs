//! Runge–Kutta steps of order 4.

use super::{Properties, Steps};
use crate::integrate::RungeKutta4;
use crate::simulate::equation::Equation;

pub(super) const PROPERTIES: Properties =
    Properties { name: "rk4", is_adaptive: false, is_canonical: false, order: Some(4), path_divisions: 4 };

pub(super) fn steps(length: usize) -> impl Steps {
    let mut workspace = vec![0.0; RungeKutta4::<f64>::WORKSPACE * length];
    move |equation: &mut Equation<'_>, [time, end]: [f64; 2], x: &mut [f64]| {
        let mut integrator = RungeKutta4::new(&mut workspace)?;
        equation.runge_kutta4_step(&mut integrator, [time, end], x)?;
        equation.restore(x)
    }
}
