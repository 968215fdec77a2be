//! Integrators of ordinary differential equations, on slices.

pub mod rk4;

pub use rk4::RungeKutta4;
