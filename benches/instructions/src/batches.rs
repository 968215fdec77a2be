//! 64 states at once, in the vectors of the processor.

use super::{ANGLES, POSE, Problem, RATES, TARGETS, TORQUES, TWIST};
use planar_capture::batch::{
    Accelerations, Batch, FullImpact, ReducedDynamics, ReducedImpact, States, Status, Targets,
};
use planar_capture::generated::dual_arm_3r::{ARMS, JOINTS, Model};
use std::hint::black_box;

/// States of a batch.
pub const STATES: usize = 64;

/// Every number as a row of the batch.
pub fn rows(numbers: &[f64]) -> Vec<f64> {
    numbers.iter().flat_map(|number| [*number; STATES]).collect()
}

/// Calls a function of a batch: forward dynamics, if it has no other name.
pub fn call(model: &Model<f64>, function: &str, calls: u32) -> Result<(), Problem> {
    let [poses, angles, twists, rates, torques] = [&POSE[..], &ANGLES, &TWIST, &RATES, &TORQUES].map(rows);
    let states = States { base_poses: &poses, joint_angles: &angles, base_twists: &twists, joint_rates: &rates };
    let [masses, inertias] = [&TARGETS.0, &TARGETS.1].map(|numbers| rows(numbers));
    let (contacts, target_twists) = (rows(TARGETS.2.as_flattened()), rows(TARGETS.3.as_flattened()));
    let targets = Targets { masses: &masses, inertias: &inertias, contacts: &contacts, twists: &target_twists };
    let [mut base, mut joints, mut others] = [3, JOINTS, JOINTS].map(|rows| vec![0.0; rows * STATES]);
    let [mut matrix, mut jacobian] = [JOINTS * JOINTS, 3 * ARMS * JOINTS].map(|rows| vec![0.0; rows * STATES]);
    let batch = Batch::new(model);
    for _ in 0..calls {
        let mut statuses = [Status::Done; STATES];
        let statuses = black_box(&mut statuses);
        match function {
            "reduced_dynamics" => {
                let mut found = ReducedDynamics {
                    generalized_inertia: &mut matrix,
                    generalized_bias: &mut joints,
                    generalized_jacobian: &mut jacobian,
                };
                batch.reduced_dynamics(&states, &mut found, statuses)?;
            }
            "reduced_impact" => {
                let mut found = ReducedImpact {
                    impact_matrix: &mut matrix,
                    impact_momentum: &mut others,
                    joint_rates_after: &mut joints,
                };
                batch.reduced_impact(&states, &targets, &mut found, statuses)?;
            }
            "full_impact" => {
                let mut found = FullImpact { base_twists_after: &mut base, joint_rates_after: &mut joints };
                batch.full_impact(&states, &targets, &mut found, statuses)?;
            }
            "" => {
                let mut found = Accelerations { base: &mut base, joints: &mut joints };
                batch.forward_dynamics(&states, &torques, &mut found, statuses)?;
            }
            other => return Err(format!("there is no function {other} of a batch").into()),
        }
        black_box(&mut joints);
    }
    Ok(())
}
