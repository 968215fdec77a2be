//! Robot and targets as they hang together between two impacts.

use crate::contact::{Contact, ContactKind, ContactLaw, ContactPartner, LoopConstraint};
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::simulate::system::{Body, System};
use crate::target::Target;

/// A contact that lasts: an end effector that holds a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Attachment {
    /// Index of the target.
    pub target: usize,
    /// Index of the arm.
    pub arm: usize,
    /// Rigid or a pin.
    pub kind: ContactKind,
}

/// How a target is part of what moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TargetPlacement {
    /// A body beside the robot, free or pinned, by its index.
    Beside(usize),
    /// One with the last link of an arm.
    Merged {
        /// The arm.
        arm: usize,
        /// COM in the frame of the end effector, m.
        offset: [f64; 2],
        /// Yaw of the target less that of the end effector, rad.
        yaw: f64,
    },
}

/// A robot whose last links are one with what they hold rigidly, the other targets beside it, and the holds that close
/// loops.
///
/// Of the rigid attachments on a target the first makes it one with its arm; all others, and pins, are closures.
pub struct Assembly {
    /// The robot, with what its links have become.
    pub model: Box<dyn CloneModel>,
    /// Targets that are no part of a link.
    pub bodies: Vec<Body>,
    /// Holds between end effectors and bodies, or end effectors and end effectors.
    pub constraints: Vec<LoopConstraint<f64>>,
    /// Where each target is.
    pub places: Vec<TargetPlacement>,
}

impl Assembly {
    /// From the robot as it is without targets, the targets as they are now, and what holds them.
    ///
    /// # Errors
    /// What the model says.
    pub fn new(
        mut model: Box<dyn CloneModel>,
        motion: &RobotState,
        targets: &[Body],
        attachments: &[Attachment],
    ) -> Result<Self, Error> {
        let mut end_effectors = vec![[0.0; 3]; model.arms()];
        model.end_effector_poses(&motion.base_pose, &motion.joint_angles, &mut end_effectors)?;
        let mut merged = vec![None; model.arms()];
        let (mut bodies, mut places) = (Vec::new(), Vec::new());
        for (i, target) in targets.iter().enumerate() {
            let rigid = attachments.iter().find(|attachment| attachment.target == i && attachment.kind.holds_yaw());
            places.push(match rigid {
                None => {
                    bodies.push(*target);
                    TargetPlacement::Beside(bodies.len() - 1)
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
        model.merge(&motion.base_pose, &motion.joint_angles, &merged)?;
        let mut constraints = Vec::new();
        for attachment in attachments {
            let (other, pose) = match places[attachment.target] {
                TargetPlacement::Merged { arm, .. } if arm == attachment.arm => continue,
                TargetPlacement::Merged { arm, .. } => (ContactPartner::EndEffector(arm), end_effectors[arm]),
                TargetPlacement::Beside(i) => (ContactPartner::Body(i), bodies[i].pose),
            };
            let contact = Contact {
                arm: attachment.arm,
                other,
                offset: [0.0; 2],
                law: ContactLaw::new(attachment.kind, Default::default, 0.0),
            };
            constraints.extend(LoopConstraint::new(&contact, &end_effectors[attachment.arm], &pose));
        }
        Ok(Self { model, bodies, constraints, places })
    }

    /// What a phase moves.
    #[must_use]
    pub fn system(&self) -> System<'_> {
        System { model: &*self.model, bodies: &self.bodies, constraints: &self.constraints, joint_limits: &[] }
    }

    /// Those of the targets, as they are at some time, that are beside the robot.
    #[must_use]
    pub fn beside(&self, targets: &[Body]) -> Vec<Body> {
        let pairs = targets.iter().zip(&self.places);
        pairs.filter(|(_, place)| matches!(place, TargetPlacement::Beside(_))).map(|(target, _)| *target).collect()
    }

    /// Those of the bodies beside the robot that end effectors hold.
    #[must_use]
    pub fn pinned(&self, bodies: &[Body]) -> Vec<Body> {
        let held = |i: usize| self.constraints.iter().any(|constraint| constraint.other == ContactPartner::Body(i));
        bodies.iter().enumerate().filter(|(i, _)| held(*i)).map(|(_, body)| *body).collect()
    }

    /// The holds as contacts, at poses of the end effectors and bodies.
    pub(crate) fn holds(&self, end_effectors: &[[f64; 3]], bodies: &[Body]) -> Vec<Contact<f64>> {
        let pose = |other: ContactPartner| match other {
            ContactPartner::Body(i) => bodies[i].pose,
            ContactPartner::EndEffector(arm) => end_effectors[arm],
        };
        self.constraints.iter().map(|constraint| constraint.contact(&pose(constraint.other))).collect()
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
        let of = |(target, place): (&Body, &TargetPlacement)| match *place {
            TargetPlacement::Beside(i) => bodies[i],
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
        targets.iter().zip(&self.places).map(of).collect()
    }
}

/// A vector rotated by an angle, rad.
pub(crate) fn rotated([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
