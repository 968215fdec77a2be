//! Integrators of ordinary differential equations, on slices.
//!
//! | scheme | order | evaluations per step | keeps |
//! |---|---|---|---|
//! | [`RungeKutta4`] | 4 | 4 | nothing; its error at 5 ms is below most others |
//! | [`SemiImplicitEuler`] | 1 | 1 | nothing in these coordinates: for quick looks |
//! | [`GaussLegendre`] | 6 | 3 per round of iteration | both momenta and symplecticity, on [canonical] variables |
//! | `Adaptive` (feature `std`) | 9 | 16, and 10 for dense output | nothing; its error is the tolerance |
//!
//! [canonical]: crate::formulation::Canonical

pub mod gauss_legendre;
pub mod runge_kutta4;
pub mod semi_implicit_euler;

pub use gauss_legendre::GaussLegendre;
pub use runge_kutta4::RungeKutta4;
pub use semi_implicit_euler::SemiImplicitEuler;
