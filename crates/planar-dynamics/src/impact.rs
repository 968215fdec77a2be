//! Rigid capture of targets: the exact impact in full coordinates, and the paper's equations (14) to (17).
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::impact::{RigidImpactOutput, exact};
//! use planar_dynamics::state::State;
//! use planar_dynamics::target::Target;
//!
//! let (robot, pose, angles) = (Model::<f64>::default(), [0.0; 3], [0.5; JOINTS]);
//! let at_rest = State { base_pose: pose, joint_angles: &angles, base_twist: [0.0; 3], joint_rates: &[0.0; JOINTS] };
//! let target = Target { mass: 20.0, inertia: 3.0, contact: [-0.3, 0.0], twist: [0.5, -0.1, 0.0] };
//! let (mut joint_rates, mut target_twists, mut impulses) = ([0.0; JOINTS], [[0.0; 3]; 2], [[0.0; 3]; 2]);
//! let mut after = RigidImpactOutput {
//!     joint_rates: &mut joint_rates,
//!     target_twists: &mut target_twists,
//!     impulses: &mut impulses,
//! };
//! let base_twist = exact(&robot, &at_rest, &[Some(target), None], &mut after)?;
//! // robot and target together have the momentum that the target had
//! let of_robot = robot.momentum(&pose, &angles, &base_twist, &joint_rates).linear_momentum[0];
//! assert!((of_robot + 20.0 * target_twists[0][1] - 20.0 * -0.1).abs() < 1e-12);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

use crate::dynamics::Model;
use crate::error::Error;
use crate::linear::{dot, matrix_rows};
use crate::momentum_equation::MomentumEquation;
use crate::scalar::Real;
use crate::state::State;
use crate::target::Target;
use crate::validate::{finite, length};

/// Buffers for the velocities after an impact and its impulses: one entry per joint, or per arm.
#[derive(Debug)]
pub struct RigidImpactOutput<'a, T> {
    /// rad/s.
    pub joint_rates: &'a mut [T],
    /// [ω, vx, vy] of each target's COM; zeros for an arm without a target.
    pub target_twists: &'a mut [[T; 3]],
    /// [n, fx, fy] on the robot at each end effector, inertial axes, N m s, N s; zeros for an arm without a target.
    pub impulses: &'a mut [[T; 3]],
}

/// The exact impact, in full coordinates: `(M + J_eᵀ N J_e) v_f = M v_i + J_eᵀ J_t⁻ᵀ I_t t_ti`. Returns the base twist.
///
/// Linear and angular momentum of robot and targets together are conserved to rounding; the kinetic energy does not
/// increase.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
pub fn exact<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    state: &State<'_, T>,
    targets: &[Option<Target<T>>],
    after: &mut RigidImpactOutput<'_, T>,
) -> Result<[T; 3], Error> {
    let base_twist = model.full_impact(state, targets, after.joint_rates)?;
    let moving = State { base_twist, joint_rates: after.joint_rates, ..*state };
    model.end_effector_twists(&moving, after.target_twists)?;
    fill_target_results(targets, after)?;
    Ok(base_twist)
}

/// Working space of [`paper`].
#[derive(Debug)]
pub struct PaperImpactWorkspace<'a, T> {
    /// joints².
    pub impact_matrix: &'a mut [T],
    /// joints.
    pub impact_momentum: &'a mut [T],
    /// 3 arms × joints.
    pub jacobian: &'a mut [T],
    /// (3 + joints)².
    pub mass_matrix: &'a mut [T],
}

/// The paper's equations as printed: (15), (16) for the joint rates, (14) for the targets, and (17) with the robot's
/// momentum before the impact. Returns the base twist.
///
/// They do not conserve momentum: J maps joint rates to end effector twists only for a robot without momentum, and the
/// impact changes its momentum.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
pub fn paper<T: Real, M: Model<T> + ?Sized>(
    model: &M,
    state: &State<'_, T>,
    targets: &[Option<Target<T>>],
    workspace: &mut PaperImpactWorkspace<'_, T>,
    after: &mut RigidImpactOutput<'_, T>,
) -> Result<[T; 3], Error> {
    let joints = model.joints();
    model.reduced_impact(state, targets, workspace.impact_matrix, workspace.impact_momentum, after.joint_rates)?;
    // eq. (14): t_t = J_t⁻¹ J θ̇, with the generalized Jacobian
    model.reduced_dynamics(state, workspace.impact_matrix, workspace.impact_momentum, workspace.jacobian)?;
    let rows = matrix_rows(workspace.jacobian, joints);
    for (value, row) in after.target_twists.as_flattened_mut().iter_mut().zip(rows) {
        *value = dot(row, &*after.joint_rates);
    }
    fill_target_results(targets, after)?;
    let before = model.momentum(state)?;
    let [px, py] = before.linear_momentum;
    model.mass_matrix(&state.base_pose, state.joint_angles, workspace.mass_matrix)?;
    let equation = MomentumEquation::new(workspace.mass_matrix, joints)?;
    let base_twist = equation.base_twist([before.angular_momentum, px, py], &state.base_pose, after.joint_rates);
    finite("base_twist", &base_twist)?;
    Ok(base_twist)
}

/// Replaces the end effectors' twists by those of the targets, and fills the impulses.
fn fill_target_results<T: Real>(
    targets: &[Option<Target<T>>],
    after: &mut RigidImpactOutput<'_, T>,
) -> Result<(), Error> {
    length("target_twists", targets.len(), after.target_twists.len())?;
    length("impulses", targets.len(), after.impulses.len())?;
    let results = after.target_twists.iter_mut().zip(after.impulses.iter_mut());
    for (target, (twist, impulse)) in targets.iter().zip(results) {
        *twist = target.map_or([T::ZERO; 3], |t| t.twist_from_contact(twist));
        *impulse = target.map_or([T::ZERO; 3], |t| t.impulse(twist));
    }
    // of finite velocities they may overflow, and where a twist does, so does its impulse or is none
    finite("impulses", after.impulses.as_flattened())
}
