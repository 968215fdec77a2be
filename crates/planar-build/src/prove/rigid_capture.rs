//! The capture of targets of any mass and inertia beside those of the links.
//!
//! The sum of the inertias of robot and targets loses digits of the lighter, and `I_t (t_tf − t_ti)`, the impulse, is the
//! small difference of large numbers where a target is heavy. The balance of momentum at the contacts loses neither.
//!
//! # Example
//! ```
//! use planar_build::prove::generic::Generic;
//! use planar_build::prove::rigid_capture::rigid_capture;
//! use planar_dynamics::dynamics::MomentumAndEnergy;
//! use planar_dynamics::state::State;
//! use planar_dynamics::target::Target;
//! use planar_layout::layout::Layout;
//!
//! let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../codegen");
//! let layout = Layout::read(format!("{folder}/layouts/dual_arm_3r.toml").as_ref())?;
//! let robot = Generic::new(&layout);
//! let at_rest = State { base_pose: [0.0; 3], joint_angles: &[0.5; 6], base_twist: [0.0; 3], joint_rates: &[0.0; 6] };
//! let target = Target { mass: 1e6, inertia: 1e5, contact: [-0.3, 0.0], twist: [0.0, -0.1, 0.0] };
//! let after = rigid_capture(&robot, &at_rest, &[Some(target), None])?;
//! // the impulse on the robot, which was at rest, is its momentum
//! let moving = State { base_twist: after.base_twist, joint_rates: &after.joint_rates, ..at_rest };
//! let [_, fx, fy] = after.impulses[0];
//! let [px, py] = robot.momentum(&moving)?.linear_momentum;
//! assert!((fx - px).abs() < 1e-12 * px.abs() && (fy - py).abs() < 1e-12 * px.abs());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::prove::evaluation::{EvaluationInput, Values};
use planar_dynamics::body::Body;
use planar_dynamics::contact::{
    Contact, ContactLaw, ContactPartner, ImpactOutput, balance_length, balance_momentum, bilateral_rows,
};
use planar_dynamics::dynamics::Model;
use planar_dynamics::error::Error;
use planar_dynamics::quantity::Quantity;
use planar_dynamics::state::State;
use planar_dynamics::target::Target;

/// Robot and targets right after a capture.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidCapture {
    /// [ω, vx, vy] of the base COM, rad/s, m/s.
    pub base_twist: [f64; 3],
    /// Arm by arm, rad/s.
    pub joint_rates: Vec<f64>,
    /// [ω, vx, vy] of each target's COM, one per arm; zeros where the arm captures nothing.
    pub target_twists: Vec<[f64; 3]>,
    /// [n, fx, fy] on the robot at each end effector, N m s, N s; zeros where the arm captures nothing.
    pub impulses: Vec<[f64; 3]>,
}

/// Replaces the values of the capture by those from the balance of momentum.
///
/// # Errors
/// Those of [`balance_momentum`].
pub fn resolve_capture(model: &dyn Model<f64>, instant: &EvaluationInput, values: &mut Values) -> Result<(), Error> {
    if values.get(Quantity::CaptureImpulses).is_none() {
        return Ok(());
    }
    let after = rigid_capture(model, &instant.state.view(), &instant.targets)?;
    values.set(Quantity::CaptureBaseTwist, &after.base_twist);
    values.set(Quantity::CaptureJointRates, &after.joint_rates);
    values.set(Quantity::CaptureTargetTwists, after.target_twists.as_flattened());
    values.set(Quantity::CaptureImpulses, after.impulses.as_flattened());
    Ok(())
}

/// The capture of these targets, one per arm, `None` where it captures nothing.
///
/// # Errors
/// Those of [`balance_momentum`].
pub fn rigid_capture(
    model: &dyn Model<f64>,
    state: &State<'_, f64>,
    targets: &[Option<Target<f64>>],
) -> Result<RigidCapture, Error> {
    let captured = targets.iter().enumerate().filter_map(|(arm, target)| Some((arm, target.as_ref()?)));
    let (contacts, bodies): (Vec<_>, Vec<_>) = captured
        .enumerate()
        .map(|(i, (arm, target))| {
            let partner = ContactPartner::Body(i);
            let body = Body { mass: target.mass, inertia: target.inertia, pose: [0.0; 3], twist: target.twist };
            (Contact { arm, partner, offset: target.contact, law: ContactLaw::Rigid }, body)
        })
        .unzip();
    let (joints, arms) = (model.joints(), model.arms());
    let mut workspace = vec![0.0; balance_length(joints, arms, bodies.len(), bilateral_rows(&contacts))];
    let (mut joint_rates, mut body_twists) = (vec![0.0; joints], vec![[0.0; 3]; bodies.len()]);
    let mut contact_impulses = vec![[0.0; 3]; contacts.len()];
    let mut after =
        ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut body_twists, impulses: &mut contact_impulses };
    let base_twist = balance_momentum(model, state, &bodies, &contacts, &mut workspace, &mut after)?;
    let (mut twists, mut impulses) = (vec![[0.0; 3]; arms], vec![[0.0; 3]; arms]);
    for ((contact, twist), impulse) in contacts.iter().zip(body_twists).zip(contact_impulses) {
        twists[contact.arm] = twist;
        impulses[contact.arm] = impulse;
    }
    Ok(RigidCapture { base_twist, joint_rates, target_twists: twists, impulses })
}
