//! The integrators of the core ([`planar_dynamics::integrate`]), and with the feature `std` one with adaptive steps of
//! order 9: 16 evaluations per step, and 9 where dense output is asked for; its error is the tolerance. Under feedback it takes
//! steps of order 8 with 12 evaluations, which are stable for longer.
//!
//! # Example
//! ```
//! use planar_capture::integrate::GaussLegendre;
//!
//! let mut workspace = [0.0; 2 * GaussLegendre::<f64>::WORKSPACE];
//! let mut integrator = GaussLegendre::new(&mut workspace)?;
//! let mut x = [1.0, 0.0]; // m and m/s of an oscillator of 1 rad/s
//! for i in 0..1000 {
//!     integrator.step(0.1 * f64::from(i), 0.1, &mut x, |_, x, rate| {
//!         rate.copy_from_slice(&[x[1], -x[0]]);
//!         Ok(())
//!     })?;
//! }
//! // it conserves quadratic invariants, of which the energy is one
//! assert!((x[0] * x[0] + x[1] * x[1] - 1.0).abs() < 1e-12);
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

#[cfg(feature = "std")]
mod adaptive;
#[cfg(feature = "std")]
mod blocks;
#[cfg(feature = "std")]
mod continuation;
#[cfg(feature = "std")]
mod lagrange;
#[cfg(feature = "std")]
mod motion;
#[cfg(feature = "std")]
mod pair;

#[cfg(feature = "std")]
pub use adaptive::Adaptive;
#[cfg(feature = "std")]
pub use motion::Motion;
pub use planar_dynamics::integrate::*;
