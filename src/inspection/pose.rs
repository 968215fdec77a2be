//! What the model says of a scenario's poses: singular ones, and joints too stiff for the time step.

use super::number::short;
use crate::diagnostic::Oddity;
use crate::layout::{Arm, Layout};
use crate::models;
use crate::scenario::{EndRates, Scenario, Tracking};
use crate::state::State;
use nalgebra::{Cholesky, DMatrix, DVector};

/// Below this part of the largest singular value, the smallest makes joints turn a hundred times as fast as they
/// would elsewhere.
const SINGULAR: f64 = 0.01;
/// In times of the fastest mode. The audit of the paper's study objects from 0.3 on; beyond 2.8 Runge–Kutta steps of
/// fourth order are unstable.
const COARSE: f64 = 0.5;
/// A step so long keeps the audit's bounds by far.
const FINE: f64 = 0.2;

/// The generalized Jacobian at the final joint angles.
pub(super) struct FinalPose<'a> {
    /// The arms looked at.
    pub(super) arms: Vec<&'a Arm>,
    /// Smallest singular value over the largest; translations in units of each arm's reach.
    pub(super) margin: f64,
}

/// What is odd about the final pose and the gains.
pub(super) fn oddities(scenario: &Scenario) -> Vec<Oddity> {
    [short_of_joints(scenario), singular(scenario), coarse(scenario), seldom(scenario)].into_iter().flatten().collect()
}

/// The arms whose tips are to move or to capture, and that have the joints to move their tips any way: they need three.
/// `None` where there are none, or their Jacobian cannot be computed.
///
/// It does not matter where the base is and how it is turned: that turns the twists and leaves the singular values.
pub(super) fn final_pose(scenario: &Scenario) -> Option<FinalPose<'_>> {
    if scenario.approach.final_end_effector_poses.is_some() {
        return None; // it is designed by the run, which says the margin
    }
    let designed = matches!(scenario.approach.end, EndRates::EndEffectorTwists(_));
    let captures =
        |i| designed || scenario.targets.iter().flat_map(|target| &target.touches).any(|touch| touch.arm == i);
    let arms = scenario.layout.arms.iter().enumerate();
    let arms: Vec<_> = arms.filter(|(i, arm)| captures(*i) && arm.links.len() >= 3 && arm.reach() > 0.0).collect();
    let (_, jacobian) = reduced(&scenario.layout, &scenario.approach.final_joint_angles)?;
    let rows: Vec<_> = arms.iter().flat_map(|(i, arm)| (0..3).map(move |row| (3 * i + row, row, arm))).collect();
    if rows.is_empty() {
        return None;
    }
    let scaled = DMatrix::from_fn(rows.len(), jacobian.ncols(), |row, column| {
        rows.get(row).map_or(0.0, |(from, component, arm)| {
            let unit = if *component == 0 { 1.0 } else { arm.reach() };
            jacobian[(*from, column)] / unit
        })
    });
    let values = scaled.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
    let margin = if values.max() > 0.0 { values.min() / values.max() } else { 0.0 };
    Some(FinalPose { arms: arms.into_iter().map(|(_, arm)| arm).collect(), margin })
}

fn singular(scenario: &Scenario) -> Option<Oddity> {
    let FinalPose { arms, margin } = final_pose(scenario)?;
    let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
    (margin < SINGULAR).then(|| Oddity {
        key: "approach.final_joint_angles".to_owned(),
        why: format!(
            "close to a singular pose of {}, where some tip motions take very high joint rates: the smallest singular \
             value of the generalized Jacobian is {} of the largest",
            names.join(" and "),
            short(margin)
        ),
        help: "bend the elbows: stretched and folded arms cannot move their tips along themselves".to_owned(),
    })
}

fn short_of_joints(scenario: &Scenario) -> Option<Oddity> {
    let EndRates::EndEffectorTwists(twists) = &scenario.approach.end else { return None };
    if matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. }) {
        return None; // wishes are counted arm by arm when they are read
    }
    let joints = scenario.layout.joints();
    (3 * twists.len() > joints).then(|| Oddity {
        key: "approach.final_end_effector_twists".to_owned(),
        why: format!("{} numbers to be given by {joints} joints, which can give few such twists", 3 * twists.len()),
        help: "an arm needs three links to move its tip any way; final_joint_rates sets the rates themselves"
            .to_owned(),
    })
}

/// 1/s: how fast the fastest joint motion under the control law goes. Computed torque makes it that of its gains, and so
/// does resolved motion rate control away from singular poses; under PD control it is, at the initial or the final pose, that of
///
/// `I θ̈ = −Kd θ̇ − Kp θ` with the generalized inertia I: the largest of the damping rates, eigenvalues of I⁻¹ Kd, and
/// the natural frequencies, roots of those of I⁻¹ Kp.
pub(super) fn fastest_mode(scenario: &Scenario) -> Option<f64> {
    let (proportional_gain, derivative_gain) = match &scenario.approach.tracking {
        Tracking::Exact => return None,
        Tracking::ResolvedMotionRate { pose_gain, rate_gain, .. } => return Some(pose_gain.max(*rate_gain)),
        Tracking::ProportionalDerivative { proportional_gain, derivative_gain } => (proportional_gain, derivative_gain),
        Tracking::ComputedTorque { proportional_gain, derivative_gain } => {
            let largest = |gains: &[f64]| gains.iter().copied().fold(0.0, f64::max);
            return Some(largest(derivative_gain).max(largest(proportional_gain).sqrt()));
        }
    };
    let poses = [&scenario.initial.joint_angles, &scenario.approach.final_joint_angles];
    let modes = poses.into_iter().filter_map(|angles| {
        let (inertia, _) = reduced(&scenario.layout, angles)?;
        let factor = Cholesky::new(inertia)?;
        let damping = largest_eigenvalue(&factor, derivative_gain)?;
        Some(damping.max(largest_eigenvalue(&factor, proportional_gain)?.sqrt()))
    });
    modes.reduce(f64::max)
}

/// Of `I⁻¹ diag(gains)`, with I = L Lᵀ: the same as of `L⁻¹ diag(gains) L⁻ᵀ`, which is symmetric.
fn largest_eigenvalue(factor: &Cholesky<f64, nalgebra::Dyn>, gains: &[f64]) -> Option<f64> {
    let half = factor
        .l()
        .solve_lower_triangular(&DMatrix::from_diagonal(&DVector::from_column_slice(gains).map(f64::sqrt)))?;
    let values = half.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
    Some(values.max().powi(2))
}

fn coarse(scenario: &Scenario) -> Option<Oddity> {
    let (step, rate) = (scenario.approach.step, fastest_mode(scenario)?);
    (step * rate > COARSE).then(|| Oddity {
        key: "approach.step".to_owned(),
        why: format!(
            "a step of {} s, while the fastest joint motion under these gains decays or swings within {} s",
            short(step),
            short(1.0 / rate)
        ),
        help: format!("a step of {} s or less resolves it; or smaller gains", short(FINE / rate)),
    })
}

/// Torques that are held for longer than the motion that they should steer takes.
fn seldom(scenario: &Scenario) -> Option<Oddity> {
    let Scenario { approach, .. } = scenario;
    let (steps, rate) = (approach.actuation.steps_per_sample?, fastest_mode(scenario)?);
    let sample_time = f64::from(steps) * approach.step;
    (sample_time * rate > COARSE && approach.step * rate <= COARSE).then(|| Oddity {
        key: "approach.sample_time".to_owned(),
        why: format!(
            "torques are held for {} s, while the fastest joint motion under these gains decays or swings within {} s",
            short(sample_time),
            short(1.0 / rate)
        ),
        help: format!("a sample time of {} s or less keeps up with it; or smaller gains", short(FINE / rate)),
    })
}

/// Generalized inertia and Jacobian of the robot at rest.
fn reduced(layout: &Layout, joint_angles: &[f64]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let (joints, rows) = (layout.joints(), 3 * layout.arms.len());
    let rest = vec![0.0; joints];
    let state = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates: &rest };
    let (mut inertia, mut bias) = (vec![0.0; joints * joints], vec![0.0; joints]);
    let mut jacobian = vec![0.0; rows * joints];
    models::generic(layout).reduced_dynamics(&state, &mut inertia, &mut bias, &mut jacobian).ok()?;
    Some((DMatrix::from_row_slice(joints, joints, &inertia), DMatrix::from_row_slice(rows, joints, &jacobian)))
}
