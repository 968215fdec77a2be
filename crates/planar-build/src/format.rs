//! The data of a graph as `codegen` writes it: all functions of a layout as single assignments.
//!
//! There are three stages: constants from the parameters, the configuration of a family, the call of a function. A
//! stage reads what earlier ones assign. Sections are (name, index of the first statement).

use serde::de::IntoDeserializer;
use serde::de::value::{Error, StrDeserializer};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The graph of a layout.
#[derive(Clone, Debug, Deserialize)]
pub struct Graph {
    pub(crate) casadi: String,
    pub(crate) layout: Source,
    pub(crate) inputs: Vec<Variable>,
    pub(crate) parameters: Vec<Parameter>,
    pub(crate) constants: Constants,
    pub(crate) families: Vec<Family>,
    /// Reference vectors, where the graph was proved.
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
    /// How many.
    pub links: usize,
}

/// An input, or an output with its elements, which are row-major.
#[derive(Clone, Debug, Deserialize)]
pub struct Variable {
    pub name: String,
    pub shape: Vec<usize>,
    pub unit: String,
    pub description: String,
    #[serde(default)]
    pub elements: Vec<Operand>,
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
    pub values: Vec<Constant>,
    pub operations: Operations,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Constant {
    pub name: String,
    pub unit: String,
    pub description: String,
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
    /// Those of the configuration that it depends on included.
    pub operations: Operations,
}

/// Number of operations of each kind.
#[derive(Clone, Copy, Debug, Default, Deserialize)]
#[serde(default)]
pub struct Operations {
    pub mul: u64,
    pub add: u64,
    pub sub: u64,
    pub div: u64,
    pub sin_cos: u64,
    pub neg: u64,
    pub min: u64,
    pub sqrt: u64,
    pub atan2: u64,
}

/// A single assignment: to one name, or to the two of sine and cosine.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "Vec<Value>")]
pub struct Statement {
    pub targets: Vec<String>,
    pub operation: Operation,
}

#[derive(Clone, Debug)]
pub enum Operation {
    Unary(Unary, Operand),
    Binary(Binary, [Operand; 2]),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unary {
    Copy,
    Neg,
    SinCos,
    Sqrt,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Binary {
    Add,
    Sub,
    Mul,
    Div,
    Min,
    Atan2,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(untagged)]
pub enum Operand {
    Number(f64),
    Name(String),
}

/// One state with every result of every function there, in the graph's order; lists are row-major.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct ReferenceState {
    pub inputs: Vec<Given>,
    pub expected: Vec<Expected>,
}

#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Given {
    pub name: String,
    pub values: Vec<f64>,
}

#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Expected {
    pub function: String,
    pub output: String,
    pub values: Vec<f64>,
    /// How many rounding units each value may be off.
    pub sizes: Vec<f64>,
}

impl Operation {
    pub fn operands(&self) -> &[Operand] {
        match self {
            Self::Unary(_, operand) => std::slice::from_ref(operand),
            Self::Binary(_, operands) => operands,
        }
    }
}

impl Operand {
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Number(_) => None,
            Self::Name(name) => Some(name),
        }
    }
}

/// For enums without data, which are deserialized from their names.
fn spelled(name: &str) -> StrDeserializer<'_, Error> {
    name.into_deserializer()
}

impl TryFrom<Vec<Value>> for Statement {
    type Error = String;

    fn try_from(parts: Vec<Value>) -> Result<Self, String> {
        let [target, Value::String(name), operands @ ..] = parts.as_slice() else {
            return Err(format!("{} is not a statement", Value::from(parts)));
        };
        let targets = target.as_array().map_or(std::slice::from_ref(target), Vec::as_slice).iter();
        let targets: Option<Vec<String>> = targets.map(|name| name.as_str().map(str::to_owned)).collect();
        let operands: Result<Vec<Operand>, _> = operands.iter().map(Operand::deserialize).collect();
        let unary = Unary::deserialize(spelled(name)).ok();
        let binary = Binary::deserialize(spelled(name)).ok();
        let operation = match (operands.as_deref(), unary, binary) {
            (Ok([a]), Some(operation), _) => Some(Operation::Unary(operation, a.clone())),
            (Ok([a, b]), _, Some(operation)) => Some(Operation::Binary(operation, [a.clone(), b.clone()])),
            _ => None,
        };
        let results = if unary == Some(Unary::SinCos) { 2 } else { 1 };
        match (targets, operation) {
            (Some(targets), Some(operation)) if targets.len() == results => Ok(Self { targets, operation }),
            _ => Err(format!("operation `{name}` is unknown in the form {}", Value::from(parts.clone()))),
        }
    }
}
