//! Models that evaluate a graph, without a compiler: the functions of the graph as programs on registers.
//!
//! The results have the bits of the code that is rendered from the same graph (without the feature `fused`): every
//! operation has the operands and the rounding that it has there.

mod dynamics;
mod execute;
mod function;
mod functions;
mod instruction;
mod merge;
mod model;
mod program;
mod targets;
mod values;

pub use model::{Evaluator, GraphModel};
pub(crate) use targets::by_arm;

#[cfg(test)]
mod tests;
