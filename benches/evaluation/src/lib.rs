//! What is measured of the paper's robot: evaluations by generated code, by CasADi's C and by the generic implementation, for any
//! clock.

/// Any error.
pub type Problem = Box<dyn std::error::Error>;

#[cfg(feature = "measure")]
mod batch;
#[cfg(feature = "measure")]
mod casadi;
#[cfg(feature = "measure")]
pub mod clock;
#[cfg(feature = "measure")]
mod derivatives;
#[cfg(feature = "measure")]
pub mod input;
#[cfg(feature = "measure")]
mod limit;
#[cfg(feature = "measure")]
pub mod measure;
#[cfg(feature = "measure")]
mod runge_kutta;
#[cfg(feature = "measure")]
mod states;
#[cfg(feature = "measure")]
mod studies;
