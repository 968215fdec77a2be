//! A robot whose dynamics are those of a graph.

use super::execute::{Registers, execute, registers};
use super::functions::Functions;
use super::instruction::Register;
use super::program::Program;
use super::values::{Source, Value, Values};
use crate::format::{Constants, Family, Graph, Operand, Variable};
use crate::graph::{self, GraphError};
use planar_layout::layout::Layout;
use planar_layout::structure::{Mismatch, Structure, parameters};
use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

/// The programs of a graph, for every layout of its structure.
#[derive(Clone, Debug)]
pub struct Evaluator {
    name: String,
    structure: Structure,
    /// From the parameters to all that later programs read besides them.
    constants: Program,
    pub(super) functions: Functions,
}

/// The program of a function.
#[derive(Clone, Debug)]
pub(super) struct Function {
    /// Position of the function among those of the evaluator, and of its constants in a model.
    index: usize,
    program: Program,
    /// The elements of each output.
    outputs: Vec<Range<usize>>,
}

/// A robot with its numbers.
#[derive(Clone, Debug)]
pub struct GraphModel {
    evaluator: Arc<Evaluator>,
    parameters: Vec<f64>,
    /// What is in the first registers of each function.
    constants: Vec<Vec<f64>>,
}

thread_local! {
    static REGISTERS: RefCell<Box<Registers<f64>>> = RefCell::new(registers());
}

impl Evaluator {
    /// The programs of all functions that a model has.
    ///
    /// # Errors
    /// [`GraphError::Format`]: a function that is missing or has other inputs or outputs, or is too large.
    pub fn new(graph: &Graph) -> Result<Self, GraphError> {
        let structure = graph::structure(graph)?;
        let Constants { statements, values: constants, .. } = &graph.constants;
        let mut values = Values::default();
        for (index, parameter) in graph.parameters.iter().enumerate() {
            values.name(parameter.name.clone(), Value::Input(index));
        }
        let program = values.extend(statements).and_then(|()| {
            let named = |constant: &Variable| Operand::Name(constant.name.clone());
            let outputs =
                constants.iter().map(|constant| values.operand(&named(constant))).collect::<Result<Vec<_>, _>>();
            Program::new(&values, graph.parameters.len(), &outputs?)
        });
        let constants = program.map_err(GraphError::Format)?;
        let mut compiled = 0;
        let functions = Functions::new(&structure, &mut |name, inputs, outputs| {
            let index = compiled;
            compiled += 1;
            Function::new(graph, (name, index), inputs, outputs)
                .map_err(|e| GraphError::Format(format!("`{name}`: {e}")))
        })?;
        Ok(Self { name: graph.layout.name.clone(), structure, constants, functions })
    }

    /// The name of the layout that the graph was derived from.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The structure of the layouts that it has models of.
    #[must_use]
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// The model of a layout, with its numbers.
    ///
    /// # Errors
    /// [`Mismatch`] where the layout's structure is another.
    pub fn model(self: &Arc<Self>, layout: &Layout) -> Result<GraphModel, Mismatch> {
        let parameters = parameters(&self.structure, layout)?;
        Ok(GraphModel::new(Arc::clone(self), parameters))
    }
}

impl GraphModel {
    fn new(evaluator: Arc<Evaluator>, parameters: Vec<f64>) -> Self {
        let mut model = Self { evaluator, parameters, constants: Vec::new() };
        model.set_constants();
        model
    }

    pub(super) fn evaluator(&self) -> &Evaluator {
        &self.evaluator
    }

    pub(super) fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The same robot with other numbers.
    pub(super) fn set_parameters(&mut self, parameters: Vec<f64>) {
        self.parameters = parameters;
        self.set_constants();
    }

    fn set_constants(&mut self) {
        let Evaluator { constants: program, functions, .. } = &*self.evaluator;
        let numbers = |program: &Program, model: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let number = |source: &Source| match source {
                Source::Number(number) => *number,
                Source::Model(index) => model(*index),
            };
            program.constants.iter().map(number).collect()
        };
        let literals = numbers(program, &|_| f64::NAN);
        let from_parameters = run(program, &literals, &[&self.parameters], |registers| {
            program.outputs.iter().map(|register| registers[usize::from(*register)]).collect::<Vec<f64>>()
        });
        let all = [&self.parameters[..], &from_parameters].concat();
        self.constants = functions.all().map(|function| numbers(&function.program, &|index| all[index])).collect();
    }

    /// Calls a function; `read` takes what it wants of the results.
    pub(super) fn call<R>(&self, function: &Function, inputs: &[&[f64]], read: impl FnOnce(&Results<'_>) -> R) -> R {
        run(&function.program, &self.constants[function.index], inputs, |registers| {
            read(&Results { function, registers })
        })
    }
}

/// Executes a program in the registers of the thread.
fn run<R>(program: &Program, constants: &[f64], inputs: &[&[f64]], read: impl FnOnce(&Registers<f64>) -> R) -> R {
    REGISTERS.with_borrow_mut(|registers| {
        let mut rest = &mut registers[..];
        for part in std::iter::once(&constants).chain(inputs) {
            let (place, after) = rest.split_at_mut(part.len());
            place.copy_from_slice(part);
            rest = after;
        }
        execute(&program.instructions, registers);
        read(registers)
    })
}

/// The results of a call, in the registers.
pub(super) struct Results<'a> {
    function: &'a Function,
    registers: &'a Registers<f64>,
}

impl Results<'_> {
    /// The elements of an output, by its position.
    pub fn elements(&self, output: usize) -> impl Iterator<Item = f64> {
        let registers: &[Register] = &self.function.program.outputs[self.function.outputs[output].clone()];
        registers.iter().map(|register| self.registers[usize::from(*register)])
    }

    /// An output of one element.
    pub fn scalar(&self, output: usize) -> f64 {
        self.elements(output).next().unwrap_or(f64::NAN)
    }
}

impl Function {
    fn new(
        graph: &Graph,
        (name, index): (&str, usize),
        inputs: &[&str],
        outputs: &[(&str, usize)],
    ) -> Result<Self, String> {
        let functions = |family: &Family| family.functions.iter().position(|function| function.name == name);
        let found = graph.families.iter().find_map(|family| Some((family, &family.functions[functions(family)?])));
        let (family, function) = found.ok_or("it is missing")?;
        if function.inputs != inputs {
            return Err(format!("it has the inputs {}, expected {}", function.inputs.join(", "), inputs.join(", ")));
        }
        let found: Vec<_> =
            function.outputs.iter().map(|output| (output.name.as_str(), output.elements.len())).collect();
        if found != outputs {
            return Err(format!("it has the outputs {found:?}, expected {outputs:?}"));
        }
        let mut values = Values::default();
        let of_model = graph.parameters.iter().map(|parameter| &parameter.name);
        for (index, name) in of_model.chain(graph.constants.values.iter().map(|value| &value.name)).enumerate() {
            values.name(name.clone(), Value::Constant(Source::Model(index)));
        }
        let mut elements = 0;
        for input in inputs {
            let shape =
                graph.inputs.iter().find(|declared| declared.name == *input).map_or(&[][..], |found| &found.shape);
            let names: Vec<String> = match shape {
                [] => vec![(*input).to_owned()],
                [count] => (0..*count).map(|i| format!("{input}[{i}]")).collect(),
                [rows, columns, ..] => {
                    let place = |i: usize| format!("{input}[{}][{}]", i / columns, i % columns);
                    (0..rows * columns).map(place).collect()
                }
            };
            for name in names {
                values.name(name, Value::Input(elements));
                elements += 1;
            }
        }
        values.extend(&family.configuration.statements)?;
        values.extend(&function.statements)?;
        let mut wanted = Vec::new();
        let mut ranges = Vec::with_capacity(function.outputs.len());
        for output in &function.outputs {
            let start = wanted.len();
            for element in &output.elements {
                wanted.push(values.operand(element)?);
            }
            ranges.push(start..wanted.len());
        }
        Ok(Self { index, program: Program::new(&values, elements, &wanted)?, outputs: ranges })
    }

    #[cfg(test)]
    pub(super) fn program(&self) -> &Program {
        &self.program
    }
}
