//! The impact phase: rigid capture, exact and as the paper writes it.

use crate::dynamics::Model;
use crate::error::Error;
use crate::scalar::Real;
use crate::state::State;
use crate::target::Target;
use nalgebra::{Matrix3, Vector3};

/// Where the results of an impact go: joints, and one entry per arm.
#[derive(Debug)]
pub struct After<'a, T> {
    /// rad/s.
    pub joint_rates: &'a mut [T],
    /// [ω, vx, vy] of each target's COM; zeros for an arm without target.
    pub target_twists: &'a mut [[T; 3]],
    /// [n, fx, fy] on the robot at each tip, inertial axes, N m s, N s; zeros for an arm without target.
    pub impulses: &'a mut [[T; 3]],
}

/// The exact impact, in full coordinates: `(M + J_eᵀ N J_e) v_f = M v_i + J_eᵀ J_t⁻ᵀ I_t t_ti`. Returns the base twist.
///
/// Linear and angular momentum of robot and targets together are conserved to rounding, and kinetic energy
/// never grows.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
pub fn exact<T: Real>(
    model: &dyn Model<T>,
    state: &State<'_, T>,
    targets: &[Option<Target<T>>],
    after: &mut After<'_, T>,
) -> Result<[T; 3], Error> {
    let base_twist = model.full_impact(state, targets, after.joint_rates)?;
    let moving = State { base_twist, joint_rates: after.joint_rates, ..*state };
    model.end_effector_twists(&moving, after.target_twists)?;
    release(targets, after)?;
    Ok(base_twist)
}

/// Working space of [`paper`].
#[derive(Debug)]
pub struct Workspace<'a, T> {
    /// joints².
    pub impact_matrix: &'a mut [T],
    /// joints.
    pub impact_momentum: &'a mut [T],
    /// 3 arms × joints.
    pub jacobian: &'a mut [T],
    /// (3 + joints)².
    pub mass_matrix: &'a mut [T],
}

/// The paper's literal equations: (15), (16) for the joint rates, (14) for the targets, and (17), fed with the
/// robot's momentum before the impact, for the base twist that is returned.
///
/// Not momentum-conserving: J maps joint rates to tip twists only without robot momentum, which the impact gives.
/// (17) is read with the base twist `[ω; v]`, so with `[l − c_o × p; p]`.
///
/// # Errors
/// [`Error::Length`], [`Error::NotFinite`], [`Error::Singular`].
pub fn paper<T: Real>(
    model: &dyn Model<T>,
    state: &State<'_, T>,
    targets: &[Option<Target<T>>],
    workspace: &mut Workspace<'_, T>,
    after: &mut After<'_, T>,
) -> Result<[T; 3], Error> {
    let joints = model.joints();
    model.reduced_impact(state, targets, workspace.impact_matrix, workspace.impact_momentum, after.joint_rates)?;
    // (14): t_t = J_t⁻¹ J joint_rates, with the generalized Jacobian
    model.reduced_dynamics(state, workspace.impact_matrix, workspace.impact_momentum, workspace.jacobian)?;
    let rows = workspace.jacobian.chunks_exact(joints.max(1));
    for (value, row) in after.target_twists.as_flattened_mut().iter_mut().zip(rows) {
        *value = dot(row, after.joint_rates);
    }
    release(targets, after)?;
    base_from_momentum(model, state, workspace.mass_matrix, after.joint_rates)
}

/// Eq. (17): the base twist that goes with new joint rates and the robot's momentum of `state`.
fn base_from_momentum<T: Real>(
    model: &dyn Model<T>,
    state: &State<'_, T>,
    mass_matrix: &mut [T],
    joint_rates: &[T],
) -> Result<[T; 3], Error> {
    let before = model.momentum(state)?;
    let [px, py] = before.linear_momentum;
    let [_, x, y] = state.base_pose;
    let about_base = before.angular_momentum - (x * py - y * px);
    model.mass_matrix(&state.base_pose, state.joint_angles, mass_matrix)?;
    let mut inertia = Matrix3::zeros();
    let mut right = Vector3::new(about_base, px, py);
    for (i, row) in mass_matrix.chunks_exact(3 + model.joints()).take(3).enumerate() {
        let (base, joints) = row.split_at(3);
        right[i] -= dot(joints, joint_rates);
        for (j, entry) in base.iter().enumerate() {
            inertia[(i, j)] = *entry;
        }
    }
    let singular = Error::Singular { what: "the base inertia I_b", pivot: 0.0, limit: 0.0 };
    let solution = inertia.cholesky().ok_or(singular)?.solve(&right);
    Ok([solution.x, solution.y, solution.z])
}

/// From tip twists to target twists and impulses, arm by arm.
fn release<T: Real>(targets: &[Option<Target<T>>], after: &mut After<'_, T>) -> Result<(), Error> {
    let expected = targets.len();
    for found in [after.target_twists.len(), after.impulses.len()] {
        if found != expected {
            return Err(Error::Length { quantity: "targets", expected: found, found: expected });
        }
    }
    for ((target, twist), impulse) in targets.iter().zip(after.target_twists.iter_mut()).zip(after.impulses.iter_mut())
    {
        *twist = target.map_or([T::ZERO; 3], |t| t.twist_from_contact(twist));
        *impulse = target.map_or([T::ZERO; 3], |t| t.impulse(twist));
    }
    Ok(())
}

fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::ZERO, |sum, (a, b)| sum + *a * *b)
}
