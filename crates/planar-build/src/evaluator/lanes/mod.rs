//! Functions of many instances at once: each instruction of a program for a block of them, in the widest vectors of the
//! processor that the program runs on.

#![allow(clippy::inline_always, reason = "what is not inlined has the instruction set of the build")]

mod call;
mod dispatch;
mod execute;
mod matrix;

pub(super) use call::{Call, Constants};
pub use dispatch::InstructionSet;
#[cfg(test)]
pub(super) use execute::{Lanes, execute};
pub use matrix::Order;
pub(super) use matrix::{Matrix, MatrixMut};
