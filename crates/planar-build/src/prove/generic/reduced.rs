//! The reduced coordinates of eq. (2): the base eliminated block by block.

use super::{Configuration, Generic, GenericState, factor, store_matrix};
use nalgebra::{DMatrix, DVector};
use planar_dynamics::dynamics::{ReducedDynamics, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;
use planar_dynamics::validate::store;

/// I and J at one configuration, with `I_b⁻¹` ready for the bias.
pub struct Reduced {
    /// I = `I_m − I_bmᵀ I_b⁻¹ I_bm`.
    pub inertia: DMatrix<f64>,
    /// J = `J_me − J_be I_b⁻¹ I_bm`.
    pub jacobian: DMatrix<f64>,
    /// `I_b⁻¹ I_bm`.
    base_from_joints: DMatrix<f64>,
}

impl Reduced {
    /// c = `c_m − I_bmᵀ I_b⁻¹ c_b`.
    fn bias(&self, bias: &DVector<f64>) -> DVector<f64> {
        let joints = bias.len() - 3;
        bias.rows(3, joints) - self.base_from_joints.transpose() * bias.rows(0, 3)
    }
}

impl Generic {
    /// The blocks of M = [`I_b` `I_bm`; `I_bmᵀ` `I_m`] and of the Jacobian, put together as the paper has it.
    pub(super) fn reduced_at(&self, at: &Configuration<'_>) -> Result<Reduced, Error> {
        let joints = self.joints();
        let mass_matrix = at.mass_matrix();
        let base = mass_matrix.view((0, 0), (3, 3)).into_owned();
        let coupling = mass_matrix.view((0, 3), (3, joints)).into_owned();
        let arms = mass_matrix.view((3, 3), (joints, joints));
        let jacobian = at.end_effector_jacobian();
        let (of_base, of_joints) = jacobian.columns_range_pair(0..3, 3..);
        let base_from_joints = factor("the base inertia I_b", &base)?.solve(&coupling);
        Ok(Reduced {
            inertia: arms - coupling.transpose() * &base_from_joints,
            jacobian: of_joints - of_base * &base_from_joints,
            base_from_joints,
        })
    }
}

impl ReducedDynamics<f64> for Generic {
    fn reduced_dynamics(
        &self,
        state: &State<'_, f64>,
        generalized_inertia: &mut [f64],
        generalized_bias: &mut [f64],
        generalized_jacobian: &mut [f64],
    ) -> Result<(), Error> {
        let now = GenericState::new(self, state)?;
        let reduced = self.reduced_at(&now.at)?;
        store_matrix("generalized_inertia", &reduced.inertia, generalized_inertia)?;
        store("generalized_bias", reduced.bias(&now.bias()).as_slice(), generalized_bias)?;
        store_matrix("generalized_jacobian", &reduced.jacobian, generalized_jacobian)
    }
}
