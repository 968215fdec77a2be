//! The integrators of the core ([`planar_dynamics::integrate`]), and with the feature `std` one with adaptive steps of
//! order 9: 16 evaluations per step, and 9 where dense output is asked for; its error is the tolerance.

#[cfg(feature = "std")]
mod adaptive;
#[cfg(feature = "std")]
mod continuation;
#[cfg(feature = "std")]
mod motion;
#[cfg(feature = "std")]
mod pair;

#[cfg(feature = "std")]
pub use adaptive::Adaptive;
#[cfg(feature = "std")]
pub use motion::Motion;
pub use planar_dynamics::integrate::*;
