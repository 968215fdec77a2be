//! Models that evaluate a graph, without a compiler: the functions of the graph as programs on registers.
//!
//! The results have the bits of the code that is rendered from the same graph (without the feature `fused`): every
//! operation has the operands and the rounding that it has there.
//!
//! # Example
//! ```
//! use planar_build::evaluator::Evaluator;
//! use planar_build::graph;
//! use planar_dynamics::dynamics::{EquationsOfMotion, Robot};
//! use planar_layout::layout::Layout;
//! use std::sync::Arc;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let text = std::fs::read_to_string(format!("{folder}/graphs/dual_arm_3r.json"))?;
//! let evaluator = Arc::new(Evaluator::new(&graph::read(&text, &layout)?)?);
//! let robot = evaluator.model(&layout).expect("the graph's own layout");
//! let mut mass_matrix = [0.0; 9 * 9];
//! robot.mass_matrix(&[0.0; 3], &[0.5; 6], &mut mass_matrix)?;
//! // against a translation there is the mass of all bodies: a base of 500 kg, six links of 10 kg
//! assert_eq!((robot.joints(), mass_matrix[9 + 1]), (6, 560.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod argument;
mod batch;
mod constants;
mod dynamics;
mod execute;
mod function;
mod functions;
mod impact_equations;
mod instruction;
mod lanes;
mod merge;
mod model;
mod program;
mod recorded;
mod schedule;
mod targets;
mod values;

pub use argument::Argument;
pub use batch::{Batch, CallError};
pub use function::Function;
pub(crate) use impact_equations::impact_equations;
pub use lanes::{InstructionSet, Order};
pub use model::{Evaluator, GraphModel};
pub use planar_dynamics::status::Status;
pub(crate) use targets::by_arm;

#[cfg(test)]
mod tests;
