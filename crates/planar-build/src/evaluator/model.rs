//! A robot whose dynamics are those of a graph.

use super::argument::Argument;
use super::constants;
use super::function::{Function, Results};
use super::functions::Functions;
use super::program::Program;
use super::values::{Value, Values};
use crate::format::{Constants, Graph, Operand, Variable};
use crate::graph::{self, GraphError};
use planar_layout::layout::Layout;
use planar_layout::structure::{Mismatch, Structure, parameters};
use std::sync::Arc;

/// The programs of a graph, for every layout of its structure.
#[derive(Clone, Debug)]
pub struct Evaluator {
    structure: Structure,
    parameters: Vec<Argument>,
    /// From the parameters to all that later programs read besides them.
    pub(super) constants: Program,
    /// Those of the graph, then the velocities of `full_impact` alone, which need less than all its outputs.
    pub(super) all: Vec<Function>,
    /// Where those of the traits are.
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

/// Of `full_impact`, for the traits.
const VELOCITIES_AND_PIVOT: [&str; 3] = ["base_twist_after", "joint_rates_after", "smallest_pivot"];

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
            let outputs = constants.iter().map(|constant| values.operand(&named(constant)));
            let mut outputs = outputs.collect::<Result<Vec<_>, _>>()?;
            let masses = graph.masses().map(|mass| values.operand(&Operand::Name(mass.name.clone())));
            let masses = masses.collect::<Result<Vec<_>, _>>()?;
            // after the graph's: what is added to every pivot
            outputs.push(values.regularity(&masses));
            Program::new(&values, graph.parameters.len(), &outputs)
        });
        let constants = program.map_err(GraphError::Format)?;
        let compiled = graph.functions_of_families().enumerate().map(|(index, (family, function))| {
            let compiled = Function::new(graph, family, function, index);
            compiled.map_err(|e| GraphError::Format(format!("`{}`: {e}", function.name)))
        });
        let mut all = compiled.collect::<Result<Vec<_>, _>>()?;
        let mut functions = Functions::new(&structure, &mut |name, inputs, outputs| {
            let found = all.iter().find(|function| function.name() == name).ok_or_else(|| "it is missing".to_owned());
            found
                .and_then(|function| function.check(inputs, outputs).map(|()| function.index))
                .map_err(|e| GraphError::Format(format!("`{name}`: {e}")))
        })?;
        let impact = &all[functions.full_impact];
        let velocities = impact.with_outputs(graph, &VELOCITIES_AND_PIVOT, all.len()).map_err(GraphError::Format)?;
        functions.full_impact = velocities.index;
        all.push(velocities);
        let parameters = graph.parameters.iter().map(Argument::of_parameter).collect();
        Ok(Self { structure, parameters, constants, all, functions })
    }

    /// All functions of the graph, in its order.
    pub fn functions(&self) -> impl Iterator<Item = &Function> {
        self.all[..self.all.len() - 1].iter()
    }

    /// The function of a name.
    #[must_use]
    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions().find(|function| function.name() == name)
    }

    /// The structure of the layouts that it has models of.
    #[must_use]
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Names, units and meanings of the parameters, in the order of [`Structure::parameters`].
    #[must_use]
    pub fn parameters(&self) -> &[Argument] {
        &self.parameters
    }

    /// The model with these numbers, one for each of the [`parameters`](Self::parameters); `None` for another count. They
    /// are not checked.
    #[must_use]
    pub fn model_with(self: &Arc<Self>, parameters: Vec<f64>) -> Option<GraphModel> {
        let fits = parameters.len() == self.parameters.len();
        fits.then(|| GraphModel::new(Arc::clone(self), parameters))
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
        let Evaluator { constants: program, all: functions, .. } = &*evaluator;
        let model = constants::of_model(program, &parameters);
        let constants = functions.iter().map(|function| constants::first(&function.program, &model)).collect();
        Self { evaluator, parameters, constants }
    }

    pub(super) fn evaluator(&self) -> &Evaluator {
        &self.evaluator
    }

    pub(super) fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The same robot with other numbers; `None` where a constant of these is not finite.
    pub(super) fn with_parameters(&self, parameters: Vec<f64>) -> Option<Self> {
        let model = Self::new(Arc::clone(&self.evaluator), parameters);
        model.constants.iter().flatten().all(|constant| constant.is_finite()).then_some(model)
    }

    /// Calls a function; `read` takes what it wants of the results.
    pub(super) fn call<R>(&self, function: usize, inputs: &[&[f64]], read: impl FnOnce(&Results<'_>) -> R) -> R {
        self.evaluator.all[function].call(&self.constants[function], inputs, read)
    }

    /// What is in the first registers of a function.
    pub(super) fn constants(&self, function: &Function) -> &[f64] {
        &self.constants[function.index]
    }
}
