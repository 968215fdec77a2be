//! Integrators of ordinary differential equations with a fixed step, on slices.
//!
//! | method | order | evaluations per step | conserves |
//! |---|---|---|---|
//! | [`RungeKutta4`] | 4 | 4 | nothing; its error at 5 ms is below most others |
//! | [`SemiImplicitEuler`] | 1 | 1 | nothing in these coordinates; for fast, rough results |
//! | [`GaussLegendre`] | 6 | 3 per iteration | both momenta and symplecticity, in [canonical variables] |
//!
//! [canonical variables]: crate::formulation::CanonicalVariables

mod gauss_legendre;
mod runge_kutta4;
mod semi_implicit_euler;

pub use gauss_legendre::GaussLegendre;
pub use runge_kutta4::RungeKutta4;
pub use semi_implicit_euler::SemiImplicitEuler;
