//! Generalized inertia and generalized Jacobian of the reduced form, eq. (2), as matrices.

use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::state::State;
use nalgebra::DMatrix;

/// The generalized inertia (joints × joints) and the generalized Jacobian (3 arms × joints).
pub(crate) fn reduced_matrices(
    model: &AnyModel<f64>,
    state: &State<'_, f64>,
) -> Result<(DMatrix<f64>, DMatrix<f64>), Error> {
    let (joints, rows) = (model.joints(), 3 * model.arms());
    let (mut inertia, mut bias) = (vec![0.0; joints * joints], vec![0.0; joints]);
    let mut jacobian = vec![0.0; rows * joints];
    model.reduced_dynamics(state, &mut inertia, &mut bias, &mut jacobian)?;
    Ok((DMatrix::from_row_slice(joints, joints, &inertia), DMatrix::from_row_slice(rows, joints, &jacobian)))
}
