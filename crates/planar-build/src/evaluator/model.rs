//! A robot whose dynamics are those of a graph.

use super::function::{Function, Results, run};
use super::functions::Functions;
use super::program::Program;
use super::values::{Source, Value, Values};
use crate::format::{Constants, Graph, Operand, Variable};
use crate::graph::{self, GraphError};
use planar_layout::layout::Layout;
use planar_layout::structure::{Mismatch, Structure, parameters};
use std::sync::Arc;

/// The programs of a graph, for every layout of its structure.
#[derive(Clone, Debug)]
pub struct Evaluator {
    structure: Structure,
    /// From the parameters to all that later programs read besides them.
    constants: Program,
    pub(super) functions: Functions,
}

/// A robot with its numbers.
#[derive(Clone, Debug)]
pub struct GraphModel {
    evaluator: Arc<Evaluator>,
    parameters: Vec<f64>,
    /// What is in the first registers of each function.
    constants: Vec<Vec<f64>>,
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
        Ok(Self { structure, constants, functions })
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
        function.call(&self.constants[function.index], inputs, read)
    }
}
