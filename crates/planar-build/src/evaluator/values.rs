//! The values of a program before they have registers: every name of a graph's statements as a number.

use crate::format::{Operand, Operation, Statement, Targets};
use std::collections::HashMap;

/// Where a constant of a program comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// The graph.
    Number(f64),
    /// The model: one of its parameters, or of what was computed from them.
    Model(usize),
}

/// A value of a program.
#[derive(Clone, Copy, Debug)]
pub(super) enum Value {
    Constant(Source),
    /// An element of the inputs, which are one after the other.
    Input(usize),
    /// Of an operation. A sine is followed by its cosine, which is a result of the same operation.
    Result {
        operation: Operation,
        a: usize,
        b: Option<usize>,
    },
    /// The cosine after a sine.
    Cosine,
}

/// The values of a program, in the order of their computation.
#[derive(Clone, Debug, Default)]
pub(super) struct Values {
    pub all: Vec<Value>,
    names: HashMap<String, usize>,
}

impl Values {
    pub fn name(&mut self, name: String, value: Value) {
        self.all.push(value);
        self.names.insert(name, self.all.len() - 1);
    }

    /// The value of an operand.
    ///
    /// # Errors
    /// A name that has none.
    pub fn operand(&mut self, operand: &Operand) -> Result<usize, String> {
        match operand {
            Operand::Name(name) => {
                self.names.get(name).copied().ok_or_else(|| format!("`{name}` is used before it is known"))
            }
            Operand::Number(number) => Ok(self.number(*number)),
        }
    }

    /// Adds a number of the program.
    pub fn number(&mut self, number: f64) -> usize {
        self.constant(Source::Number(number))
    }

    /// Adds a constant that has no name.
    pub fn constant(&mut self, source: Source) -> usize {
        self.all.push(Value::Constant(source));
        self.all.len() - 1
    }

    /// Adds the [`regularity`](planar_dynamics::validate::regularity) of masses and moments of inertia.
    pub fn regularity(&mut self, masses: &[usize]) -> usize {
        let zero = self.number(0.0);
        let sum = masses.iter().fold(zero, |sum, mass| {
            let quotient = self.result(Operation::Div, *mass, Some(*mass));
            self.result(Operation::Add, sum, Some(quotient))
        });
        self.result(Operation::Mul, sum, Some(zero))
    }

    /// Adds the result of an operation that has no name.
    pub fn result(&mut self, operation: Operation, a: usize, b: Option<usize>) -> usize {
        self.all.push(Value::Result { operation, a, b });
        self.all.len() - 1
    }

    /// Adds a value, or of an infinite one the largest number with its sign.
    pub fn saturated(&mut self, value: usize) -> usize {
        let largest = self.number(f64::MAX);
        let mut saturated = value;
        for _ in 0..2 {
            let limited = self.result(Operation::Min, saturated, Some(largest));
            saturated = self.result(Operation::Neg, limited, None);
        }
        saturated
    }

    /// Adds the values of statements.
    ///
    /// # Errors
    /// A name that is used before it is known.
    pub fn extend(&mut self, statements: &[Statement]) -> Result<(), String> {
        for Statement { targets, operation, a, b } in statements {
            let a = self.operand(a)?;
            let b = if operation.is_unary() { None } else { Some(self.operand(b)?) };
            match targets {
                Targets::Value(name) if *operation == Operation::Copy => {
                    self.names.insert(name.clone(), a);
                }
                Targets::Value(name) => self.name(name.clone(), Value::Result { operation: *operation, a, b }),
                Targets::SinCos(sine, cosine) => {
                    self.name(sine.clone(), Value::Result { operation: *operation, a, b });
                    self.name(cosine.clone(), Value::Cosine);
                }
            }
        }
        Ok(())
    }
}
