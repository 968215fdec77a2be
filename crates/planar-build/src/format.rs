//! The data of a graph as `codegen` writes it: all functions of a layout as single assignments.
//!
//! There are three stages: constants from the parameters, the configuration of a family, the call of a function. A
//! stage reads what earlier ones assign. Sections are (name, index of the first statement).

use serde::de::Visitor;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::HashMap;
use std::fmt;

/// Number of operations of each kind.
pub type Operations = HashMap<String, u64>;

/// The graph of a layout.
#[derive(Clone, Debug, Deserialize)]
pub struct Graph {
    pub(crate) casadi: String,
    /// Of the command that derives it again, besides layout and file.
    #[serde(default)]
    pub(crate) options: Vec<String>,
    pub(crate) layout: Source,
    pub(crate) inputs: Vec<Variable>,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) constants: Constants,
    pub(crate) families: Vec<Family>,
    /// Reference vectors of a proved graph.
    pub(crate) self_test: Option<Vec<ReferenceState>>,
}

/// The layout that a graph was derived from.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Source {
    pub name: String,
    pub sha256: String,
    pub arms: Vec<Arm>,
    pub needs_distinct_mounts: bool,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Arm {
    pub name: String,
    pub links: usize,
}

/// An input, a constant, or an output with its elements, which are row-major.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Variable {
    pub name: String,
    #[serde(default)]
    pub shape: Vec<usize>,
    pub unit: String,
    pub description: String,
    #[serde(default, skip_serializing)]
    pub elements: Vec<Operand>,
    #[serde(default, skip_serializing)]
    pub derivative: Option<Derivative>,
}

/// What an output is the derivative of: outputs of a function, one after the other.
///
/// Its columns are the elements of the inputs `by`; with `along` in their place it is the derivative along the
/// direction in each of these inputs, or `parameters`; with neither it is a value of the outputs itself.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Derivative {
    pub function: String,
    pub outputs: Vec<String>,
    pub by: Vec<String>,
    pub along: Vec<String>,
}

/// A run-time number of the model, of the base, an arm or a link.
#[derive(Clone, Debug, Deserialize)]
pub struct Parameter {
    pub name: String,
    pub quantity: String,
    pub arm: Option<usize>,
    pub link: Option<usize>,
    pub unit: String,
    pub default: f64,
    pub description: String,
}

/// The stage of the parameters; `values` are the constants that later stages read.
#[derive(Clone, Debug, Deserialize)]
pub struct Constants {
    pub statements: Vec<Statement>,
    pub values: Vec<Variable>,
    pub operations: Operations,
}

/// Functions that share the stage of the configuration.
#[derive(Clone, Debug, Deserialize)]
pub struct Family {
    pub name: String,
    pub description: String,
    pub configuration: Configuration,
    pub functions: Vec<Function>,
}

/// The stage of the configuration; `values` are those that the calls read.
#[derive(Clone, Debug, Deserialize)]
pub struct Configuration {
    pub sections: Vec<(String, usize)>,
    pub statements: Vec<Statement>,
    pub values: Vec<String>,
    pub operations: Operations,
}

/// The stage of a call.
#[derive(Clone, Debug, Deserialize)]
pub struct Function {
    pub name: String,
    pub description: String,
    pub equation: String,
    pub source: String,
    pub inputs: Vec<String>,
    pub sections: Vec<(String, usize)>,
    pub statements: Vec<Statement>,
    pub outputs: Vec<Variable>,
    /// Generalized inertia and Jacobian where rendered code computes the outputs from these, in loops.
    #[serde(default)]
    pub matrices: Vec<Variable>,
    /// Those of the configuration that it depends on included.
    pub operations: Operations,
}

/// A single assignment, written as a list.
#[derive(Clone, Debug, Deserialize)]
pub struct Statement {
    pub targets: Targets,
    pub operation: Operation,
    pub a: Operand,
    /// Not a number where the operation has one operand.
    #[serde(default = "Operand::none")]
    pub b: Operand,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Targets {
    Value(String),
    SinCos(String, String),
}

#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Hash)]
#[serde(rename_all = "snake_case")]
pub enum Operation {
    Copy,
    Neg,
    SinCos,
    Sqrt,
    Add,
    Sub,
    Mul,
    Div,
    Min,
    Atan2,
}

#[derive(Clone, Debug)]
pub enum Operand {
    Number(f64),
    Name(String),
}

/// Reads an operand at once: of the ten thousands of a graph, an untagged one would be tried as each of its kinds.
impl<'de> Deserialize<'de> for Operand {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(OperandVisitor)
    }
}

struct OperandVisitor;

impl Visitor<'_> for OperandVisitor {
    type Value = Operand;

    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("a number or the name of a variable")
    }

    fn visit_f64<E>(self, number: f64) -> Result<Operand, E> {
        Ok(Operand::Number(number))
    }

    #[allow(clippy::cast_precision_loss, reason = "as a number with a point is read")]
    fn visit_u64<E>(self, number: u64) -> Result<Operand, E> {
        Ok(Operand::Number(number as f64))
    }

    #[allow(clippy::cast_precision_loss, reason = "as a number with a point is read")]
    fn visit_i64<E>(self, number: i64) -> Result<Operand, E> {
        Ok(Operand::Number(number as f64))
    }

    fn visit_str<E>(self, name: &str) -> Result<Operand, E> {
        Ok(Operand::Name(name.to_owned()))
    }
}

/// One state of a robot with every result of every function there, in the graph's order; lists are row-major.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ReferenceState {
    /// Of the robot, which need not be the layout's: one number for each parameter of the graph.
    pub parameters: Vec<f64>,
    pub inputs: Vec<Given>,
    pub expected: Vec<FunctionResult>,
    /// A result that there is not in single precision, in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub double_alone: Option<String>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Given {
    pub name: String,
    pub values: Vec<f64>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct FunctionResult<T = f64> {
    pub function: String,
    pub output: String,
    pub values: Vec<T>,
    /// The allowed error of each value in rounding units; empty for results of the graph itself.
    pub sizes: Vec<f64>,
}

impl Graph {
    /// The masses and moments of inertia among the parameters, which are above 0: the mass matrix then is positive definite
    /// in every configuration.
    pub(crate) fn masses(&self) -> impl Iterator<Item = &Parameter> {
        let is_mass = |quantity: &str| quantity.ends_with("_mass") || quantity.ends_with("_inertia");
        self.parameters.iter().filter(move |parameter| is_mass(&parameter.quantity))
    }

    /// The functions of all families.
    pub(crate) fn functions(&self) -> impl Iterator<Item = &Function> + Clone {
        self.families.iter().flat_map(|family| &family.functions)
    }

    /// The same, each with its family.
    pub(crate) fn functions_of_families(&self) -> impl Iterator<Item = (&Family, &Function)> {
        self.families.iter().flat_map(|family| family.functions.iter().map(move |function| (family, function)))
    }

    /// What a function takes besides the configuration, in its order.
    pub(crate) fn inputs_of_call<'a>(&'a self, function: &'a Function) -> impl Iterator<Item = &'a Variable> {
        let names = function.inputs.iter().filter(|name| !["base_pose", "joint_angles"].contains(&name.as_str()));
        names.filter_map(|name| self.inputs.iter().find(|input| input.name == *name))
    }
}

/// The output that says how near to singular the system of a function is.
pub const PIVOT: &str = "smallest_pivot";

impl Function {
    /// What says how near to singular its system is, where it solves one.
    pub fn pivot(&self) -> Option<&Operand> {
        self.outputs.iter().find(|output| output.name == PIVOT)?.elements.first()
    }

    /// Whether it has an output that says so.
    pub fn has_pivot(&self) -> bool {
        self.pivot().is_some()
    }

    /// Whether rendered code computes it in loops, from its matrices.
    pub fn is_in_loops(&self) -> bool {
        !self.matrices.is_empty()
    }

    /// What rendered code takes from its statements.
    pub fn roots(&self) -> &[Variable] {
        if self.is_in_loops() { &self.matrices } else { &self.outputs }
    }
}

impl Variable {
    /// Whether an element, row-major, is an angle, by its unit.
    pub fn is_angle(&self, index: usize) -> bool {
        let units: Vec<&str> = self.unit.split(", ").collect();
        units[index % units.len()] == "rad"
    }

    /// The name of an element, row-major, in statements: `joint_angles[1]`, `contacts[0][1]`.
    pub fn element(&self, index: usize) -> String {
        match self.shape.get(1) {
            None => format!("{}[{index}]", self.name),
            Some(columns) => format!("{}[{}][{}]", self.name, index / columns, index % columns),
        }
    }
}

/// The section of a statement, by the indices of the sections' first ones.
pub fn section_at(sections: &[(String, usize)], index: usize) -> &str {
    let begun = sections.partition_point(|(_, start)| *start <= index);
    begun.checked_sub(1).map_or("", |last| sections[last].0.as_str())
}

impl Statement {
    /// The names that it reads.
    pub fn reads(&self) -> impl Iterator<Item = &str> + Clone {
        [&self.a, &self.b].into_iter().filter_map(Operand::name)
    }
}

impl Operation {
    /// Whether its operands can be exchanged, with the same bits.
    pub fn is_commutative(self) -> bool {
        matches!(self, Self::Add | Self::Mul)
    }

    /// Whether it has one operand.
    pub fn is_unary(self) -> bool {
        matches!(self, Self::Copy | Self::Neg | Self::SinCos | Self::Sqrt)
    }
}

impl Targets {
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::Value(name) => vec![name],
            Self::SinCos(sine, cosine) => vec![sine, cosine],
        }
    }
}

impl Operand {
    fn none() -> Self {
        Self::Number(f64::NAN)
    }

    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Number(_) => None,
            Self::Name(name) => Some(name),
        }
    }
}
