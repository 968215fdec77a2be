//! What the model says of a scenario's poses: singular ones.

use super::number::short;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout};
use crate::registry;
use crate::scenario::{FinalRates, Scenario, Tracking};
use crate::state::State;
use nalgebra::DMatrix;

/// Below this part of the largest singular value, the smallest makes joints turn a hundred times as fast as they
/// would elsewhere.
const SINGULAR: f64 = 0.01;
/// The generalized Jacobian at the final joint angles.
pub(super) struct FinalPose<'a> {
    /// The arms looked at.
    pub(super) arms: Vec<&'a Arm>,
    /// Smallest singular value over the largest; translations in units of each arm's reach.
    pub(super) margin: f64,
}

/// What is odd about the final pose.
pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    [short_of_joints(scenario), singular(scenario)].into_iter().flatten().collect()
}

/// The arms whose end effectors are to move or to capture, and that have the joints to move their end effectors any
/// way: they need three. `None` where there are none, or their Jacobian cannot be computed.
///
/// It does not matter where the base is and how it is turned: that turns the twists and leaves the singular values.
pub(super) fn final_pose(scenario: &Scenario) -> Option<FinalPose<'_>> {
    if scenario.approach.final_end_effector_poses.is_some() {
        return None; // it is designed by the run, which says the margin
    }
    let designed = matches!(scenario.approach.end, FinalRates::EndEffectorTwists(_));
    let captures =
        |i| designed || scenario.targets.iter().flat_map(|target| &target.contacts).any(|touch| touch.arm == i);
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

fn singular(scenario: &Scenario) -> Option<Warning> {
    let FinalPose { arms, margin } = final_pose(scenario)?;
    let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
    (margin < SINGULAR).then(|| Warning {
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

fn short_of_joints(scenario: &Scenario) -> Option<Warning> {
    let FinalRates::EndEffectorTwists(twists) = &scenario.approach.end else { return None };
    if matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. }) {
        return None; // wishes are counted arm by arm when they are read
    }
    let joints = scenario.layout.joints();
    let wanted = twists.as_flattened().iter().flatten().count();
    (wanted > joints).then(|| Warning {
        key: "approach.final_end_effector_twists".to_owned(),
        why: format!("{wanted} numbers to be given by {joints} joints, which can give few such twists"),
        help: "an arm needs three links to move its tip any way, two for [vx, vy]; final_joint_rates sets the rates \
               themselves"
            .to_owned(),
    })
}

/// Generalized inertia and Jacobian of the robot at rest.
pub(super) fn reduced(layout: &Layout, joint_angles: &[f64]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let (joints, rows) = (layout.joints(), 3 * layout.arms.len());
    let rest = vec![0.0; joints];
    let state = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates: &rest };
    let (mut inertia, mut bias) = (vec![0.0; joints * joints], vec![0.0; joints]);
    let mut jacobian = vec![0.0; rows * joints];
    registry::generic(layout).reduced_dynamics(&state, &mut inertia, &mut bias, &mut jacobian).ok()?;
    Some((DMatrix::from_row_slice(joints, joints, &inertia), DMatrix::from_row_slice(rows, joints, &jacobian)))
}
