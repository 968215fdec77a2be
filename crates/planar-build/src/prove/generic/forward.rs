//! Accelerations from forces, by one dense solve.

use super::{Generic, GenericState, factor, length, store_split, velocity};
use planar_dynamics::dynamics::{ForwardDynamics, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::state::{Forces, State};
use planar_dynamics::validate::finite_forces;

impl ForwardDynamics<f64> for Generic {
    /// Eq. (1): M v̇ = `[F_b; τ_m]` + `J_eᵀ F_e` − bias.
    fn forward_dynamics(
        &self,
        state: &State<'_, f64>,
        forces: &Forces<'_, f64>,
        joint_accelerations: &mut [f64],
    ) -> Result<[f64; 3], Error> {
        let now = GenericState::new(self, state)?;
        finite_forces(forces)?;
        length("joint_torques", self.joints(), forces.joint_torques.len())?;
        let wrench = forces.base_wrench.unwrap_or([0.0; 3]);
        let mut right = velocity(&wrench, forces.joint_torques) - now.bias();
        if let Some(wrenches) = forces.end_effector_wrenches {
            length("end_effector_wrenches", self.arms(), wrenches.len())?;
            for (arm, wrench) in wrenches.iter().enumerate() {
                right += now.at.arm_jacobian(arm).transpose() * nalgebra::Vector3::from(*wrench);
            }
        }
        let acceleration = factor("the mass matrix M", &now.at.mass_matrix())?.solve(&right);
        store_split(["base_acceleration", "joint_accelerations"], &acceleration, joint_accelerations)
    }
}
