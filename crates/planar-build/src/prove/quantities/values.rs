//! Every quantity of one model at one state, as plain lists of numbers.

use crate::prove::evaluation::{Instant, evaluate};
use crate::prove::owned::CloneModel;
use planar_dynamics::error::Error;
use planar_dynamics::state::Forces;

/// In the order of [`QUANTITIES`](super::QUANTITIES); `None` for those of an impact where there is no target.
///
/// # Errors
/// What the model says of the state.
pub fn values(model: &dyn CloneModel, instant: &Instant) -> Result<Vec<Option<Vec<f64>>>, Error> {
    let (arms, bodies) = (model.arms(), model.joints() + 1);
    let state = instant.state.view();
    let all = evaluate(model, instant)?;
    let mut inertias = vec![[0.0; 2]; bodies];
    model.body_inertias(&mut inertias)?;
    let (mut poses, mut twists) = (vec![[0.0; 3]; bodies], vec![[0.0; 3]; bodies]);
    model.body_poses(&state.base_pose, state.joint_angles, &mut poses)?;
    model.body_twists(&state, &mut twists)?;
    let mut tip_twists = vec![[0.0; 3]; arms];
    model.end_effector_twists(&state, &mut tip_twists)?;
    let mut values = vec![
        Some(inertias.as_flattened().to_vec()),
        Some(poses.as_flattened().to_vec()),
        Some(twists.as_flattened().to_vec()),
        Some(all.end_effector_poses.as_flattened().to_vec()),
        Some(tip_twists.as_flattened().to_vec()),
        Some(all.end_effector_jacobian),
        Some(all.mass_matrix),
        Some(all.bias),
        Some(all.momentum.linear_momentum.to_vec()),
        Some(vec![all.momentum.angular_momentum]),
        Some(vec![all.momentum.kinetic_energy]),
        Some(all.generalized_inertia),
        Some(all.generalized_bias),
        Some(all.generalized_jacobian),
        Some(all.base_acceleration.to_vec()),
        Some(all.joint_accelerations),
    ];
    if let Some((reduced, capture)) = all.impacts {
        let per_arm = |rows: &[Option<[f64; 3]>]| rows.iter().map(|row| row.unwrap_or_default()).collect::<Vec<_>>();
        values.extend([
            Some(reduced.impact_matrix),
            Some(reduced.impact_momentum),
            Some(reduced.joint_rates_after),
            Some(capture.base_twist_after.to_vec()),
            Some(capture.joint_rates_after),
            Some(per_arm(&capture.target_twists_after).as_flattened().to_vec()),
            Some(per_arm(&capture.impulses).as_flattened().to_vec()),
        ]);
        values.extend(merged(model, instant)?.map(Some));
    }
    values.resize(super::QUANTITIES.len(), None);
    Ok(values)
}

/// Inertias, mass matrix and accelerations of the robot that holds its targets.
fn merged(model: &dyn CloneModel, instant: &Instant) -> Result<[Vec<f64>; 4], Error> {
    let (joints, state) = (model.joints(), instant.state.view());
    let mut model = model.clone_box();
    model.merge(&state.base_pose, state.joint_angles, &instant.targets)?;
    let mut inertias = vec![[0.0; 2]; joints + 1];
    model.body_inertias(&mut inertias)?;
    let mut mass_matrix = vec![0.0; (3 + joints) * (3 + joints)];
    model.mass_matrix(&state.base_pose, state.joint_angles, &mut mass_matrix)?;
    let forces = Forces {
        joint_torques: &instant.joint_torques,
        base_wrench: instant.base_wrench,
        end_effector_wrenches: instant.end_effector_wrenches.as_deref(),
    };
    let mut accelerations = vec![0.0; joints];
    let base = model.forward_dynamics(&state, &forces, &mut accelerations)?;
    Ok([inertias.as_flattened().to_vec(), mass_matrix, base.to_vec(), accelerations])
}
