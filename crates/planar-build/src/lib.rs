//! From the expression graph of a layout to Rust or C text, and (feature `prove`) the proof of it by a generic
//! implementation.
//!
//! It never contains: a scenario, a simulation, a command line, the text of the Python package.
#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(not(test), warn(clippy::disallowed_methods, reason = "results have the same bits on every processor"))]

mod command;
mod format;
pub mod graph;
mod layouts;
pub mod pipeline;
mod renderer;
mod soundness;
mod sources;

#[cfg(feature = "prove")]
pub mod evaluator;
#[cfg(feature = "prove")]
pub mod prove;

pub use command::{command, options, quoted};
pub use layouts::{BuildError, render, render_to, verify};
pub use renderer::{Arithmetic, CModule, CText, CoSimulation, CoSimulationVariable, Module, Role};
pub use sources::sources;
