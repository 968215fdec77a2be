//! Random states of the paper's robot with two targets.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::array::from_fn;

/// The inputs of all functions.
#[derive(Clone, Copy, Debug)]
pub struct State<T = f64> {
    pub base_pose: [T; 3],
    pub joint_angles: [T; 6],
    pub base_twist: [T; 3],
    pub joint_rates: [T; 6],
    pub torques: [T; 6],
    pub masses: [T; 2],
    pub inertias: [T; 2],
    pub contacts: [[T; 2]; 2],
    pub twists: [[T; 3]; 2],
}

impl<T> State<T> {
    /// As many states as there are lanes.
    pub fn in_lanes<const N: usize>(states: &[State; N], lanes: impl Fn([f64; N]) -> T) -> Self {
        let each = |number: &dyn Fn(&State) -> f64| lanes(states.each_ref().map(number));
        Self {
            base_pose: from_fn(|i| each(&|s| s.base_pose[i])),
            joint_angles: from_fn(|i| each(&|s| s.joint_angles[i])),
            base_twist: from_fn(|i| each(&|s| s.base_twist[i])),
            joint_rates: from_fn(|i| each(&|s| s.joint_rates[i])),
            torques: from_fn(|i| each(&|s| s.torques[i])),
            masses: from_fn(|i| each(&|s| s.masses[i])),
            inertias: from_fn(|i| each(&|s| s.inertias[i])),
            contacts: from_fn(|i| from_fn(|j| each(&|s| s.contacts[i][j]))),
            twists: from_fn(|i| from_fn(|j| each(&|s| s.twists[i][j]))),
        }
    }
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
