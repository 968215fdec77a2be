//! The native part of the Python package `planar_capture`: what is computed. Shapes, names and documents are in Python.
//!
//! Arrays come and go flat, with the elements of an instance one after the other.

#![allow(
    clippy::needless_pass_by_value,
    reason = "a function of Python's is given what was made for it: the values of its arguments"
)]

mod call;
mod capture;
mod chunks;
mod control;
mod derivation;
mod failure;
mod instance;
mod robot;
mod scenario;
mod study;
mod sweep;

use pyo3::prelude::pymodule;

/// The native part of `planar_capture`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::derivation::derive;
    #[pymodule_export]
    use super::robot::Robot;
    #[pymodule_export]
    use super::scenario::Scenario;
    #[pymodule_export]
    use super::study::Study;
    #[pymodule_export]
    use super::sweep::{sweep, sweep_plan, sweep_report, sweep_statuses};
    use planar_capture::registry::SHIPPED;
    use pyo3::prelude::pyfunction;

    /// The version of the program.
    #[pymodule_export]
    const VERSION: &str = env!("CARGO_PKG_VERSION");

    /// The names of the shipped layouts.
    #[pyfunction]
    fn layouts() -> Vec<&'static str> {
        SHIPPED.iter().map(|(name, _)| *name).collect()
    }
}
