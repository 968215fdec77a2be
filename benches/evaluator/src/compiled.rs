//! Batches of compiled code.

use crate::Problem;
use crate::states::Arrays;
use planar_build::evaluator::InstructionSet;
use planar_capture::batch::{
    Accelerations, AsBuilt, Avx2, Batch, Detected, FullImpact, Instructions, ReducedDynamics, ReducedImpact, States,
    Status, Targets,
};
use planar_capture::generated::dual_arm_3r::Model;

/// Places for all results.
pub struct Batches {
    model: Model<f64>,
    base: Vec<f64>,
    joints: [Vec<f64>; 2],
    matrices: [Vec<f64>; 2],
    statuses: Vec<Status>,
}

impl Batches {
    pub fn new(count: usize) -> Self {
        let rows = |rows: usize| vec![0.0; rows * count];
        Self {
            model: Model::default(),
            base: rows(3),
            joints: [rows(6), rows(6)],
            matrices: [rows(36), rows(36)],
            statuses: vec![Status::Done; count],
        }
    }

    pub fn call(&mut self, function: &str, set: InstructionSet, inputs: &Arrays) -> Result<(), Problem> {
        match set {
            InstructionSet::Detected => self.with::<Detected>(function, inputs),
            InstructionSet::Avx2 => self.with::<Avx2>(function, inputs),
            InstructionSet::AsBuilt => self.with::<AsBuilt>(function, inputs),
        }
    }

    fn with<I: Instructions>(&mut self, function: &str, inputs: &Arrays) -> Result<(), Problem> {
        let batch = Batch::<_, I>::with_instructions(&self.model);
        let states = States {
            base_poses: inputs.get("base_pose"),
            joint_angles: inputs.get("joint_angles"),
            base_twists: inputs.get("base_twist"),
            joint_rates: inputs.get("joint_rates"),
        };
        let targets = Targets {
            masses: inputs.get("target_masses"),
            inertias: inputs.get("target_inertias"),
            contacts: inputs.get("contacts"),
            twists: inputs.get("target_twists"),
        };
        let Self { base, joints: [first, second], matrices: [matrix, jacobian], statuses, .. } = self;
        match function {
            "forward_dynamics" => {
                let mut results = Accelerations { base, joints: first };
                batch.forward_dynamics(&states, inputs.get("joint_torques"), &mut results, statuses)?;
            }
            "reduced_dynamics" => {
                let mut results = ReducedDynamics {
                    generalized_inertia: matrix,
                    generalized_bias: first,
                    generalized_jacobian: jacobian,
                };
                batch.reduced_dynamics(&states, &mut results, statuses)?;
            }
            "reduced_impact" => {
                let mut results =
                    ReducedImpact { impact_matrix: matrix, impact_momentum: first, joint_rates_after: second };
                batch.reduced_impact(&states, &targets, &mut results, statuses)?;
            }
            _ => {
                let mut results = FullImpact { base_twists_after: base, joint_rates_after: first };
                batch.full_impact(&states, &targets, &mut results, statuses)?;
            }
        }
        Ok(())
    }

    /// The results of a function, in the order of those outputs of the graph that are wanted.
    pub fn results(&self, function: &str) -> Vec<&[f64]> {
        let Self { base, joints: [first, second], matrices: [matrix, jacobian], .. } = self;
        match function {
            "reduced_dynamics" => vec![matrix, first, jacobian],
            "reduced_impact" => vec![matrix, first, second],
            _ => vec![base, first],
        }
    }
}
