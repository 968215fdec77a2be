//! The capture of targets of any mass and inertia beside those of the links.
//!
//! The sum of the inertias of robot and targets loses digits of the lighter, and `I_t (t_tf − t_ti)`, the impulse, is the
//! small difference of large numbers where a target is heavy. The balance of momentum at the contacts loses neither.

use crate::prove::evaluation::{EvaluationInput, Values};
use planar_dynamics::body::Body;
use planar_dynamics::contact::{
    Contact, ContactLaw, ContactPartner, ImpactOutput, balance_length, balance_momentum, bilateral_rows,
};
use planar_dynamics::dynamics::Model;
use planar_dynamics::error::Error;
use planar_dynamics::quantity::Quantity;

/// Replaces the values of the capture by those from the balance of momentum.
///
/// # Errors
/// Those of [`balance_momentum`].
pub fn resolve_capture(model: &dyn Model<f64>, instant: &EvaluationInput, values: &mut Values) -> Result<(), Error> {
    if values.get(Quantity::CaptureImpulses).is_none() {
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
    let mut workspace = vec![0.0; balance_length(joints, arms, bodies.len(), bilateral_rows(&contacts))];
    let (mut joint_rates, mut body_twists) = (vec![0.0; joints], vec![[0.0; 3]; bodies.len()]);
    let mut contact_impulses = vec![[0.0; 3]; contacts.len()];
    let mut after =
        ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut body_twists, impulses: &mut contact_impulses };
    let base_twist = balance_momentum(model, &state, &bodies, &contacts, &mut workspace, &mut after)?;
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
