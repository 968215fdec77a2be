//! Many states at once, as structures of arrays.

use crate::Problem;
use crate::states::State;
use planar_capture::batch::{
    Accelerations, Batch, FullImpact, ReducedDynamics, ReducedImpact, States, StatesAfter, Status, Targets,
};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::Model;

/// The states, and places for all results.
pub struct Arrays {
    states: [Vec<f64>; 4],
    torques: Vec<f64>,
    targets: [Vec<f64>; 4],
    base: Vec<f64>,
    joints: Vec<f64>,
    matrices: [Vec<f64>; 2],
    after: [Vec<f64>; 4],
    statuses: Vec<Status>,
}

/// The matrix with a row for each number and a column for each state.
fn matrix<const R: usize>(states: &[State], numbers: impl Fn(&State) -> [f64; R]) -> Vec<f64> {
    (0..R)
        .flat_map(|row| states.iter().map(move |state| (row, state)))
        .map(|(row, state)| numbers(state)[row])
        .collect()
}

impl Arrays {
    pub fn new(states: &[State]) -> Self {
        let rows = |rows: usize| vec![0.0; rows * states.len()];
        let flat = |s: &State| -> [f64; 6] { std::array::from_fn(|i| s.twists[i / 3][i % 3]) };
        Self {
            states: [
                matrix(states, |s| s.base_pose),
                matrix(states, |s| s.joint_angles),
                matrix(states, |s| s.base_twist),
                matrix(states, |s| s.joint_rates),
            ],
            torques: matrix(states, |s| s.torques),
            targets: [
                matrix(states, |s| s.masses),
                matrix(states, |s| s.inertias),
                matrix(states, |s| std::array::from_fn::<_, 4, _>(|i| s.contacts[i / 2][i % 2])),
                matrix(states, flat),
            ],
            base: rows(3),
            joints: rows(6),
            matrices: [rows(36), rows(36)],
            after: [rows(3), rows(6), rows(3), rows(6)],
            statuses: vec![Status::Done; states.len()],
        }
    }

    fn states(states: &[Vec<f64>; 4]) -> States<'_> {
        let [base_poses, joint_angles, base_twists, joint_rates] = states;
        States { base_poses, joint_angles, base_twists, joint_rates }
    }

    fn targets(targets: &[Vec<f64>; 4]) -> Targets<'_> {
        let [masses, inertias, contacts, twists] = targets;
        Targets { masses, inertias, contacts, twists }
    }

    pub fn forward_dynamics(&mut self, model: &Model<f64>) -> Result<(), Error> {
        let mut results = Accelerations { base: &mut self.base, joints: &mut self.joints };
        let states = Self::states(&self.states);
        Batch::new(model).forward_dynamics(&states, &self.torques, &mut results, &mut self.statuses)
    }

    pub fn reduced_dynamics(&mut self, model: &Model<f64>) -> Result<(), Error> {
        let [generalized_inertia, generalized_jacobian] = &mut self.matrices;
        let generalized_bias = &mut self.joints;
        let mut results = ReducedDynamics { generalized_inertia, generalized_bias, generalized_jacobian };
        Batch::new(model).reduced_dynamics(&Self::states(&self.states), &mut results, &mut self.statuses)
    }

    pub fn reduced_impact(&mut self, model: &Model<f64>) -> Result<(), Error> {
        let ([impact_matrix, _], impact_momentum) = (&mut self.matrices, &mut self.after[1]);
        let mut results = ReducedImpact { impact_matrix, impact_momentum, joint_rates_after: &mut self.joints };
        let (states, targets) = (Self::states(&self.states), Self::targets(&self.targets));
        Batch::new(model).reduced_impact(&states, &targets, &mut results, &mut self.statuses)
    }

    pub fn full_impact(&mut self, model: &Model<f64>) -> Result<(), Error> {
        let mut results = FullImpact { base_twists_after: &mut self.base, joint_rates_after: &mut self.joints };
        let (states, targets) = (Self::states(&self.states), Self::targets(&self.targets));
        Batch::new(model).full_impact(&states, &targets, &mut results, &mut self.statuses)
    }

    pub fn step(&mut self, model: &Model<f64>) -> Result<(), Error> {
        let [base_poses, joint_angles, base_twists, joint_rates] = &mut self.after;
        let mut after = StatesAfter { base_poses, joint_angles, base_twists, joint_rates };
        let states = Self::states(&self.states);
        Batch::new(model).runge_kutta_step(&states, &self.torques, 1e-3, &mut after, &mut self.statuses)
    }

    /// Whether all states have the accelerations that the model computes one by one.
    pub fn compare(&mut self, model: &Model<f64>, states: &[State], agreement: f64) -> Result<(), Problem> {
        self.forward_dynamics(model)?;
        for (k, s) in states.iter().enumerate() {
            let expected = model
                .forward_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques)
                .joint_accelerations;
            let size = expected.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
            for (row, expected) in expected.iter().enumerate() {
                let found = self.joints[row * states.len() + k];
                if self.statuses[k] != Status::Done || ((found - expected) / size).abs() > agreement {
                    return Err(format!("batch: {found}, one by one {expected}").into());
                }
            }
        }
        Ok(())
    }
}
