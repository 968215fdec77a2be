//! The response of robot and target to a contact: extended inverse inertia, effective masses, impulse index and
//! ellipse.
//!
//! # Example
//! ```
//! use planar_capture::capture::{contact_at_time::ImpactContact, contact_response::response};
//! use planar_capture::contact::ContactLaw;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::system::Body;
//!
//! // a stretched arm along x, at rest, and a target that comes along the same line
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates };
//! let target = Body { mass: 10.0, inertia: 1.0, pose: [0.0, 4.0, 0.0], twist: [0.0, -0.2, 0.0] };
//! let touch = ImpactContact { target: 0, arm: 0, law: ContactLaw::Pin, offset: [-0.5, 0.0], miss: 0.0 };
//! let found = response(&Model::<f64>::default(), &state, &target, &touch)?;
//! let masses = found.effective_masses.expect("a relative velocity");
//! // along the arm the whole robot of 530 kg is pushed; of both together the reciprocals are added
//! for (mass, expected) in masses.into_iter().zip([530.0, 10.0, 5300.0 / 540.0]) {
//!     assert!((mass - expected).abs() < 1e-9);
//! }
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::capture::contact_at_time::ImpactContact;
use crate::contact::{ImpulseEllipse, InverseInertia};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::owned::RobotState;
use crate::simulate::system::Body;

/// The response before an impact to one contact alone, as if there were no other.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactResponse {
    /// [ω, vx, vy] of the end effector relative to the contact point of the target.
    pub relative_twist: [f64; 3],
    /// The direction of the effective masses: the normal of a bounce, else that of the relative velocity; `None` where
    /// that is zero, but for errors of the integration.
    pub direction: Option<[f64; 2]>,
    /// Of the end effector: Yoshida & Sashida's extended inverse inertia tensor.
    pub inverse_inertia: InverseInertia<f64>,
    /// Along the direction, kg: of the robot at its end effector, of the target at its contact point, of both together.
    pub effective_masses: Option<[f64; 3]>,
    /// Magnitude of the impulse, N s, that stops a closing speed of 1 m/s along the direction at a point contact
    /// without restitution.
    pub impulse_index: Option<f64>,
    /// The same impulses over all directions.
    pub impulse_ellipse: ImpulseEllipse<f64>,
}

/// The relative velocity of two points has a direction where it is more than this part of their speeds, which are relative
/// to the base: less is of the errors of an integration that is to bring them to the same velocity.
const LEAST_PART: f64 = 1e-6;

/// The response of one contact.
///
/// # Errors
/// Those of the model.
pub fn response(
    model: &AnyModel<f64>,
    before: &RobotState,
    target: &Body,
    touch: &ImpactContact,
) -> Result<ContactResponse, Error> {
    let mut end_effectors = vec![[0.0; 3]; model.arms()];
    model.end_effector_twists(&before.view(), &mut end_effectors)?;
    let [end_effector_omega, end_effector_x, end_effector_y] = end_effectors[touch.arm];
    let ([omega, vx, vy], [rx, ry]) = (target.twist, touch.offset);
    let [target_x, target_y] = [vx - omega * ry, vy + omega * rx];
    let relative = [end_effector_omega - omega, end_effector_x - target_x, end_effector_y - target_y];
    let speed = libm::hypot(relative[1], relative[2]);
    let [_, base_x, base_y] = before.base_twist;
    let from_base = |x: f64, y: f64| libm::hypot(x - base_x, y - base_y);
    let speeds = from_base(end_effector_x, end_effector_y) + from_base(target_x, target_y);
    let along_velocity = || (speed > LEAST_PART * speeds).then(|| [relative[1] / speed, relative[2] / speed]);
    let direction = touch.law.bounce().map(|(normal, _)| normal).or_else(along_velocity);
    let (pose, angles) = (&before.base_pose, &before.joint_angles);
    let mut scratch = vec![0.0; 2 * model.joints()];
    let of_end_effector =
        InverseInertia::of_end_effector(model, pose, angles, touch.arm, &mut end_effectors, &mut scratch)?;
    let of_target = InverseInertia::of_body(target.mass, target.inertia, touch.offset);
    let of_both = of_end_effector.plus(&of_target);
    let masses = |along: &[f64; 2]| [of_end_effector, of_target, of_both].map(|inertia| inertia.effective_mass(along));
    let index = |along: &[f64; 2]| {
        let [fx, fy] = match touch.law.bounce() {
            // a bounce has no tangential impulse
            Some(_) => along.map(|part| part * of_both.effective_mass(along)),
            None => of_both.stopping_impulse(along),
        };
        libm::hypot(fx, fy)
    };
    Ok(ContactResponse {
        relative_twist: relative,
        direction,
        inverse_inertia: of_end_effector,
        effective_masses: direction.as_ref().map(masses),
        impulse_index: direction.as_ref().map(index),
        impulse_ellipse: of_both.impulse_ellipse(),
    })
}

#[cfg(test)]
mod tests;
