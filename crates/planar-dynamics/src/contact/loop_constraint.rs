//! What end effectors hold after an impact, and the forces that keep it so.

use super::{Contact, ContactLaw, ContactPartner};
use crate::scalar::{Real, Scalar};

/// A hold that closes a loop, or that holds a body which is no part of the robot's tree: a contact that lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopConstraint<T> {
    /// The arm whose end effector holds.
    pub arm: usize,
    /// What it holds.
    pub other: ContactPartner,
    /// From the COM of the body, or from the other end effector, to the point that is held, in the frame of body or
    /// last link, m.
    pub offset: [T; 2],
    /// Yaw of the end effector less that of what it holds, rad; `None` for a pin, which turns freely.
    pub yaw: Option<T>,
}

impl<T: Real> LoopConstraint<T> {
    /// The hold that a contact begins, from the poses of the end effector and of what it touches at that instant;
    /// `None` for a bounce. The point that is held is where the end effector is.
    #[must_use]
    pub fn new(
        contact: &Contact<T>,
        [end_effector_yaw, end_effector_x, end_effector_y]: &[T; 3],
        [yaw, x, y]: &[T; 3],
    ) -> Option<Self> {
        let (sin, cos) = Scalar::sin_cos(*yaw);
        let (dx, dy) = (*end_effector_x - *x, *end_effector_y - *y);
        let kind = contact.law.kind();
        if !kind.holds() {
            return None;
        }
        let yaw = kind.holds_yaw().then_some(*end_effector_yaw - *yaw);
        Some(Self { arm: contact.arm, other: contact.other, offset: [cos * dx + sin * dy, cos * dy - sin * dx], yaw })
    }

    /// The same contact where what is held has this pose.
    #[must_use]
    pub fn contact(&self, [yaw, ..]: &[T; 3]) -> Contact<T> {
        let (sin, cos) = Scalar::sin_cos(*yaw);
        let [x, y] = self.offset;
        let law = if self.yaw.is_some() { ContactLaw::Rigid } else { ContactLaw::Pin };
        Contact { arm: self.arm, other: self.other, offset: [cos * x - sin * y, sin * x + cos * y], law }
    }

    /// By how much the hold is open, in the order of the contact's rows: yaw (rad, rigid ones alone), x and y (m).
    pub(super) fn errors(
        &self,
        [end_effector_yaw, end_effector_x, end_effector_y]: &[T; 3],
        held: &[T; 3],
    ) -> impl Iterator<Item = T> + use<T> {
        let [yaw, x, y] = held;
        let [rx, ry] = self.contact(held).offset;
        let turned = self.yaw.map(|between| *end_effector_yaw - *yaw - between);
        turned.into_iter().chain([*end_effector_x - *x - rx, *end_effector_y - *y - ry])
    }
}
