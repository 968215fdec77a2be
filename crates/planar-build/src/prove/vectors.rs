//! Reference vectors: what the generic implementation says of a state, for every result of every generated function.

use super::interpreter::Found;
use crate::format::{Expected, Given, ReferenceState};
use crate::prove::evaluation::{EvaluationInput, evaluate_all};
use crate::prove::generic::Generic;
use crate::prove::quantities::{NaturalSize, natural_sizes};
use crate::prove::sampling::{Regime, RegimeSample};
use planar_dynamics::error::Error;
use planar_dynamics::quantity::{Quantity, Rounding};
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;

/// Rounding units that a result computed by sums and products may be off, in natural sizes.
const ROUNDINGS: f64 = 64.0;

/// Rounding units that a pivot relative to its scale may be off.
const PIVOT_ROUNDINGS: f64 = 1024.0;

impl Expected {
    /// Largest difference over what is allowed in `f64`; infinite where something is missing or not a number.
    #[must_use]
    pub fn error(&self, found: &Found) -> f64 {
        if found.values.len() != self.values.len() {
            return f64::INFINITY;
        }
        let errors = self.values.iter().zip(&found.values).zip(&self.sizes).map(|((expected, found), size)| {
            let difference = (expected - found).abs();
            if difference == 0.0 { 0.0 } else { difference / (size * f64::EPSILON) }
        });
        errors.fold(0.0, |worst, error| {
            if error <= worst {
                worst
            } else if error.is_nan() {
                f64::INFINITY
            } else {
                error
            }
        })
    }
}

/// One state with all that has to come of it.
#[derive(Clone, Debug)]
pub struct Vectors {
    instant: EvaluationInput,
    /// One per result of every function.
    pub expected: Vec<Expected>,
}

impl Vectors {
    /// At one random state of a regime that leaves the layout as it is. Numbers of the state have four digits, so that
    /// they can be read; every machine makes the same.
    ///
    /// # Errors
    /// A state that the generic implementation has no answer for.
    pub fn new(layout: &Layout, regime: Regime, index: u64) -> Result<Self, Error> {
        let RegimeSample { instant, .. } = regime.sample(layout, 0, index);
        let mut instant = readable(instant);
        let arms = layout.arms.len();
        instant.base_wrench.get_or_insert([0.0; 3]);
        instant.end_effector_wrenches.get_or_insert_with(|| vec![[0.0; 3]; arms]);
        // impacts are computed where there is a target
        let free = instant.targets.iter().all(Option::is_none);
        if let (Some(first), true) = (instant.targets.first_mut(), free) {
            *first = Some(Target { mass: 10.0, inertia: 0.5, contact: [0.25, -0.125], twist: [0.5, -0.25, 0.125] });
        }
        let torques_alone = EvaluationInput { base_wrench: None, end_effector_wrenches: None, ..instant.clone() };
        let base_wrench = EvaluationInput { end_effector_wrenches: None, ..instant.clone() };
        let [torques_alone, base_wrench, all] =
            [&torques_alone, &base_wrench, &instant].map(|instant| results(layout, instant));
        let (torques_alone, base_wrench, all) = (torques_alone?, base_wrench?, all?);
        let results = Quantity::ALL.iter().flat_map(|quantity| {
            let row = quantity.row();
            row.functions.iter().map(move |function| (*quantity, *function, row.output))
        });
        let expected = results.filter_map(|(quantity, function, output)| {
            let results = match function {
                "forward_dynamics" => &torques_alone,
                "forward_dynamics_with_base_wrench" => &base_wrench,
                _ => &all,
            };
            let Known { values, sizes, .. } = results.iter().find(|known| known.quantity == quantity)?.clone();
            Some(Expected { function: function.to_owned(), output: output.to_owned(), values, sizes })
        });
        let expected = expected.collect();
        Ok(Self { instant, expected })
    }

    /// What one result has to be; `None` for one that the table does not have.
    #[must_use]
    pub fn expected(&self, found: &Found) -> Option<&Expected> {
        self.expected.iter().find(|expected| expected.function == found.function && expected.output == found.output)
    }

    /// The inputs of all functions, row-major, by name.
    #[must_use]
    pub fn inputs(&self) -> [(&'static str, Vec<f64>); 11] {
        let EvaluationInput { state, joint_torques, base_wrench, end_effector_wrenches, targets } = &self.instant;
        let targets: Vec<_> = targets.iter().map(|target| target.unwrap_or_else(Target::massless)).collect();
        [
            ("base_pose", state.base_pose.to_vec()),
            ("joint_angles", state.joint_angles.clone()),
            ("base_twist", state.base_twist.to_vec()),
            ("joint_rates", state.joint_rates.clone()),
            ("joint_torques", joint_torques.clone()),
            ("base_wrench", base_wrench.unwrap_or_default().to_vec()),
            ("end_effector_wrenches", end_effector_wrenches.iter().flatten().flatten().copied().collect()),
            ("target_masses", targets.iter().map(|target| target.mass).collect()),
            ("target_inertias", targets.iter().map(|target| target.inertia).collect()),
            ("contacts", targets.iter().flat_map(|target| target.contact).collect()),
            ("target_twists", targets.iter().flat_map(|target| target.twist).collect()),
        ]
    }

    /// As a graph keeps them. Pivots, which the generic implementation does not have, are those that were `found`.
    #[must_use]
    pub fn reference_state(&self, found: &[Found]) -> ReferenceState {
        let inputs = self.inputs().map(|(name, values)| Given { name: name.to_owned(), values }).into();
        let pivot = |found: &Found| Expected {
            function: found.function.clone(),
            output: found.output.clone(),
            values: found.values.clone(),
            sizes: vec![PIVOT_ROUNDINGS; found.values.len()],
        };
        let expected = found.iter().map(|found| self.expected(found).cloned().unwrap_or_else(|| pivot(found)));
        // two digits of a size are enough
        let shortened = |mut expected: Expected| {
            expected.sizes.iter_mut().for_each(|size| *size = rounded(*size, 1));
            expected
        };
        ReferenceState { inputs, expected: expected.map(shortened).collect() }
    }
}

/// A number with so many decimals in scientific notation.
fn rounded(number: f64, decimals: usize) -> f64 {
    format!("{number:.decimals$e}").parse().expect("a number that was written is read")
}

/// A quantity by the generic implementation.
#[derive(Clone, Debug)]
struct Known {
    quantity: Quantity,
    values: Vec<f64>,
    /// How many rounding units each entry may be off.
    sizes: Vec<f64>,
}

/// Every quantity of one instant by the generic implementation.
fn results(layout: &Layout, instant: &EvaluationInput) -> Result<Vec<Known>, Error> {
    let sample = RegimeSample { layout: layout.clone(), instant: instant.clone() };
    let values = evaluate_all(&Generic::new(layout), instant)?;
    let sizes = natural_sizes(&sample, &values).into_iter();
    let each = sizes.filter_map(|(quantity, NaturalSize { sizes, condition })| {
        let roundings = match quantity.row().rounding {
            Rounding::Polynomial => ROUNDINGS,
            Rounding::Solved => ROUNDINGS.max(8.0 * condition),
        };
        let sizes = sizes.iter().map(|size| size * roundings).collect();
        Some(Known { quantity, values: values.get(quantity)?.to_vec(), sizes })
    });
    Ok(each.collect())
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
