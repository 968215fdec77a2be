//! The integrators of the core ([`planar_dynamics::integrate`]), and with the feature `std` one with adaptive steps of
//! order 9: 16 evaluations per step, and 10 for dense output; its error is the tolerance.

#[cfg(feature = "std")]
pub mod adaptive;
#[cfg(feature = "std")]
mod entries;

#[cfg(feature = "std")]
pub use adaptive::Adaptive;
pub use planar_dynamics::integrate::*;
