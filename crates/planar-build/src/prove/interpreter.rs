//! Interprets a graph in `f64`: computes what the rendered code will compute, without compiling it.

use crate::format::{FunctionResult, Given, Graph, Operand, Operation, Statement};
use planar_dynamics::scalar::Scalar;
use std::collections::HashMap;

/// Every result of every function, in the graph's order, with the layout's own numbers; `inputs` holds the elements of
/// each input, row-major.
///
/// # Errors
/// A name that is used before it has a value, or an input that is missing: which.
pub fn interpret(graph: &Graph, inputs: &[Given]) -> Result<Vec<FunctionResult>, String> {
    let mut known = Known::default();
    for input in &graph.inputs {
        let name = &input.name;
        let given =
            inputs.iter().find(|given| given.name == *name).ok_or_else(|| format!("input `{name}` has no value"))?;
        let columns = input.shape.get(1).copied();
        for (i, value) in given.values.iter().enumerate() {
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
                let (function, output) = (function.name.clone(), output.name.clone());
                found.push(FunctionResult { function, output, values, sizes: Vec::new() });
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
        for statement in statements {
            let (a, b) = (self.get(&statement.a)?, self.get(&statement.b)?);
            let values = match statement.operation {
                Operation::Copy => vec![a],
                Operation::Neg => vec![-a],
                Operation::SinCos => <[f64; 2]>::from(Scalar::sin_cos(a)).into(),
                Operation::Sqrt => vec![Scalar::sqrt(a)],
                Operation::Add => vec![a + b],
                Operation::Sub => vec![a - b],
                Operation::Mul => vec![a * b],
                Operation::Div => vec![a / b],
                Operation::Min => vec![Scalar::minimum(a, b)],
                Operation::Atan2 => vec![Scalar::atan2(a, b)],
            };
            let names = statement.targets.names().into_iter().map(str::to_owned);
            self.own.extend(names.zip(values));
        }
        Ok(())
    }
}
