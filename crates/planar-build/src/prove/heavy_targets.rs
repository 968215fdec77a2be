//! The capture of targets that are far heavier than the robot, computed at the contacts.
//!
//! The sum of the inertias of robot and targets loses digits of the robot's, and `I_t (t_tf − t_ti)`, the impulse, is the
//! small difference of large numbers. The contact impact has the sum of the inverse inertias, which loses nothing.

use crate::prove::evaluation::{EvaluationInput, Values};
use planar_dynamics::body::Body;
use planar_dynamics::contact::{
    Contact, ContactLaw, ContactPartner, DelassusMatrix, ImpactOutput, impact, workspace_length,
};
use planar_dynamics::dynamics::Model;
use planar_dynamics::error::Error;
use planar_dynamics::quantity::Quantity;

/// A target's momentum over the largest impulse from which the difference has lost too many digits.
const MOST_LOST: f64 = 1e3;

/// Replaces the values of the capture by those of the contact impact where these have more digits.
///
/// # Errors
/// Those of [`impact`].
pub fn resolve_capture(model: &dyn Model<f64>, instant: &EvaluationInput, values: &mut Values) -> Result<(), Error> {
    if !is_lost(instant, values) {
        return Ok(());
    }
    let captured = instant.targets.iter().enumerate().filter_map(|(arm, target)| Some((arm, target.as_ref()?)));
    let (contacts, bodies): (Vec<_>, Vec<_>) = captured
        .enumerate()
        .map(|(i, (arm, target))| {
            let partner = ContactPartner::Body(i);
            let body = Body { mass: target.mass, inertia: target.inertia, pose: [0.0; 3], twist: target.twist };
            (Contact { arm, partner, offset: target.contact, law: ContactLaw::Rigid }, body)
        })
        .unzip();
    let (joints, arms, state) = (model.joints(), model.arms(), instant.state.view());
    let rows = DelassusMatrix::count(&contacts);
    let mut workspace = vec![0.0; workspace_length(joints, arms, bodies.len(), rows)];
    let delassus =
        DelassusMatrix::new(model, &state.base_pose, state.joint_angles, &bodies, &contacts, &mut workspace)?;
    let (mut joint_rates, mut body_twists) = (vec![0.0; joints], vec![[0.0; 3]; bodies.len()]);
    let mut contact_impulses = vec![[0.0; 3]; contacts.len()];
    let mut after =
        ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut body_twists, impulses: &mut contact_impulses };
    let base_twist = impact(model, &state, &bodies, delassus, &mut after)?;
    let (mut twists, mut impulses) = (vec![[0.0; 3]; arms], vec![[0.0; 3]; arms]);
    for ((contact, twist), impulse) in contacts.iter().zip(body_twists).zip(contact_impulses) {
        twists[contact.arm] = twist;
        impulses[contact.arm] = impulse;
    }
    values.set(Quantity::CaptureBaseTwist, &base_twist);
    values.set(Quantity::CaptureJointRates, &joint_rates);
    values.set(Quantity::CaptureTargetTwists, twists.as_flattened());
    values.set(Quantity::CaptureImpulses, impulses.as_flattened());
    Ok(())
}

/// Whether a target's momentum is so much larger than all impulses that its change has not their digits.
fn is_lost(instant: &EvaluationInput, values: &Values) -> bool {
    let [Some(after), Some(impulses)] =
        [Quantity::CaptureTargetTwists, Quantity::CaptureImpulses].map(|quantity| values.get(quantity))
    else {
        return false;
    };
    let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let twists = after.as_chunks::<3>().0;
    let momenta = instant.targets.iter().zip(twists).filter_map(|(target, after)| {
        let target = target.as_ref()?;
        let of = |[spin, vx, vy]: [f64; 3]| (target.inertia * spin.abs()).max(target.mass * largest(&[vx, vy]));
        Some(of(target.twist).max(of(*after)))
    });
    momenta.fold(0.0, f64::max) > MOST_LOST * largest(impulses)
}
