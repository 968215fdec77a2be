//! A graph computed in `f64` as it stands, without being compiled: what the rendered code will say.

use crate::format::{Binary, Graph, Operand, Operation, Statement, Unary};
use planar_dynamics::scalar::Scalar;
use std::collections::HashMap;

/// One result of one function.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The function.
    pub function: String,
    /// Which of its results.
    pub output: String,
    /// Row-major.
    pub values: Vec<f64>,
}

/// Every result of every function, in the graph's order, with the layout's own numbers; `inputs` holds the elements of
/// each input, row-major, by the input's name.
///
/// # Errors
/// A name that is used before it has a value, or an input that is missing: which.
pub fn interpret(graph: &Graph, inputs: &[(&str, Vec<f64>)]) -> Result<Vec<Found>, String> {
    let mut known = Known::default();
    for input in &graph.inputs {
        let name = &input.name;
        let (_, values) =
            inputs.iter().find(|(given, _)| given == name).ok_or(format!("input `{name}` has no value"))?;
        let columns = input.shape.get(1).copied();
        for (i, value) in values.iter().enumerate() {
            let place = columns.map_or_else(|| format!("[{i}]"), |n| format!("[{}][{}]", i / n, i % n));
            known.own.insert(format!("{name}{place}"), *value);
        }
    }
    known.own.extend(graph.parameters.iter().map(|parameter| (parameter.name.clone(), parameter.default)));
    known.run(&graph.constants.statements)?;
    let mut found = Vec::new();
    for family in &graph.families {
        let mut configuration = known.next_stage();
        configuration.run(&family.configuration.statements)?;
        for function in &family.functions {
            let mut call = configuration.next_stage();
            call.run(&function.statements)?;
            for output in &function.outputs {
                let values = output.elements.iter().map(|element| call.get(element)).collect::<Result<_, _>>()?;
                found.push(Found { function: function.name.clone(), output: output.name.clone(), values });
            }
        }
    }
    Ok(found)
}

/// Names that have a value, in a stage and in those before it.
#[derive(Default)]
struct Known<'a> {
    before: Option<&'a Known<'a>>,
    own: HashMap<String, f64>,
}

impl Known<'_> {
    fn next_stage(&self) -> Known<'_> {
        Known { before: Some(self), own: HashMap::new() }
    }

    fn find(&self, name: &str) -> Option<f64> {
        self.own.get(name).copied().or_else(|| self.before?.find(name))
    }

    fn get(&self, operand: &Operand) -> Result<f64, String> {
        match operand {
            Operand::Number(number) => Ok(*number),
            Operand::Name(name) => self.find(name).ok_or_else(|| format!("`{name}` is used before it is known")),
        }
    }

    fn run(&mut self, statements: &[Statement]) -> Result<(), String> {
        for Statement { targets, operation } in statements {
            let values = match operation {
                Operation::Unary(operation, a) => {
                    let a = self.get(a)?;
                    match operation {
                        Unary::Copy => vec![a],
                        Unary::Neg => vec![-a],
                        Unary::Sqrt => vec![Scalar::sqrt(a)],
                        Unary::SinCos => <[f64; 2]>::from(Scalar::sin_cos(a)).into(),
                    }
                }
                Operation::Binary(operation, [a, b]) => {
                    let (a, b) = (self.get(a)?, self.get(b)?);
                    vec![match operation {
                        Binary::Add => a + b,
                        Binary::Sub => a - b,
                        Binary::Mul => a * b,
                        Binary::Div => a / b,
                        Binary::Min => Scalar::minimum(a, b),
                        Binary::Atan2 => Scalar::atan2(a, b),
                    }]
                }
            };
            self.own.extend(targets.iter().cloned().zip(values));
        }
        Ok(())
    }
}
