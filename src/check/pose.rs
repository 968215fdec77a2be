//! Warnings about the final pose of the approach: singular or short of joints, by the generalized Jacobian.

use super::number::short;
use super::warning;
use crate::capture::reduced_matrices::reduced_matrices;
use crate::diagnostic::Warning;
use crate::layout::{Arm, Layout};
use crate::registry;
use crate::scenario::{FinalRates, Scenario, Tracking};
use crate::state::State;
use nalgebra::DMatrix;

/// Smallest singular value over the largest below which a pose is close to singular: joint rates are a hundred times
/// those of other poses.
const SINGULAR: f64 = 0.01;

/// The generalized Jacobian at the final joint angles.
pub(super) struct FinalPose<'a> {
    /// The arms of its rows.
    pub(super) arms: Vec<&'a Arm>,
    /// Whether its rows are the twists that the approach is designed for alone.
    pub(super) is_designed: bool,
    /// Smallest singular value over the largest; translations in units of each arm's reach.
    pub(super) margin: f64,
    /// The same with translations in m, as a run has it.
    pub(super) si_margin: f64,
}

pub(super) fn warnings(scenario: &Scenario) -> Vec<Warning> {
    [too_few_joints(scenario), singular(scenario)].into_iter().flatten().collect()
}

/// The final pose of the end effectors for the twists that they are to have; else of the arms that capture and have the
/// three joints that any twist needs. `None` where there are none, or their Jacobian cannot be computed.
///
/// The singular values do not depend on the base pose, which only rotates the twists.
pub(super) fn final_pose(scenario: &Scenario) -> Option<FinalPose<'_>> {
    if scenario.approach.final_end_effector_poses.is_some() {
        return None; // the run computes the final pose and reports its margin
    }
    let goals = match &scenario.approach.end {
        FinalRates::EndEffectorTwists(goals) => Some(goals),
        FinalRates::Rest | FinalRates::JointRates(_) => None,
    };
    let captures = |i| scenario.targets.iter().flat_map(|target| &target.contacts).any(|touch| touch.arm == i);
    let is_row = |i: usize, arm: &Arm, component: usize| match goals {
        Some(goals) => goals[i][component].is_some(),
        None => captures(i) && arm.links.len() >= 3,
    };
    let arms = scenario.layout.arms.iter().enumerate().filter(|(_, arm)| arm.reach() > 0.0);
    let all = arms.flat_map(|(i, arm)| (0..3).map(move |component| (i, arm, component)));
    let rows: Vec<_> = all.filter(|(i, arm, component)| is_row(*i, arm, *component)).collect();
    // more than there are joints have a warning of their own
    if rows.is_empty() || rows.len() > scenario.layout.joints() {
        return None;
    }
    let (_, jacobian) = reduced(&scenario.layout, &scenario.approach.final_joint_angles)?;
    let margin = |unit: fn(&Arm) -> f64| {
        let scaled = DMatrix::from_fn(rows.len(), jacobian.ncols(), |row, column| {
            let (i, arm, component) = rows[row];
            jacobian[(3 * i + component, column)] / if component == 0 { 1.0 } else { unit(arm) }
        });
        let values = scaled.try_svd(false, false, f64::EPSILON, 1000)?.singular_values;
        Some(if values.max() > 0.0 { values.min() / values.max() } else { 0.0 })
    };
    let (margin, si_margin) = (margin(Arm::reach)?, margin(|_| 1.0)?);
    let mut arms: Vec<_> = rows.iter().map(|(_, arm, _)| *arm).collect();
    arms.dedup_by(|a, b| a.name == b.name);
    Some(FinalPose { arms, is_designed: goals.is_some(), margin, si_margin })
}

fn singular(scenario: &Scenario) -> Option<Warning> {
    let FinalPose { arms, margin, .. } = final_pose(scenario)?;
    let names: Vec<_> = arms.iter().map(|arm| arm.name.as_str()).collect();
    (margin < SINGULAR).then(|| {
        let why = format!(
            "close to a singular pose of {}, where some end effector motions need very high joint rates: the smallest singular \
             value of the generalized Jacobian is {} of the largest, lengths in units of the reach",
            names.join(" and "),
            short(margin)
        );
        let help = "choose bent arms: the end effector of a stretched or folded arm cannot move along the arm";
        warning("approach.final_joint_angles", why, help)
    })
}

fn too_few_joints(scenario: &Scenario) -> Option<Warning> {
    let FinalRates::EndEffectorTwists(twists) = &scenario.approach.end else { return None };
    if matches!(scenario.approach.tracking, Tracking::ResolvedMotionRate { .. }) {
        return None; // its goals are checked arm by arm when they are read
    }
    let joints = scenario.layout.joints();
    let wanted = twists.as_flattened().iter().flatten().count();
    (wanted > joints).then(|| {
        let why = format!("{wanted} numbers to be given by {joints} joints, which can give few such twists");
        let help = "an arm needs three links for any twist of its end effector, two for [vx, vy]; final_joint_rates sets the \
                    rates themselves";
        warning("approach.final_end_effector_twists", why, help)
    })
}

/// Generalized inertia and Jacobian of the robot at rest.
pub(super) fn reduced(layout: &Layout, joint_angles: &[f64]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
    let rest = vec![0.0; layout.joints()];
    let state = State { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates: &rest };
    reduced_matrices(&*registry::generic(layout), &state).ok()
}
