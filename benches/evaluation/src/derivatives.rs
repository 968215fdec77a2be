//! The paper's robot with derivatives of forward dynamics.

planar_capture::include_layout!("dual_arm_3r");

pub use dual_arm_3r::{ForwardDynamicsDerivatives, Model};

use crate::states::State;

/// Accelerations, and their derivatives by position, velocity and forces.
#[inline]
pub fn derivatives(model: &Model<f64>, s: &State) -> ForwardDynamicsDerivatives<f64> {
    model.forward_dynamics_derivatives(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques)
}
