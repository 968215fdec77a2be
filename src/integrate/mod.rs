//! The integrators of the core ([`planar_dynamics::integrate`]), and one with adaptive steps.

#[cfg(feature = "std")]
pub mod adaptive;

#[cfg(feature = "std")]
pub use adaptive::Adaptive;
pub use planar_dynamics::integrate::*;
