//! The full coordinates: M and `[c_b; c_m]` of eq. (1).

use super::{Configuration, Generic, store_matrix, velocity};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use planar_dynamics::check::store;
use planar_dynamics::dynamics::EquationsOfMotion;
use planar_dynamics::error::Error;
use planar_dynamics::state::State;

impl Generic {
    /// M = Σ Bᵢᵀ Iᵢ Bᵢ.
    pub(super) fn mass_matrix_at(&self, at: &Configuration<'_>) -> DMatrix<f64> {
        let mut mass_matrix = DMatrix::zeros(self.size(), self.size());
        for i in 0..self.bodies.len() {
            let jacobian = at.body_jacobian(i);
            mass_matrix += jacobian.transpose() * self.inertia_of(i) * jacobian;
        }
        mass_matrix
    }

    /// `[c_b; c_m]` = Σ Bᵢᵀ Iᵢ Ḃᵢ v.
    pub(super) fn bias_at(&self, at: &Configuration<'_>, velocity: &DVector<f64>) -> DVector<f64> {
        let mut bias = DVector::zeros(self.size());
        for i in 0..self.bodies.len() {
            let jacobian = at.body_jacobian(i);
            bias += jacobian.transpose() * (self.inertia_of(i) * at.body_jacobian_rate_times(i, velocity));
        }
        bias
    }

    /// `I_i` = diag(inertia, mass, mass).
    fn inertia_of(&self, body: usize) -> Matrix3<f64> {
        let body = &self.bodies[body];
        Matrix3::from_diagonal(&Vector3::new(body.inertia, body.mass, body.mass))
    }
}

impl EquationsOfMotion<f64> for Generic {
    fn mass_matrix(&self, base_pose: &[f64; 3], joint_angles: &[f64], mass_matrix: &mut [f64]) -> Result<(), Error> {
        let at = Configuration::new(self, base_pose, joint_angles)?;
        store_matrix("mass_matrix", &self.mass_matrix_at(&at), mass_matrix)
    }

    fn bias(&self, state: &State<'_, f64>, bias: &mut [f64]) -> Result<(), Error> {
        self.check_state(state)?;
        let at = Configuration::new(self, &state.base_pose, state.joint_angles)?;
        store("bias", self.bias_at(&at, &velocity(&state.base_twist, state.joint_rates)).as_slice(), bias)
    }
}
