//! Random states of the paper's robot with two targets.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

/// The inputs of all functions.
#[derive(Clone, Copy, Debug, Default)]
pub struct State {
    pub base_pose: [f64; 3],
    pub joint_angles: [f64; 6],
    pub base_twist: [f64; 3],
    pub joint_rates: [f64; 6],
    pub torques: [f64; 6],
    pub masses: [f64; 2],
    pub inertias: [f64; 2],
    pub contacts: [[f64; 2]; 2],
    pub twists: [[f64; 3]; 2],
}

/// The same states for the same number.
pub fn states(count: usize) -> Vec<State> {
    let mut random = ChaCha8Rng::seed_from_u64(2017);
    let mut number = |from: f64, to: f64| random.random_range(from..to);
    let mut state = || State {
        base_pose: [(); 3].map(|()| number(-3.0, 3.0)),
        joint_angles: [(); 6].map(|()| number(-3.0, 3.0)),
        base_twist: [(); 3].map(|()| number(-0.5, 0.5)),
        joint_rates: [(); 6].map(|()| number(-1.0, 1.0)),
        torques: [(); 6].map(|()| number(-10.0, 10.0)),
        masses: [(); 2].map(|()| number(10.0, 50.0)),
        inertias: [(); 2].map(|()| number(1.0, 5.0)),
        contacts: [(); 2].map(|()| [(); 2].map(|()| number(-0.5, 0.5))),
        twists: [(); 2].map(|()| [(); 3].map(|()| number(-0.5, 0.5))),
    };
    (0..count).map(|_| state()).collect()
}
