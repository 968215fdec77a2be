//! Positions of the targets and contacts of an impact at the end of the approach, from the poses of the end effectors.
//!
//! # Example
//! ```
//! use planar_capture::capture::contact_at_time::contact_at_time;
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/spinning_target.toml";
//! let scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! // the disc is held at its point [-0.6, 0], so that its centre is 0.6 m beyond the end effector
//! let end_effectors = [[0.0, 1.9, -0.9]];
//! let (targets, contacts) = contact_at_time(&scenario, &scenario.cases[0], &end_effectors);
//! let [_, x, y] = targets[0].pose;
//! assert!((x - 2.5).abs() < 1e-12 && (y + 0.9).abs() < 1e-12);
//! assert!(contacts[0].miss < 1e-12); // one arm meets the point that was planned
//! ```

use crate::capture::assembly::rotated;
use crate::contact::ContactLaw;
use crate::scenario::{Case, PlannedContact, Scenario};
use crate::simulate::system::Body;

/// One contact of an end effector with a target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ImpactContact {
    /// Index of the target.
    pub target: usize,
    /// Index of the arm.
    pub arm: usize,
    /// Rigid, pinned, or bouncing with its normal and restitution.
    pub law: ContactLaw<f64>,
    /// From the COM of the target to the end effector, inertial axes, m.
    pub offset: [f64; 2],
    /// Distance of the end effector from the planned contact point, m; not zero where several end effectors hold one
    /// target, or where the contact is found by detection.
    pub miss: f64,
}

/// The targets at the end of an approach that ends by time, and their contacts: end effectors touch where they are. A
/// target is at its end effector less the planned contact point, or, with several arms, at the mean of these.
///
/// Yaws are the scenario's. A target whose grasps all fail is where its arms would have held it.
#[must_use]
pub fn contact_at_time(
    scenario: &Scenario,
    case: &Case,
    end_effectors: &[[f64; 3]],
) -> (Vec<Body>, Vec<ImpactContact>) {
    let (mut bodies, mut contacts) = (Vec::new(), Vec::new());
    for (i, target) in scenario.targets.iter().enumerate() {
        let planned = || target.contacts.iter().zip(&case.kinds[i]);
        let all_fail = planned().all(|(_, kind)| kind.is_none());
        let positions: Vec<[f64; 2]> = planned()
            .filter(|(_, kind)| all_fail || kind.is_some())
            .map(|(contact, _)| [0, 1].map(|axis| end_effectors[contact.arm][1 + axis] - contact.point[axis]))
            .collect();
        #[allow(clippy::cast_precision_loss, reason = "a few arms")]
        let mean = |axis: usize| positions.iter().map(|position| position[axis]).sum::<f64>() / positions.len() as f64;
        let (x, y) = (mean(0), mean(1));
        let pose = [target.yaw, x, y];
        bodies.push(Body { mass: target.mass, inertia: target.inertia, pose, twist: case.target_twists[i] });
        for (PlannedContact { arm, point, .. }, kind) in planned() {
            let Some(kind) = kind else { continue };
            let normal = || rotated(target.outline.signed_distance(rotated(*point, -target.yaw)).normal, target.yaw);
            let law = ContactLaw::new(*kind, normal, case.restitutions[i]);
            let offset = [end_effectors[*arm][1] - x, end_effectors[*arm][2] - y];
            let miss = libm::hypot(offset[0] - point[0], offset[1] - point[1]);
            contacts.push(ImpactContact { target: i, arm: *arm, law, offset, miss });
        }
    }
    (bodies, contacts)
}

#[cfg(test)]
mod tests;
