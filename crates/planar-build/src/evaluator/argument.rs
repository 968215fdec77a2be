//! The inputs and outputs of functions.

use crate::format::Variable;

/// An input or an output of a function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Argument {
    /// As in the graph.
    pub name: String,
    /// Number of elements along each axis; none for a scalar.
    pub shape: Vec<usize>,
    /// SI unit; of its elements one after the other where they differ.
    pub unit: String,
    /// What it is.
    pub description: String,
}

impl Argument {
    pub(super) fn new(variable: &Variable) -> Self {
        let Variable { name, shape, unit, description, .. } = variable;
        Self { name: name.clone(), shape: shape.clone(), unit: unit.clone(), description: description.clone() }
    }

    /// The number of its elements.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.shape.iter().product()
    }
}
