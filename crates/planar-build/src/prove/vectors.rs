//! Reference vectors: what the generic implementation says of a state, for every result of every generated function.

use super::interpreter::Found;
use crate::prove::evaluation::Instant;
use crate::prove::generic::Generic;
use crate::prove::quantities::{Class, QUANTITIES, Quantity, Scale, Scales, values};
use crate::prove::sampling::{Regime, Sample};
use planar_dynamics::error::Error;
use planar_dynamics::target::Target;
use planar_layout::layout::Layout;
use serde_json::{Value, json};

/// Rounding units that a result computed by sums and products may be off, in natural sizes.
const ROUNDINGS: f64 = 64.0;

/// Rounding units that a pivot relative to its scale may be off.
const PIVOT_ROUNDINGS: f64 = 1024.0;

/// What one result has to be.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The function.
    pub function: String,
    /// Which of its results.
    pub output: String,
    /// Row-major.
    pub values: Vec<f64>,
    /// How many rounding units each element may be off.
    pub sizes: Vec<f64>,
}

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
    instant: Instant,
    /// In the graph's order.
    pub expected: Vec<Expected>,
}

/// Results as the generated functions name them, in the graph's order, with the quantity that each is.
const OUTPUTS: [(&str, &str, &str); 27] = [
    ("forward_dynamics", "base_acceleration", "base_acceleration"),
    ("forward_dynamics", "joint_accelerations", "joint_accelerations"),
    ("forward_dynamics_with_base_wrench", "base_acceleration", "base_acceleration"),
    ("forward_dynamics_with_base_wrench", "joint_accelerations", "joint_accelerations"),
    ("forward_dynamics_with_wrenches", "base_acceleration", "base_acceleration"),
    ("forward_dynamics_with_wrenches", "joint_accelerations", "joint_accelerations"),
    ("mass_matrix", "mass_matrix", "mass_matrix"),
    ("bias", "bias", "bias"),
    ("reduced_dynamics", "generalized_inertia", "generalized_inertia"),
    ("reduced_dynamics", "generalized_bias", "generalized_bias"),
    ("reduced_dynamics", "generalized_jacobian", "generalized_jacobian"),
    ("generalized_jacobian", "generalized_jacobian", "generalized_jacobian"),
    ("end_effector_poses", "end_effector_poses", "end_effector_poses"),
    ("end_effector_jacobian", "end_effector_jacobian", "end_effector_jacobian"),
    ("end_effector_twists", "end_effector_twists", "end_effector_twists"),
    ("body_poses", "body_poses", "body_poses"),
    ("body_twists", "body_twists", "body_twists"),
    ("momentum", "linear_momentum", "linear_momentum"),
    ("momentum", "angular_momentum", "angular_momentum"),
    ("momentum", "kinetic_energy", "kinetic_energy"),
    ("reduced_impact", "impact_matrix", "impact.G"),
    ("reduced_impact", "impact_momentum", "impact.H"),
    ("reduced_impact", "joint_rates_after", "impact.joint_rates_after"),
    ("full_impact", "impact_matrix", "merged mass_matrix"),
    ("full_impact", "impact_momentum", "capture.H"),
    ("full_impact", "base_twist_after", "capture.base_twist_after"),
    ("full_impact", "joint_rates_after", "capture.joint_rates_after"),
];

impl Vectors {
    /// At one random state of a regime that leaves the layout as it is. Numbers of the state have four digits, so that
    /// they can be read; every machine makes the same.
    ///
    /// # Errors
    /// A state that the generic implementation has no answer for.
    pub fn new(layout: &Layout, regime: Regime, index: u64) -> Result<Self, Error> {
        let Sample { instant, .. } = regime.sample(layout, 0, index);
        let mut instant = readable(instant);
        let arms = layout.arms.len();
        instant.base_wrench.get_or_insert([0.0; 3]);
        instant.end_effector_wrenches.get_or_insert_with(|| vec![[0.0; 3]; arms]);
        // impacts are computed where there is a target
        let free = instant.targets.iter().all(Option::is_none);
        if let (Some(first), true) = (instant.targets.first_mut(), free) {
            *first = Some(Target { mass: 10.0, inertia: 0.5, contact: [0.25, -0.125], twist: [0.5, -0.25, 0.125] });
        }
        let torques_alone = Instant { base_wrench: None, end_effector_wrenches: None, ..instant.clone() };
        let base_wrench = Instant { end_effector_wrenches: None, ..instant.clone() };
        let [torques_alone, base_wrench, all] =
            [&torques_alone, &base_wrench, &instant].map(|instant| Quantities::new(layout, instant));
        let (torques_alone, base_wrench, all) = (torques_alone?, base_wrench?, all?);
        let expected = OUTPUTS.into_iter().map(|(function, output, quantity)| {
            let quantities = match function {
                "forward_dynamics" => &torques_alone,
                "forward_dynamics_with_base_wrench" => &base_wrench,
                _ => &all,
            };
            let (values, sizes) = quantities.of(quantity);
            Expected { function: function.to_owned(), output: output.to_owned(), values, sizes }
        });
        let expected = expected.collect();
        Ok(Self { instant, expected })
    }

    /// The inputs of all functions, row-major, by name.
    #[must_use]
    pub fn inputs(&self) -> [(&'static str, Vec<f64>); 11] {
        let Instant { state, joint_torques, base_wrench, end_effector_wrenches, targets } = &self.instant;
        let targets: Vec<_> = targets.iter().map(|target| target.unwrap_or_else(Target::none)).collect();
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

    /// As a graph keeps them: the elements of each input and of each expected result, row-major, in the graph's order. Pivots,
    /// which the generic implementation does not have, are those that were `found`.
    #[must_use]
    pub fn to_json(&self, found: &[Found]) -> Value {
        let inputs: Vec<Value> =
            self.inputs().iter().map(|(name, values)| json!({"name": name, "values": values})).collect();
        let pivot = |found: &Found| Expected {
            function: found.function.clone(),
            output: found.output.clone(),
            values: found.values.clone(),
            sizes: vec![PIVOT_ROUNDINGS; found.values.len()],
        };
        let by_generic = |found: &Found| {
            let same = |e: &&Expected| e.function == found.function && e.output == found.output;
            self.expected.iter().find(same).cloned()
        };
        let expected = found.iter().map(|found| by_generic(found).unwrap_or_else(|| pivot(found)));
        let expected = expected.map(|Expected { function, output, values, sizes }| {
            // two digits of a size are enough
            let sizes: Vec<f64> = sizes.iter().map(|size| format!("{size:.1e}").parse().unwrap_or(*size)).collect();
            json!({"function": function, "output": output, "values": values, "sizes": sizes})
        });
        json!({"inputs": inputs, "expected": expected.collect::<Vec<_>>()})
    }
}

/// Everything that the generic implementation knows of one instant.
struct Quantities {
    values: Vec<Option<Vec<f64>>>,
    scales: Vec<Option<Scale>>,
}

impl Quantities {
    fn new(layout: &Layout, instant: &Instant) -> Result<Self, Error> {
        let sample = Sample { layout: layout.clone(), instant: instant.clone() };
        let values = values(&Generic::new(layout), instant)?;
        let scales = Scales::new(&sample, &values).all();
        Ok(Self { values, scales })
    }

    /// Values and what they may be off; none of a quantity that is not known, which no result equals.
    fn of(&self, name: &str) -> (Vec<f64>, Vec<f64>) {
        if name == "capture.H" {
            return self.capture_momentum();
        }
        let Some((quantity, values, scale)) = self.find(name) else { return (Vec::new(), Vec::new()) };
        let roundings = match quantity.class {
            Class::Polynomial => ROUNDINGS,
            Class::Solved => ROUNDINGS.max(8.0 * scale.condition),
        };
        (values.to_vec(), scale.sizes.iter().map(|size| size * roundings).collect())
    }

    fn find(&self, name: &str) -> Option<(&'static Quantity, &[f64], &Scale)> {
        let place = QUANTITIES.iter().position(|quantity| quantity.name == name)?;
        Some((QUANTITIES.get(place)?, self.values.get(place)?.as_deref()?, self.scales.get(place)?.as_ref()?))
    }

    /// H = G x of the exact capture, with the mass matrix of the merged robot as G.
    fn capture_momentum(&self) -> (Vec<f64>, Vec<f64>) {
        let parts = ["merged mass_matrix", "capture.base_twist_after", "capture.joint_rates_after"];
        let [Some((_, matrix, sizes)), Some((_, base, base_scale)), Some((_, joints, joint_scale))] =
            parts.map(|name| self.find(name))
        else {
            return (Vec::new(), Vec::new());
        };
        let product = |matrix: &[f64], vector: &[f64]| -> Vec<f64> {
            let rows = matrix.chunks(vector.len().max(1));
            rows.map(|row| row.iter().zip(vector).map(|(a, b)| a * b).sum()).collect()
        };
        let values = product(matrix, &[base, joints].concat());
        let sizes = product(&sizes.sizes, &[base_scale.sizes.as_slice(), &joint_scale.sizes].concat());
        (values, sizes.iter().map(|size| size * ROUNDINGS).collect())
    }
}

/// Four digits of every number.
fn readable(mut instant: Instant) -> Instant {
    let round = |x: &mut f64| *x = format!("{x:.3e}").parse().unwrap_or(*x);
    let Instant { state, joint_torques, base_wrench, end_effector_wrenches, targets } = &mut instant;
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
