//! The full coordinates: M and `[c_b; c_m]` of eq. (1).

use super::{Configuration, Generic, GenericState};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

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
