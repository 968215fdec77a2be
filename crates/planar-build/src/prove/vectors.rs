//! Reference vectors: results of the generic implementation at a state, for every output of every generated function.

use crate::evaluator::by_arm;
use crate::format::{FunctionResult, Given, Graph, PIVOT, ReferenceState};
use crate::prove::evaluation::EvaluationInput;
use crate::prove::generic_results::{Expected, results};
use crate::prove::impact_results::impact_results;
use crate::prove::interpreter::{Arguments, interpret, interpret_in_single_precision, interpret_perturbed};
use crate::prove::perturbed::UNIT;
use crate::prove::quantities::scaled_error;
use crate::prove::sampling::{Regime, RegimeSample, Units, four_digits, rounded};
use planar_dynamics::error::Error;
use planar_dynamics::quantity::Quantity;
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;

/// What a module may be off by in its own test, over the largest error that a graph is seen to have: rounding depends on the
/// compiler, too, by the order of operations, and by products that are fused with sums.
const MARGIN: f64 = 16.0;

/// Runs with numbers that are off.
const RUNS: u64 = 8;

/// A pivot in single precision at or below which modules have no result.
const SINGULAR: f64 = 8.0 * f32::EPSILON as f64;

/// Results at a state, and how many rounding units each of them may be off in natural sizes.
pub struct Reference {
    pub state: ReferenceState,
    pub roundings: Vec<f64>,
}

/// The results of a robot at a state, in the order of the table of quantities; the robot's parameters are given, too, and
/// `has_impact_results` adds the results of [`impact_results`]. Numbers of the state have four digits, so that they can be
/// read; every machine makes the same.
///
/// # Errors
/// A state that the generic implementation has no answer for.
pub fn reference_state(
    sample: RegimeSample,
    parameters: Vec<f64>,
    has_impact_results: bool,
) -> Result<Reference, Error> {
    let RegimeSample { layout, instant } = sample;
    let mut instant = readable(instant);
    instant.base_wrench.get_or_insert([0.0; 3]);
    instant.end_effector_wrenches.get_or_insert_with(|| vec![[0.0; 3]; layout.arms.len()]);
    // impacts are computed where there is a target
    if instant.targets.iter().all(Option::is_none) {
        let target = Target { mass: 10.0, inertia: 0.5, contact: [0.25, -0.125], twist: [0.5, -0.25, 0.125] };
        instant.targets[0] = Some(Units::of(&layout).target(&target));
    }
    let base_wrench = EvaluationInput { end_effector_wrenches: None, ..instant.clone() };
    let torques_alone = EvaluationInput { base_wrench: None, ..base_wrench.clone() };
    let [torques_alone, base_wrench, all] = [&torques_alone, &base_wrench, &instant].map(|at| results(&layout, at));
    let (torques_alone, base_wrench, all) = (torques_alone?, base_wrench?, all?);
    let (mut expected, mut roundings) = (Vec::new(), Vec::new());
    for quantity in Quantity::ALL {
        for function in quantity.row().functions {
            let results = match *function {
                "forward_dynamics" => &torques_alone,
                "forward_dynamics_with_base_wrench" => &base_wrench,
                _ => &all,
            };
            if let Some(Expected { values, sizes, roundings: allowed }) = results.get(quantity).cloned() {
                roundings.push(allowed);
                let (function, output) = ((*function).to_owned(), quantity.row().output.to_owned());
                expected.push(FunctionResult { function, output, values, sizes });
            }
        }
    }
    if has_impact_results {
        for (result, allowed) in impact_results(&layout, &instant)? {
            expected.push(result);
            roundings.push(allowed);
        }
    }
    Ok(Reference {
        state: ReferenceState { parameters, inputs: inputs(&instant), expected, double_alone: None },
        roundings,
    })
}

/// A direction in the inputs of all functions, by the inputs' names: differences of a moving state.
pub fn direction(layout: &Layout, index: u64) -> Vec<Given> {
    inputs(&readable(Regime::Moving.sample(layout, 1, index).instant))
}

impl FunctionResult {
    /// Whether it is of the same function and output.
    fn is_of(&self, other: &Self) -> bool {
        self.function == other.function && self.output == other.output
    }

    /// Largest difference from what was `found` over what is allowed; infinite where something is missing or not a number.
    pub fn error(&self, found: &Self) -> f64 {
        scaled_error(&found.values, &self.values, &self.sizes) / f64::EPSILON
    }
}

impl ReferenceState {
    /// The result of the same function and output; `None` for one that the table of quantities does not have.
    pub fn expected(&self, found: &FunctionResult) -> Option<&FunctionResult> {
        self.expected.iter().find(|expected| expected.is_of(found))
    }

    /// As stored in a graph for a module's own test: the results in the order of the graph, with its pivots, which the generic
    /// implementation does not compute, and with what rounding is seen to do to each number: in double, in single precision,
    /// and in runs with numbers that are off. That is less than what a proof allows, which is what rounding may do at worst.
    ///
    /// # Errors
    /// As [`interpret`].
    pub fn of_own_test(self, graph: &Graph) -> Result<Self, String> {
        let arguments = Arguments::of(&self);
        let double = interpret(graph, arguments)?;
        let single = interpret_in_single_precision(graph, arguments)?;
        let perturbed: Result<Vec<_>, _> = (1..=RUNS).map(|run| interpret_perturbed(graph, arguments, run)).collect();
        let (perturbed, mut double_alone) = (perturbed?, None);
        let mut expected = Vec::with_capacity(double.len());
        for (index, found) in double.into_iter().enumerate() {
            let values = self.expected(&found).unwrap_or(&found).values.clone();
            let mut sizes = Vec::with_capacity(values.len());
            for (element, value) in values.iter().enumerate() {
                let [in_double, in_single] = [&found, &single[index]].map(|found| found.values[element]);
                if !in_single.is_finite() || (found.output == PIVOT && in_single <= SINGULAR) {
                    let FunctionResult { function, output, .. } = &found;
                    double_alone.get_or_insert_with(|| format!("{output} of {function} is {in_single:e} in it"));
                }
                let moved = perturbed.iter().map(|run| (run[index].values[element] - in_double).abs() / UNIT);
                let off = [(in_double, f64::EPSILON), (in_single, f64::from(f32::EPSILON))];
                let off = off.into_iter().filter(|(found, _)| found.is_finite());
                let off = off.map(|(found, rounding)| (found - value).abs() / rounding);
                sizes.push(rounded(MARGIN * moved.chain(off).fold(value.abs(), f64::max), 1));
            }
            expected.push(FunctionResult { values, sizes, ..found });
        }
        Ok(Self { expected, double_alone, ..self })
    }
}

/// The inputs of all functions, row-major, by name.
fn inputs(instant: &EvaluationInput) -> Vec<Given> {
    let EvaluationInput { state, joint_torques, base_wrench, end_effector_wrenches, targets } = instant;
    let [masses, inertias, contacts, twists] = by_arm(targets);
    let inputs = [
        ("base_pose", state.base_pose.to_vec()),
        ("joint_angles", state.joint_angles.clone()),
        ("base_twist", state.base_twist.to_vec()),
        ("joint_rates", state.joint_rates.clone()),
        ("joint_torques", joint_torques.clone()),
        ("base_wrench", base_wrench.unwrap_or_default().to_vec()),
        ("end_effector_wrenches", end_effector_wrenches.iter().flatten().flatten().copied().collect()),
        ("target_masses", masses),
        ("target_inertias", inertias),
        ("contacts", contacts),
        ("target_twists", twists),
    ];
    inputs.map(|(name, values)| Given { name: name.to_owned(), values }).into()
}

/// Four digits of every number.
fn readable(mut instant: EvaluationInput) -> EvaluationInput {
    let round = |x: &mut f64| *x = four_digits(*x);
    let EvaluationInput { state, joint_torques, base_wrench, end_effector_wrenches, targets } = &mut instant;
    state.base_pose.iter_mut().chain(&mut state.base_twist).for_each(round);
    state.joint_angles.iter_mut().chain(&mut state.joint_rates).chain(joint_torques).for_each(round);
    base_wrench.iter_mut().chain(end_effector_wrenches.iter_mut().flatten()).flatten().for_each(round);
    for target in targets.iter_mut().flatten() {
        round(&mut target.mass);
        round(&mut target.inertia);
        target.contact.iter_mut().chain(&mut target.twist).for_each(round);
    }
    instant
}
