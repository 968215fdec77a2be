//! A robot: a layout, and the graph that computes it.

use crate::call::{Call, Robots};
use crate::capture::{Captures, INPUTS};
use crate::failure::{Failure, of_graph, of_layout, of_report};
use crate::instance::Instance;
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use planar_capture::dynamics::Robot as _;
use planar_capture::evaluator::{Argument, Evaluator, Function, GraphModel, Status};
use planar_capture::graphs::{self, FoundGraph};
use planar_capture::layout::Layout;
use planar_capture::named_layout::named_layout;
use planar_capture::registry::Robots as Known;
use planar_capture::structure::parameters;
use pyo3::prelude::{Bound, PyErr, PyResult, Python, pyclass, pymethods};
use std::borrow::Cow;
use std::sync::Arc;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Output<'py> = Option<Bound<'py, PyArray1<f64>>>;
type Outcome<'py> = (Vec<Output<'py>>, Bound<'py, PyArray1<u8>>);

/// An argument of a function: name, shape, unit, description.
type Described = (String, Vec<usize>, String, String);

/// A robot: a layout, and the graph that computes it.
#[pyclass(frozen, module = "planar_capture._native")]
pub struct Robot {
    layout: Layout,
    evaluator: Arc<Evaluator>,
    model: GraphModel,
    values: Vec<f64>,
    origin: String,
    graph: Cow<'static, str>,
}

impl Robot {
    /// With the graph of the layout's structure.
    pub fn of(layout: Layout) -> PyResult<Self> {
        let FoundGraph { evaluator, origin, text: graph } = graphs::find(&layout).map_err(|error| of_graph(&error))?;
        let unfit = |_| Failure::MissingGraph.with("the graph is of another structure");
        let values = parameters(evaluator.structure(), &layout).map_err(unfit)?;
        let model = evaluator.model(&layout).map_err(unfit)?;
        Ok(Self { layout, evaluator, model, values, origin, graph })
    }

    fn function(&self, name: &str) -> PyResult<&Function> {
        let known = || self.evaluator.functions().map(Function::name).collect::<Vec<_>>().join(", ");
        let missing = || Failure::Input.with(format!("the graph has no function `{name}`: it has {}", known()));
        self.evaluator.function(name).ok_or_else(missing)
    }
}

fn described(argument: &Argument) -> Described {
    let Argument { name, shape, unit, description } = argument.clone();
    (name, shape, unit, description)
}

fn slices<'a>(arrays: &'a [Numbers<'_>]) -> PyResult<Vec<&'a [f64]>> {
    let slices = arrays.iter().map(|array| array.as_slice().map_err(PyErr::from));
    slices.collect()
}

fn codes<'py>(py: Python<'py>, statuses: &[Status]) -> Bound<'py, PyArray1<u8>> {
    let code = |status: &Status| match status {
        Status::Done => 0,
        Status::Singular => 1,
        Status::NotFinite => 2,
    };
    statuses.iter().map(code).collect::<Vec<u8>>().into_pyarray(py)
}

#[pymethods]
impl Robot {
    /// The robot of a shipped layout's name, or of a path.
    #[staticmethod]
    fn named(argument: &str) -> PyResult<Self> {
        let (text, file) = named_layout(argument, Known::SHIPPED).map_err(of_layout)?;
        Self::parse(&text, &file)
    }

    /// The robot of a TOML text, which is called `file` in messages.
    #[staticmethod]
    fn parse(text: &str, file: &str) -> PyResult<Self> {
        Self::of(Layout::parse(text, file).map_err(of_report)?)
    }

    /// The text of a shipped layout's name, or of a path.
    #[staticmethod]
    fn layout_of(argument: &str) -> PyResult<String> {
        named_layout(argument, Known::SHIPPED).map(|(text, _)| text).map_err(of_layout)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.layout.name
    }

    #[getter]
    fn arms(&self) -> Vec<(String, usize)> {
        self.layout.arms.iter().map(|arm| (arm.name.clone(), arm.links.len())).collect()
    }

    #[getter]
    fn origin(&self) -> &str {
        &self.origin
    }

    /// The graph's text, JSON.
    #[getter]
    fn graph(&self) -> &str {
        &self.graph
    }

    /// The layout as TOML.
    #[getter]
    fn layout(&self) -> String {
        self.layout.to_toml()
    }

    /// The parameters: names, units, descriptions, and the layout's values.
    #[getter]
    fn parameters(&self) -> Vec<(String, String, String, f64)> {
        let arguments = self.evaluator.parameters().iter().cloned();
        arguments
            .zip(&self.values)
            .map(|(argument, value)| (argument.name, argument.unit, argument.description, *value))
            .collect()
    }

    /// The functions of the graph: names, inputs, outputs.
    #[getter]
    fn functions(&self) -> Vec<(String, Vec<Described>, Vec<Described>)> {
        let all = |arguments: &[Argument]| arguments.iter().map(described).collect();
        let functions = self.evaluator.functions();
        functions
            .map(|function| (function.name().to_owned(), all(function.inputs()), all(function.outputs())))
            .collect()
    }

    /// Calls a function of the graph for so many instances: its outputs where they are wanted, and statuses.
    #[allow(clippy::too_many_arguments, reason = "keyword arguments for the one caller in Python")]
    fn call<'py>(
        &self,
        py: Python<'py>,
        function: &str,
        inputs: Vec<Numbers<'py>>,
        wanted: Vec<bool>,
        instances: usize,
        parameters: Option<Numbers<'py>>,
        threads: Option<usize>,
    ) -> PyResult<Outcome<'py>> {
        let function = self.function(function)?;
        let slices = slices(&inputs)?;
        let robots = match &parameters {
            Some(parameters) => Robots::Each(&self.evaluator, parameters.as_slice()?),
            None => Robots::One(&self.model),
        };
        let call = Call { function, robots, inputs: &slices, wanted: &wanted, instances, threads };
        let results = py.detach(|| call.run()).map_err(|error| Failure::Input.with(error))?;
        let outputs = results.outputs.into_iter().map(|output| output.map(|output| output.into_pyarray(py))).collect();
        Ok((outputs, codes(py, &results.statuses)))
    }

    /// Rigid captures of so many instances: base twists, joint rates, twists of the targets, impulses, and statuses.
    fn capture<'py>(
        &self,
        py: Python<'py>,
        inputs: Vec<Numbers<'py>>,
        instances: usize,
        parameters: Option<Numbers<'py>>,
        threads: Option<usize>,
    ) -> PyResult<Outcome<'py>> {
        let slices = slices(&inputs)?;
        let rows = Captures::rows(&self.model);
        let count = self.evaluator.parameters().len();
        let parameters = parameters.as_ref().map(Numbers::as_slice).transpose()?;
        let lengths = slices.iter().zip(rows).all(|(numbers, rows)| numbers.len() == rows * instances);
        if slices.len() != rows.len() || !lengths || parameters.is_some_and(|all| all.len() != count * instances) {
            return Err(Failure::Input.with("arrays of other lengths than those of the instances"));
        }
        let (evaluator, model) = (&self.evaluator, &self.model);
        let captures = Captures { evaluator, model, parameters, inputs: &slices, instances, threads };
        let after = py.detach(|| captures.run());
        let outputs = after.outputs.into_iter().map(|output| Some(output.into_pyarray(py))).collect();
        Ok((outputs, codes(py, &after.statuses)))
    }

    /// Why one instance has no result, in the words of the command line; `None` where the function of one state has one.
    fn why(
        &self,
        function: &str,
        inputs: Vec<Numbers<'_>>,
        parameters: Option<Numbers<'_>>,
    ) -> PyResult<Option<String>> {
        let slices = slices(&inputs)?;
        let names: Vec<String> = match self.evaluator.function(function) {
            Some(function) => function.inputs().iter().map(|input| input.name.clone()).collect(),
            None => INPUTS.map(str::to_owned).to_vec(),
        };
        let zeros = vec![0.0; self.model.joints()];
        let instance = Instance::of(names.iter().map(String::as_str).zip(slices), &zeros);
        let own = match &parameters {
            Some(parameters) => self.evaluator.model_with(parameters.as_slice()?.to_vec()),
            None => None,
        };
        Ok(instance.error(own.as_ref().unwrap_or(&self.model), function).map(|error| error.to_string()))
    }
}
