//! Poses, twists and Jacobians.

use super::{Configuration, Generic, store_matrix, velocity};
use nalgebra::{DMatrix, DVector, Vector2};
use planar_dynamics::check::store_rows;
use planar_dynamics::dynamics::{Kinematics, Robot};
use planar_dynamics::error::Error;
use planar_dynamics::state::State;

impl Generic {
    /// `[J_be J_me]` of all arms, one under the other.
    pub(super) fn end_effector_jacobian_at(&self, at: &Configuration<'_>) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(3 * self.arms(), self.size());
        for arm in 0..self.arms() {
            jacobian.rows_mut(3 * arm, 3).copy_from(&at.tip_jacobian(arm));
        }
        jacobian
    }
}

impl Kinematics<f64> for Generic {
    fn end_effector_poses(
        &self,
        base_pose: &[f64; 3],
        joint_angles: &[f64],
        poses: &mut [[f64; 3]],
    ) -> Result<(), Error> {
        let at = Configuration::new(self, base_pose, joint_angles)?;
        let tips: Vec<_> = (0..self.arms()).map(|arm| pose(base_pose, at.tip(arm))).collect();
        store_rows("end_effector_poses", &tips, poses)
    }

    fn end_effector_jacobian(
        &self,
        base_pose: &[f64; 3],
        joint_angles: &[f64],
        jacobian: &mut [f64],
    ) -> Result<(), Error> {
        let at = Configuration::new(self, base_pose, joint_angles)?;
        store_matrix("end_effector_jacobian", &self.end_effector_jacobian_at(&at), jacobian)
    }

    fn end_effector_twists(&self, state: &State<'_, f64>, twists: &mut [[f64; 3]]) -> Result<(), Error> {
        self.check_state(state)?;
        let at = Configuration::new(self, &state.base_pose, state.joint_angles)?;
        let velocity = velocity(&state.base_twist, state.joint_rates);
        let values: Vec<_> = (0..self.arms()).map(|arm| twist(&at.tip_jacobian(arm), &velocity)).collect();
        store_rows("end_effector_twists", &values, twists)
    }

    fn body_poses(&self, base_pose: &[f64; 3], joint_angles: &[f64], poses: &mut [[f64; 3]]) -> Result<(), Error> {
        let at = Configuration::new(self, base_pose, joint_angles)?;
        let values: Vec<_> = (0..self.bodies.len()).map(|body| pose(base_pose, at.body(body))).collect();
        store_rows("body_poses", &values, poses)
    }

    fn body_twists(&self, state: &State<'_, f64>, twists: &mut [[f64; 3]]) -> Result<(), Error> {
        self.check_state(state)?;
        let at = Configuration::new(self, &state.base_pose, state.joint_angles)?;
        let velocity = velocity(&state.base_twist, state.joint_rates);
        let values: Vec<_> = (0..self.bodies.len()).map(|body| twist(&at.body_jacobian(body), &velocity)).collect();
        store_rows("body_twists", &values, twists)
    }
}

/// [yaw, x, y] in the inertial frame.
fn pose(base_pose: &[f64; 3], (yaw, position): (f64, Vector2<f64>)) -> [f64; 3] {
    [yaw, base_pose[1] + position.x, base_pose[2] + position.y]
}

/// B v.
pub(super) fn twist(jacobian: &DMatrix<f64>, velocity: &DVector<f64>) -> [f64; 3] {
    let twist = jacobian * velocity;
    [twist[0], twist[1], twist[2]]
}
