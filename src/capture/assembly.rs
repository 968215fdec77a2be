//! Robot and targets between two impacts: merged with links, or beside the robot under constraints.
//!
//! # Example
//! ```
//! use planar_capture::capture::assembly::{Assembly, Attachment};
//! use planar_capture::contact::ContactKind;
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::owned::RobotState;
//! use planar_capture::simulate::system::Body;
//!
//! let robot = Box::new(Model::<f64>::default());
//! let (base_twist, joint_angles, joint_rates) = ([0.0, 1.0, 0.0], vec![0.0; 3], vec![0.0; 3]);
//! let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist, joint_rates };
//! let target = Body { mass: 10.0, inertia: 1.0, pose: [0.0, 4.0, 0.0], twist: base_twist };
//! let grasp = Attachment { target: 0, arm: 0, kind: ContactKind::Rigid };
//! let assembly = Assembly::new(robot, &state, &[target], &[grasp])?;
//! assert!(assembly.bodies.is_empty()); // the target is a part of the last link
//! // 530 kg of the robot and 10 kg at 1 m/s
//! let [px, _] = assembly.model.momentum(&state.view())?.linear_momentum;
//! assert!((px - 540.0).abs() < 1e-9);
//! # Ok::<(), planar_capture::error::Error>(())
//! ```

use crate::contact::{Contact, ContactKind, ContactLaw, ContactPartner, LoopConstraint};
use crate::error::Error;
use crate::frames::turned;
use crate::owned::{CloneModel, RobotState};
use crate::simulate::system::{Body, System};
use crate::target::Target;

/// A lasting contact: an end effector that holds a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Index of the target.
    pub target: usize,
    /// Index of the arm.
    pub arm: usize,
    /// Rigid or a pin.
    pub kind: ContactKind,
}

/// How a target is part of the system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TargetPlacement {
    /// A body beside the robot, free or pinned, by its index.
    Separate(usize),
    /// Merged with the last link of an arm.
    Merged {
        /// The arm.
        arm: usize,
        /// COM in the frame of the end effector, m.
        offset: [f64; 2],
        /// Yaw of the target less that of the end effector, rad.
        yaw: f64,
    },
}

/// A robot whose last links are merged with the targets that they hold rigidly, the other targets beside it, and the
/// constraints of closed loops.
///
/// The first rigid attachment of a target merges it with its arm; the others, and pins, are constraints.
pub struct Assembly {
    /// The robot with merged links.
    pub model: Box<dyn CloneModel>,
    /// Targets that are not merged.
    pub bodies: Vec<Body>,
    /// Between end effectors and bodies, or between two end effectors.
    pub constraints: Vec<LoopConstraint<f64>>,
    /// One per target.
    pub places: Vec<TargetPlacement>,
}

impl Assembly {
    /// From the model of the robot without targets, the states of robot and targets, and the attachments.
    ///
    /// # Errors
    /// Those of the model.
    pub fn new(
        mut model: Box<dyn CloneModel>,
        state: &RobotState,
        targets: &[Body],
        attachments: &[Attachment],
    ) -> Result<Self, Error> {
        let mut end_effectors = vec![[0.0; 3]; model.arms()];
        model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut end_effectors)?;
        let mut merged = vec![None; model.arms()];
        let (mut bodies, mut places) = (Vec::new(), Vec::new());
        for (i, target) in targets.iter().enumerate() {
            let rigid = attachments.iter().find(|attachment| attachment.target == i && attachment.kind.holds_yaw());
            places.push(match rigid {
                None => {
                    bodies.push(*target);
                    TargetPlacement::Separate(bodies.len() - 1)
                }
                Some(Attachment { arm, .. }) => {
                    let (end_effector, [yaw, x, y]) = (end_effectors[*arm], target.pose);
                    let Body { mass, inertia, twist, .. } = *target;
                    merged[*arm] =
                        Some(Target { mass, inertia, contact: [end_effector[1] - x, end_effector[2] - y], twist });
                    TargetPlacement::Merged {
                        arm: *arm,
                        offset: rotated([x - end_effector[1], y - end_effector[2]], -end_effector[0]),
                        yaw: yaw - end_effector[0],
                    }
                }
            });
        }
        model.merge(&state.base_pose, &state.joint_angles, &merged)?;
        let mut constraints = Vec::new();
        for attachment in attachments {
            let (partner, pose) = match places[attachment.target] {
                TargetPlacement::Merged { arm, .. } if arm == attachment.arm => continue,
                TargetPlacement::Merged { arm, .. } => (ContactPartner::EndEffector(arm), end_effectors[arm]),
                TargetPlacement::Separate(i) => (ContactPartner::Body(i), bodies[i].pose),
            };
            let contact = Contact {
                arm: attachment.arm,
                partner,
                offset: [0.0; 2],
                law: ContactLaw::new(attachment.kind, Default::default, 0.0),
            };
            constraints.extend(LoopConstraint::new(&contact, &end_effectors[attachment.arm], &pose));
        }
        Ok(Self { model, bodies, constraints, places })
    }

    /// The system of a phase, without joint limits, of a reach of 1 m.
    #[must_use]
    pub fn system(&self) -> System<'_> {
        System { bodies: &self.bodies, constraints: &self.constraints, ..System::alone(&*self.model) }
    }

    /// Those of all targets that are not merged.
    #[must_use]
    pub fn separate(&self, targets: &[Body]) -> Vec<Body> {
        let pairs = targets.iter().zip(&self.places);
        pairs.filter(|(_, place)| matches!(place, TargetPlacement::Separate(_))).map(|(target, _)| *target).collect()
    }

    /// The bodies that end effectors hold, of those beside the robot.
    #[must_use]
    pub fn pinned(&self, bodies: &[Body]) -> Vec<Body> {
        let held = |i: usize| self.constraints.iter().any(|constraint| constraint.partner == ContactPartner::Body(i));
        bodies.iter().enumerate().filter(|(i, _)| held(*i)).map(|(_, body)| *body).collect()
    }

    /// The constraints as contacts, at poses of the end effectors and bodies.
    pub(crate) fn constraint_contacts(&self, end_effectors: &[[f64; 3]], bodies: &[Body]) -> Vec<Contact<f64>> {
        let pose = |partner: ContactPartner| match partner {
            ContactPartner::Body(i) => bodies[i].pose,
            ContactPartner::EndEffector(arm) => end_effectors[arm],
        };
        self.constraints.iter().map(|constraint| constraint.contact(&pose(constraint.partner))).collect()
    }

    /// All targets, from poses and twists of the end effectors and the bodies beside the robot.
    #[must_use]
    pub fn targets(
        &self,
        targets: &[Body],
        end_effectors: &[[f64; 3]],
        end_effector_twists: &[[f64; 3]],
        bodies: &[Body],
    ) -> Vec<Body> {
        let moved = |(target, place): (&Body, &TargetPlacement)| match *place {
            TargetPlacement::Separate(i) => bodies[i],
            TargetPlacement::Merged { arm, offset, yaw } => {
                let [end_effector_yaw, x, y] = end_effectors[arm];
                let [omega, vx, vy] = end_effector_twists[arm];
                let [rx, ry] = rotated(offset, end_effector_yaw);
                Body {
                    pose: [end_effector_yaw + yaw, x + rx, y + ry],
                    twist: [omega, vx - omega * ry, vy + omega * rx],
                    ..*target
                }
            }
        };
        targets.iter().zip(&self.places).map(moved).collect()
    }
}

/// A vector rotated by an angle, rad.
pub(crate) fn rotated(vector: [f64; 2], angle: f64) -> [f64; 2] {
    turned(vector, libm::sincos(angle))
}
