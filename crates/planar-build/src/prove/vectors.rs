//! Reference vectors: results of the generic implementation at a state, for every output of every generated function.

use crate::evaluator::by_arm;
use crate::format::{FunctionResult, Given, ReferenceState};
use crate::prove::evaluation::EvaluationInput;
use crate::prove::generic_results::{Expected, results};
use crate::prove::impact_results::impact_results;
use crate::prove::quantities::scaled_error;
use crate::prove::sampling::{Regime, RegimeSample, Units};
use planar_dynamics::error::Error;
use planar_dynamics::quantity::Quantity;
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;

/// Rounding units that a pivot relative to its scale may be off.
const PIVOT_ROUNDINGS: f64 = 1024.0;

/// What a module may be off by in its own test, over the largest error that a graph has in either precision, and no less
/// in natural sizes: rounding depends on the compiler, too, by the order of operations, and by products that are fused
/// with sums.
const MARGIN: f64 = 16.0;

/// Results at a state, and how many rounding units each of them may be off in natural sizes.
pub struct Reference {
    /// The robot, whose numbers are the layout's in some regimes.
    pub layout: Layout,
    pub state: ReferenceState,
    pub roundings: Vec<f64>,
}

/// The results at one random state of a regime, and of its numbers of the robot, in the order of the table of quantities; `has_impact_results` adds those of [`impact_results`]. Numbers of the state have four digits, so that they can be read; every machine makes the same.
///
/// # Errors
/// A state that the generic implementation has no answer for.
pub fn reference_state(
    layout: &Layout,
    regime: Regime,
    index: u64,
    has_impact_results: bool,
) -> Result<Reference, Error> {
    let units = Units::of(layout);
    let RegimeSample { layout, instant } = regime.sample(layout, 0, index);
    let mut instant = readable(instant);
    instant.base_wrench.get_or_insert([0.0; 3]);
    instant.end_effector_wrenches.get_or_insert_with(|| vec![[0.0; 3]; layout.arms.len()]);
    // impacts are computed where there is a target
    if instant.targets.iter().all(Option::is_none) {
        let target = Target { mass: 10.0, inertia: 0.5, contact: [0.25, -0.125], twist: [0.5, -0.25, 0.125] };
        instant.targets[0] = Some(units.target(&target));
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
    Ok(Reference { layout, state: ReferenceState { inputs: inputs(&instant), expected }, roundings })
}

/// A direction in the inputs of all functions, by the inputs' names: differences of a moving state.
pub fn direction(layout: &Layout, index: u64) -> Vec<Given> {
    inputs(&readable(Regime::Moving.sample(layout, 1, index).instant))
}

impl Reference {
    /// Narrows what each result may be off to what is seen of rounding, with a margin: what a proof allows is what rounding
    /// may be at worst, of which a fault in single precision could be a part. Results of the graph are `found` in double
    /// and in single precision.
    pub fn narrow(references: &mut [Self], found: &[[Vec<FunctionResult>; 2]]) {
        let results = references.first().map_or(0, |reference| reference.state.expected.len());
        for index in 0..results {
            let worst = references.iter().zip(found).fold(0.0, |worst: f64, (reference, found)| {
                let expected = &reference.state.expected[index];
                let errors = found.iter().zip([f64::EPSILON, f64::from(f32::EPSILON)]).map(|(found, rounding)| {
                    let found = found.iter().find(|found| found.is_of(expected));
                    found.map_or(1.0, |found| expected.error(found, rounding))
                });
                errors.fold(worst, f64::max)
            });
            for reference in &mut *references {
                let least = MARGIN / reference.roundings[index];
                let part = (MARGIN * worst).max(least).min(1.0);
                reference.state.expected[index].sizes.iter_mut().for_each(|size| *size *= part);
            }
        }
    }
}

impl FunctionResult {
    /// Whether it is of the same function and output.
    fn is_of(&self, other: &Self) -> bool {
        self.function == other.function && self.output == other.output
    }

    /// Largest difference from what was `found` over what is allowed with a unit of rounding; infinite where something is
    /// missing or not a number.
    pub fn error(&self, found: &Self, rounding: f64) -> f64 {
        scaled_error(&found.values, &self.values, &self.sizes) / rounding
    }
}

impl ReferenceState {
    /// The result of the same function and output; `None` for one that the table of quantities does not have.
    pub fn expected(&self, found: &FunctionResult) -> Option<&FunctionResult> {
        self.expected.iter().find(|expected| expected.is_of(found))
    }

    /// As stored in a graph: the results in the order of `found`, with the pivots from there, which the generic
    /// implementation does not compute, and the sizes to two digits.
    pub fn in_order_of(&self, found: &[FunctionResult]) -> Self {
        let expected = found.iter().map(|found| {
            let sizes = vec![PIVOT_ROUNDINGS; found.values.len()];
            let pivot = || FunctionResult { sizes, ..found.clone() };
            let mut expected = self.expected(found).cloned().unwrap_or_else(pivot);
            expected.sizes.iter_mut().for_each(|size| *size = rounded(*size, 1));
            expected
        });
        Self { inputs: self.inputs.clone(), expected: expected.collect() }
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

/// A number with so many decimals in scientific notation.
fn rounded(number: f64, decimals: usize) -> f64 {
    format!("{number:.decimals$e}").parse().expect("a number that was written is read")
}

/// Four digits of every number.
fn readable(mut instant: EvaluationInput) -> EvaluationInput {
    let round = |x: &mut f64| *x = rounded(*x, 3);
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
