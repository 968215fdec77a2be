//! Random states of the paper's robot with two targets.

use planar_build::evaluator::Order;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// Names and sizes of all inputs.
const INPUTS: [(&str, usize, f64); 9] = [
    ("base_pose", 3, 3.0),
    ("joint_angles", 6, 3.0),
    ("base_twist", 3, 0.5),
    ("joint_rates", 6, 1.0),
    ("joint_torques", 6, 10.0),
    ("target_masses", 2, 50.0),
    ("target_inertias", 2, 5.0),
    ("contacts", 4, 0.5),
    ("target_twists", 6, 0.5),
];

/// The elements of all inputs, instance by instance.
pub struct States {
    count: usize,
    inputs: Vec<Vec<f64>>,
}

/// The inputs in an order.
pub struct Arrays(Vec<Vec<f64>>);

impl States {
    /// The same states for the same number.
    pub fn new(count: usize) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(2017);
        let mut number = |name: &str, size: f64| {
            let from = if name.starts_with("target_m") || name.starts_with("target_i") { 0.2 * size } else { -size };
            random.random_range(from..size)
        };
        let inputs = INPUTS.map(|(name, elements, size)| (0..elements * count).map(|_| number(name, size)).collect());
        Self { count, inputs: inputs.to_vec() }
    }

    pub fn arrays(&self, order: Order) -> Arrays {
        let transposed = |(numbers, (_, elements, _)): (&Vec<f64>, (&str, usize, f64))| match order {
            Order::Instances => numbers.clone(),
            Order::Elements => (0..elements * self.count)
                .map(|place| numbers[place % self.count * elements + place / self.count])
                .collect(),
        };
        Arrays(self.inputs.iter().zip(INPUTS).map(transposed).collect())
    }

    /// The elements of an input of one instance.
    pub fn of(&self, name: &str, instance: usize) -> &[f64] {
        let (position, elements) = place(name);
        &self.inputs[position][instance % self.count * elements..][..elements]
    }
}

impl Arrays {
    pub fn get(&self, name: &str) -> &[f64] {
        &self.0[place(name).0]
    }
}

fn place(name: &str) -> (usize, usize) {
    let found = INPUTS.iter().position(|(input, ..)| *input == name);
    let position = found.unwrap_or_else(|| panic!("no input is called {name}"));
    (position, INPUTS[position].1)
}
