//! Integrators of ordinary differential equations with a fixed step, on slices.
//!
//! | method | order | evaluations per step | conserves |
//! |---|---|---|---|
//! | [`RungeKutta4`] | 4 | 4 | nothing; its error at 5 ms is below most others |
//! | [`SemiImplicitEuler`] | 1 | 1 | nothing in these coordinates; for fast, rough results |
//! | [`GaussLegendre`] | 6 | 3 per iteration | both momenta and symplecticity, in [canonical variables] |
//!
//! [canonical variables]: crate::formulation::CanonicalVariables
//!
//! # Example
//! ```
//! use planar_dynamics::integrate::GaussLegendre;
//!
//! // 1 kg on a spring of 1 N/m, [x, v], from x = 1 m for 100 s
//! let (mut x, mut workspace) = ([1.0_f64, 0.0], [0.0; 5 * 2]);
//! let mut integrator = GaussLegendre::new(&mut workspace)?;
//! for step in 0..1000 {
//!     integrator.step(0.1 * f64::from(step), 0.1, &mut x, |_, x, rate| {
//!         rate.copy_from_slice(&[x[1], -x[0]]);
//!         Ok(())
//!     })?;
//! }
//! assert!((x[0] - 100.0_f64.cos()).abs() < 1e-8);
//! // the energy, which is quadratic in x, is that of the start to rounding
//! assert!((x[0] * x[0] + x[1] * x[1] - 1.0).abs() < 1e-13);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

mod gauss_legendre;
mod runge_kutta4;
mod semi_implicit_euler;
#[doc(hidden)]
pub mod step_at_once;

pub use gauss_legendre::GaussLegendre;
pub use runge_kutta4::RungeKutta4;
pub use semi_implicit_euler::SemiImplicitEuler;
