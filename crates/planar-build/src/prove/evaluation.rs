//! Every quantity at one instant, by any model of the robot.

use crate::prove::owned::RobotState;
use planar_dynamics::check::finite;
use planar_dynamics::dynamics::{Model, Momentum};
use planar_dynamics::error::Error;
use planar_dynamics::impact::{self, After};
use planar_dynamics::state::Forces;
use planar_dynamics::target::Target;
use serde_json::{Value, json};

/// Where the robot is, how it moves, what acts on it and what it is about to capture.
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// Pose, angles, twist, rates.
    pub state: RobotState,
    /// N m.
    pub joint_torques: Vec<f64>,
    /// [n, fx, fy] at the base COM, inertial axes; `None` is zero.
    pub base_wrench: Option<[f64; 3]>,
    /// [n, fx, fy] on the robot at each tip, inertial axes; `None` is zero.
    pub end_effector_wrenches: Option<Vec<[f64; 3]>>,
    /// One per arm; `None` where the arm captures nothing.
    pub targets: Vec<Option<Target<f64>>>,
}

/// The quantities that `eval` shows. Matrices are row-major.
#[derive(Clone, Debug, PartialEq)]
pub struct Evaluation {
    /// M, (3 + joints)².
    pub mass_matrix: Vec<f64>,
    /// `[c_b; c_m]`, 3 + joints.
    pub bias: Vec<f64>,
    /// I, joints².
    pub generalized_inertia: Vec<f64>,
    /// c, joints.
    pub generalized_bias: Vec<f64>,
    /// [yaw, x, y] of each tip; the yaw is not wrapped.
    pub end_effector_poses: Vec<[f64; 3]>,
    /// `[J_be J_me]`, 3 arms × (3 + joints).
    pub end_effector_jacobian: Vec<f64>,
    /// J, 3 arms × joints.
    pub generalized_jacobian: Vec<f64>,
    /// [α, ax, ay] of the base COM.
    pub base_acceleration: [f64; 3],
    /// rad/s².
    pub joint_accelerations: Vec<f64>,
    /// Momentum and kinetic energy of the robot.
    pub momentum: Momentum<f64>,
    /// The capture by both models; `None` without a target.
    pub impacts: Option<(ReducedImpact, RigidCapture)>,
}

/// The paper's reduced equations of the impact, (15) and (16).
#[derive(Clone, Debug, PartialEq)]
pub struct ReducedImpact {
    /// G, joints².
    pub impact_matrix: Vec<f64>,
    /// H, joints.
    pub impact_momentum: Vec<f64>,
    /// rad/s.
    pub joint_rates_after: Vec<f64>,
}

/// The exact impact. Per arm: `None` where the arm captures nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidCapture {
    /// [ω, vx, vy] of the base COM.
    pub base_twist_after: [f64; 3],
    /// rad/s.
    pub joint_rates_after: Vec<f64>,
    /// [ω, vx, vy] of each target's COM.
    pub target_twists_after: Vec<Option<[f64; 3]>>,
    /// [n, fx, fy] on the robot at each tip, N m s, N s.
    pub impulses: Vec<Option<[f64; 3]>>,
}

/// Asks a model for every quantity.
///
/// # Errors
/// What the model says of the state, and [`Error::NotFinite`] for a result that overflows.
pub fn evaluate(model: &dyn Model<f64>, instant: &Instant) -> Result<Evaluation, Error> {
    let (joints, arms) = (model.joints(), model.arms());
    let size = 3 + joints;
    let state = instant.state.view();
    let mut result = Evaluation {
        mass_matrix: vec![0.0; size * size],
        bias: vec![0.0; size],
        generalized_inertia: vec![0.0; joints * joints],
        generalized_bias: vec![0.0; joints],
        end_effector_poses: vec![[0.0; 3]; arms],
        end_effector_jacobian: vec![0.0; 3 * arms * size],
        generalized_jacobian: vec![0.0; 3 * arms * joints],
        base_acceleration: [0.0; 3],
        joint_accelerations: vec![0.0; joints],
        momentum: model.momentum(&state)?,
        impacts: None,
    };
    model.mass_matrix(&state.base_pose, state.joint_angles, &mut result.mass_matrix)?;
    model.bias(&state, &mut result.bias)?;
    model.reduced_dynamics(
        &state,
        &mut result.generalized_inertia,
        &mut result.generalized_bias,
        &mut result.generalized_jacobian,
    )?;
    model.end_effector_poses(&state.base_pose, state.joint_angles, &mut result.end_effector_poses)?;
    model.end_effector_jacobian(&state.base_pose, state.joint_angles, &mut result.end_effector_jacobian)?;
    let forces = Forces {
        joint_torques: &instant.joint_torques,
        base_wrench: instant.base_wrench,
        end_effector_wrenches: instant.end_effector_wrenches.as_deref(),
    };
    result.base_acceleration = model.forward_dynamics(&state, &forces, &mut result.joint_accelerations)?;
    if instant.targets.iter().any(Option::is_some) {
        result.impacts = Some((reduced_impact(model, instant)?, rigid_capture(model, instant)?));
    }
    Ok(result)
}

fn reduced_impact(model: &dyn Model<f64>, instant: &Instant) -> Result<ReducedImpact, Error> {
    let joints = model.joints();
    let mut result = ReducedImpact {
        impact_matrix: vec![0.0; joints * joints],
        impact_momentum: vec![0.0; joints],
        joint_rates_after: vec![0.0; joints],
    };
    model.reduced_impact(
        &instant.state.view(),
        &instant.targets,
        &mut result.impact_matrix,
        &mut result.impact_momentum,
        &mut result.joint_rates_after,
    )?;
    Ok(result)
}

fn rigid_capture(model: &dyn Model<f64>, instant: &Instant) -> Result<RigidCapture, Error> {
    let mut joint_rates_after = vec![0.0; model.joints()];
    let mut target_twists = vec![[0.0; 3]; model.arms()];
    let mut impulses = vec![[0.0; 3]; model.arms()];
    let mut after =
        After { joint_rates: &mut joint_rates_after, target_twists: &mut target_twists, impulses: &mut impulses };
    let base_twist_after = impact::exact(model, &instant.state.view(), &instant.targets, &mut after)?;
    finite("target_twists_after", target_twists.as_flattened())?;
    finite("impulses", impulses.as_flattened())?;
    Ok(RigidCapture {
        base_twist_after,
        target_twists_after: per_arm(&instant.targets, &target_twists),
        impulses: per_arm(&instant.targets, &impulses),
        joint_rates_after,
    })
}

impl Evaluation {
    /// By the contract of `eval`: matrices as nested rows, and `null` for an arm that captures nothing.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let joints = self.joint_accelerations.len();
        let size = 3 + joints;
        let mut value = json!({
            "mass_matrix": rows(&self.mass_matrix, size),
            "bias": self.bias,
            "generalized_inertia": rows(&self.generalized_inertia, joints),
            "generalized_bias": self.generalized_bias,
            "end_effector_poses": self.end_effector_poses,
            "end_effector_jacobian": rows(&self.end_effector_jacobian, size),
            "generalized_jacobian": rows(&self.generalized_jacobian, joints),
            "base_acceleration": self.base_acceleration,
            "joint_accelerations": self.joint_accelerations,
            "linear_momentum": self.momentum.linear_momentum,
            "angular_momentum": self.momentum.angular_momentum,
            "kinetic_energy": self.momentum.kinetic_energy,
        });
        if let Some((impact, capture)) = &self.impacts {
            value["impact"] = json!({
                "G": rows(&impact.impact_matrix, joints),
                "H": impact.impact_momentum,
                "joint_rates_after": impact.joint_rates_after,
            });
            value["capture"] = json!({
                "base_twist_after": capture.base_twist_after,
                "joint_rates_after": capture.joint_rates_after,
                "target_twists_after": capture.target_twists_after,
                "impulses": capture.impulses,
            });
        }
        value
    }
}

fn rows(matrix: &[f64], width: usize) -> Vec<&[f64]> {
    matrix.chunks_exact(width.max(1)).collect()
}

/// Values in arm order, `None` where an arm captures nothing.
fn per_arm(targets: &[Option<Target<f64>>], values: &[[f64; 3]]) -> Vec<Option<[f64; 3]>> {
    targets.iter().zip(values).map(|(target, value)| target.map(|_| *value)).collect()
}
