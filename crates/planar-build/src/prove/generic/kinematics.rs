//! Poses, twists and Jacobians.

use super::{Configuration, GenericState};
use nalgebra::{DMatrix, DVector};

impl Configuration<'_> {
    /// [yaw, x, y] of every body's COM.
    pub fn body_poses(&self) -> Vec<[f64; 3]> {
        (0..self.robot.bodies.len()).map(|body| self.pose(self.body(body))).collect()
    }

    /// [yaw, x, y] of every end effector.
    pub fn end_effector_poses(&self) -> Vec<[f64; 3]> {
        (0..self.robot.end_effectors.len()).map(|arm| self.pose(self.end_effector(arm))).collect()
    }

    /// `[J_be J_me]` of all arms, one under the other.
    pub fn end_effector_jacobian(&self) -> DMatrix<f64> {
        let arms = self.robot.end_effectors.len();
        let mut jacobian = DMatrix::zeros(3 * arms, self.robot.size());
        for arm in 0..arms {
            jacobian.rows_mut(3 * arm, 3).copy_from(&self.arm_jacobian(arm));
        }
        jacobian
    }
}

impl GenericState<'_> {
    /// [ω, vx, vy] of every body's COM.
    pub fn body_twists(&self) -> Vec<[f64; 3]> {
        let bodies = 0..self.at.robot.bodies.len();
        bodies.map(|body| twist(&self.at.body_jacobian(body), &self.velocity)).collect()
    }

    /// [ω, vx, vy] of every end effector.
    pub fn end_effector_twists(&self) -> Vec<[f64; 3]> {
        let arms = 0..self.at.robot.end_effectors.len();
        arms.map(|arm| twist(&self.at.arm_jacobian(arm), &self.velocity)).collect()
    }
}

/// B v.
fn twist(jacobian: &DMatrix<f64>, velocity: &DVector<f64>) -> [f64; 3] {
    let twist = jacobian * velocity;
    [twist[0], twist[1], twist[2]]
}
