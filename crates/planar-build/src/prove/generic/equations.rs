//! The full coordinates: M and `[c_b; c_m]` of eq. (1), and its accelerations by one dense solve.

use super::{Configuration, Generic, GenericState, factor, length, store_split, velocity};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use planar_dynamics::dynamics::{ForwardDynamics, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::state::{Forces, State};
use planar_dynamics::validate::finite_forces;

impl Configuration<'_> {
    /// M = Σ Bᵢᵀ Iᵢ Bᵢ.
    pub fn mass_matrix(&self) -> DMatrix<f64> {
        let size = self.robot.size();
        let mut mass_matrix = DMatrix::zeros(size, size);
        for i in 0..self.robot.bodies.len() {
            let jacobian = self.body_jacobian(i);
            mass_matrix += jacobian.transpose() * self.robot.inertia_of(i) * jacobian;
        }
        mass_matrix
    }
}

impl GenericState<'_> {
    /// `[c_b; c_m]` = Σ Bᵢᵀ Iᵢ Ḃᵢ v.
    pub fn bias(&self) -> DVector<f64> {
        let Self { at, velocity } = self;
        let mut bias = DVector::zeros(velocity.len());
        for i in 0..at.robot.bodies.len() {
            let force = at.robot.inertia_of(i) * at.body_jacobian_rate_times(i, velocity);
            bias += at.body_jacobian(i).transpose() * force;
        }
        bias
    }
}

impl Generic {
    /// `I_i` = diag(inertia, mass, mass).
    fn inertia_of(&self, body: usize) -> Matrix3<f64> {
        let body = &self.bodies[body];
        Matrix3::from_diagonal(&Vector3::new(body.inertia, body.mass, body.mass))
    }
}

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
                right += now.at.arm_jacobian(arm).transpose() * Vector3::from(*wrench);
            }
        }
        let acceleration = factor("the mass matrix M", &now.at.mass_matrix())?.solve(&right);
        store_split(["base_acceleration", "joint_accelerations"], &acceleration, joint_accelerations)
    }
}
