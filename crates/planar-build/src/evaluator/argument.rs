//! The inputs and outputs of functions, and the parameters of all.

use crate::format::{Parameter, Variable};

/// An input or an output of a function, or a parameter.
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

    pub(super) fn of_parameter(parameter: &Parameter) -> Self {
        let Parameter { name, unit, description, .. } = parameter;
        Self { name: name.clone(), shape: Vec::new(), unit: unit.clone(), description: description.clone() }
    }

    /// The number of its elements.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.shape.iter().product()
    }
}
