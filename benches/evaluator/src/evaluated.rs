//! Batches of an evaluated graph.

use crate::Problem;
use crate::states::Arrays;
use planar_build::evaluator::{Batch, Evaluator, Function, GraphModel, InstructionSet, Order, Status};
use planar_build::graph;
use planar_layout::layout::Layout;
use planar_layout::structure::parameters;
use std::path::Path;
use std::sync::Arc;

/// The evaluated robot, and its parameters.
pub struct Robot {
    pub evaluator: Arc<Evaluator>,
    pub model: GraphModel,
    parameters: Vec<f64>,
}

/// The paper's.
pub fn robot() -> Result<Robot, Problem> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../codegen");
    let text = std::fs::read_to_string(folder.join("graphs/dual_arm_3r.json"))?;
    let evaluator = Arc::new(Evaluator::new(&graph::read_any(&text)?)?);
    let layout = Layout::read(&folder.join("layouts/dual_arm_3r.toml")).map_err(|report| report.to_string())?;
    let model = evaluator.model(&layout).map_err(|_| "the layout has another structure")?;
    let parameters = parameters(evaluator.structure(), &layout).map_err(|_| "the layout has another structure")?;
    Ok(Robot { evaluator, model, parameters })
}

/// Calls of a function, and places for its results.
pub struct Batches<'a> {
    robot: &'a Robot,
    function: &'a Function,
    inputs: Vec<&'a [f64]>,
    order: Order,
    set: InstructionSet,
    /// Of every instance, where each has its own.
    parameters: Option<Vec<f64>>,
    results: Vec<Option<Vec<f64>>>,
    statuses: Vec<Status>,
}

impl<'a> Batches<'a> {
    pub fn new(
        robot: &'a Robot,
        function: &str,
        inputs: &'a Arrays,
        order: Order,
        set: InstructionSet,
    ) -> Result<Self, Problem> {
        let function = robot.evaluator.function(function).ok_or("the graph lacks a function")?;
        let count = inputs.get("base_pose").len() / 3;
        let is_wanted =
            |name: &str| name != "smallest_pivot" && !(function.name() == "full_impact" && name.starts_with("impact_"));
        let outputs = function.outputs().iter();
        let results = outputs.map(|o| is_wanted(&o.name).then(|| vec![0.0; o.rows() * count])).collect();
        Ok(Self {
            robot,
            function,
            inputs: function.inputs().iter().map(|input| inputs.get(&input.name)).collect(),
            order,
            set,
            parameters: None,
            results,
            statuses: vec![Status::Done; count],
        })
    }

    /// With the robot's parameters for every instance, which are not known to be the same.
    pub fn of_each(robot: &'a Robot, function: &str, inputs: &'a Arrays, set: InstructionSet) -> Result<Self, Problem> {
        let order = Order::Elements;
        let batches = Self::new(robot, function, inputs, order, set)?;
        let count = batches.statuses.len();
        let parameters = robot.parameters.iter().flat_map(|number| std::iter::repeat_n(*number, count)).collect();
        Ok(Self { parameters: Some(parameters), ..batches })
    }

    pub fn call(&mut self) -> Result<(), Problem> {
        let batch = match &self.parameters {
            None => Batch::of(&self.robot.model),
            Some(parameters) => Batch::of_each(&self.robot.evaluator, parameters),
        };
        let mut outputs: Vec<_> = self.results.iter_mut().map(Option::as_deref_mut).collect();
        let batch = batch.in_order(self.order).with_instructions(self.set);
        Ok(batch.call(self.function.name(), &self.inputs, &mut outputs, &mut self.statuses)?)
    }

    /// That the results have these bits.
    pub fn compare(&self, expected: &[&[f64]]) -> Result<(), Problem> {
        let found: Vec<&[f64]> = self.results.iter().flatten().map(Vec::as_slice).collect();
        let bits = |all: &[&[f64]]| all.concat().iter().map(|number| number.to_bits()).collect::<Vec<_>>();
        if bits(&found) == bits(expected) { Ok(()) } else { Err("the results have other bits".into()) }
    }
}
