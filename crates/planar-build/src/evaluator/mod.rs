//! Models that evaluate a graph, without a compiler: the functions of the graph as programs on registers.
//!
//! The results have the bits of the code that is rendered from the same graph (without the feature `fused`): every
//! operation has the operands and the rounding that it has there.

mod argument;
mod batch;
mod constants;
mod dynamics;
mod execute;
mod function;
mod functions;
mod instruction;
mod lanes;
mod merge;
mod model;
mod program;
mod schedule;
mod targets;
mod values;

pub use argument::Argument;
pub use batch::{Batch, CallError};
pub use function::Function;
pub use lanes::{InstructionSet, Order};
pub use model::{Evaluator, GraphModel};
pub use planar_dynamics::status::Status;
pub(crate) use targets::by_arm;

#[cfg(test)]
mod tests;
