//! Interprets a graph: computes what the rendered code will compute, without compiling it.

use crate::evaluator::impact_equations;
use crate::format::{Function, FunctionResult, Given, Graph, Operand, Operation, ReferenceState, Statement, Variable};
use crate::prove::perturbed::Perturbed;
use planar_dynamics::scalar::Scalar;
use std::collections::HashMap;

/// Where a graph is computed: the elements of each input, row-major, and the values of the parameters, in its order.
#[derive(Clone, Copy)]
pub struct Arguments<'a> {
    pub inputs: &'a [Given],
    pub parameters: &'a [f64],
}

impl<'a> Arguments<'a> {
    /// Those of a reference state.
    pub fn of(state: &'a ReferenceState) -> Self {
        Self { inputs: &state.inputs, parameters: &state.parameters }
    }
}

/// Every result of every function, in the graph's order.
///
/// # Errors
/// A name that is used before it has a value, or an input that is missing: which.
pub fn interpret(graph: &Graph, arguments: Arguments<'_>) -> Result<Vec<FunctionResult>, String> {
    interpret_some(graph, arguments, &|_, _, value: f64| value, &|_| true)
}

/// As [`interpret`], in single precision.
///
/// # Errors
/// As [`interpret`].
pub fn interpret_in_single_precision(graph: &Graph, arguments: Arguments<'_>) -> Result<Vec<FunctionResult>, String> {
    let found = interpret_some(graph, arguments, &|_, _, value| f32::constant(value), &|_| true)?;
    Ok(in_double(found, f64::from))
}

/// As [`interpret`], with numbers that are off, in each run otherwise.
///
/// # Errors
/// As [`interpret`].
pub fn interpret_perturbed(graph: &Graph, arguments: Arguments<'_>, run: u64) -> Result<Vec<FunctionResult>, String> {
    let found = interpret_some(graph, arguments, &|_, _, value| Perturbed::new(value, run), &|_| true)?;
    Ok(in_double(found, |number| number.value))
}

fn in_double<T>(found: Vec<FunctionResult<T>>, value: fn(T) -> f64) -> Vec<FunctionResult> {
    let double = |FunctionResult { function, output, values, sizes }| {
        let values = values.into_iter().map(value).collect();
        FunctionResult { function, output, values, sizes }
    };
    found.into_iter().map(double).collect()
}

/// The results of the functions that rendered code computes in loops, as it does: from their matrices.
///
/// # Errors
/// As [`interpret`].
pub fn interpret_loops(graph: &Graph, arguments: Arguments<'_>) -> Result<Vec<FunctionResult>, String> {
    let scalar = |_: &str, _: usize, value: f64| value;
    let matrices = results(graph, arguments, &scalar, &Function::is_in_loops, |function| &function.matrices)?;
    let functions = graph.functions().filter(|function| function.is_in_loops());
    let mut found = Vec::new();
    for (function, [inertia, jacobian]) in functions.zip(matrices.as_chunks().0) {
        let mut given = [&inertia.values[..], &jacobian.values].concat();
        for input in graph.inputs_of_call(function) {
            given.extend(
                arguments.inputs.iter().filter(|given| given.name == input.name).flat_map(|given| &given.values),
            );
        }
        let mut values = impact_equations(function, &given).into_iter();
        found.extend(function.outputs.iter().map(|output| FunctionResult {
            function: function.name.clone(),
            output: output.name.clone(),
            values: values.by_ref().take(output.elements.len()).collect(),
            sizes: Vec::new(),
        }));
    }
    Ok(found)
}

/// The parameters, as an input of [`interpret_some`].
const PARAMETERS: &str = "parameters";

/// As [`interpret`], for the functions that are wanted and in any scalar: `scalar` makes one of an input's name, the index
/// of an element, and its value.
///
/// # Errors
/// As [`interpret`].
pub fn interpret_some<T: Scalar>(
    graph: &Graph,
    arguments: Arguments<'_>,
    scalar: &dyn Fn(&str, usize, f64) -> T,
    is_wanted: &dyn Fn(&Function) -> bool,
) -> Result<Vec<FunctionResult<T>>, String> {
    results(graph, arguments, scalar, is_wanted, |function| &function.outputs)
}

/// As [`interpret_some`], for the outputs of each function or its matrices.
fn results<T: Scalar>(
    graph: &Graph,
    Arguments { inputs, parameters: values }: Arguments<'_>,
    scalar: &dyn Fn(&str, usize, f64) -> T,
    is_wanted: &dyn Fn(&Function) -> bool,
    of_function: fn(&Function) -> &[Variable],
) -> Result<Vec<FunctionResult<T>>, String> {
    let mut known = Known { before: None, own: HashMap::new() };
    for input in &graph.inputs {
        let name = &input.name;
        let given =
            inputs.iter().find(|given| given.name == *name).ok_or_else(|| format!("input `{name}` has no value"))?;
        let elements = given.values.iter().enumerate();
        known.own.extend(elements.map(|(i, value)| (input.element(i), scalar(name, i, *value))));
    }
    let parameters = graph.parameters.iter().zip(values).enumerate();
    known.own.extend(parameters.map(|(i, (p, value))| (p.name.clone(), scalar(PARAMETERS, i, *value))));
    known.run(&graph.constants.statements)?;
    let mut found = Vec::new();
    for family in graph.families.iter().filter(|family| family.functions.iter().any(is_wanted)) {
        let mut configuration = known.next_stage();
        configuration.run(&family.configuration.statements)?;
        for function in family.functions.iter().filter(|function| is_wanted(function)) {
            let mut call = configuration.next_stage();
            call.run(&function.statements)?;
            for output in of_function(function) {
                let values = output.elements.iter().map(|element| call.get(element)).collect::<Result<_, _>>()?;
                let (function, output) = (function.name.clone(), output.name.clone());
                found.push(FunctionResult { function, output, values, sizes: Vec::new() });
            }
        }
    }
    Ok(found)
}

/// Names that have a value, in a stage and in those before it.
struct Known<'a, T> {
    before: Option<&'a Known<'a, T>>,
    own: HashMap<String, T>,
}

impl<T: Scalar> Known<'_, T> {
    fn next_stage(&self) -> Known<'_, T> {
        Known { before: Some(self), own: HashMap::new() }
    }

    fn find(&self, name: &str) -> Option<T> {
        self.own.get(name).copied().or_else(|| self.before?.find(name))
    }

    fn get(&self, operand: &Operand) -> Result<T, String> {
        match operand {
            Operand::Number(number) => Ok(T::constant(*number)),
            Operand::Name(name) => self.find(name).ok_or_else(|| format!("`{name}` is used before it is known")),
        }
    }

    fn run(&mut self, statements: &[Statement]) -> Result<(), String> {
        for statement in statements {
            let (a, b) = (self.get(&statement.a)?, self.get(&statement.b)?);
            let values = match statement.operation {
                Operation::Copy => vec![a],
                Operation::Neg => vec![-a],
                Operation::SinCos => <[T; 2]>::from(a.sin_cos()).into(),
                Operation::Sqrt => vec![a.sqrt()],
                Operation::Add => vec![a + b],
                Operation::Sub => vec![a - b],
                Operation::Mul => vec![a * b],
                Operation::Div => vec![a / b],
                Operation::Min => vec![a.minimum(b)],
                Operation::Atan2 => vec![a.atan2(b)],
            };
            let names = statement.targets.names().into_iter().map(str::to_owned);
            self.own.extend(names.zip(values));
        }
        Ok(())
    }
}
