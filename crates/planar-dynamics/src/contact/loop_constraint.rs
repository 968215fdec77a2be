//! What tips hold after an impact, and the forces that keep it so.

use super::{Contact, ContactLaw, ContactPartner};
use crate::scalar::{Real, Scalar};

/// A hold that closes a loop, or that holds a body which is no part of the robot's tree: a contact that lasts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoopConstraint<T> {
    /// The arm whose tip holds.
    pub arm: usize,
    /// What it holds.
    pub other: ContactPartner,
    /// From the COM of the body, or from the other tip, to the point that is held, in the frame of body or last link, m.
    pub offset: [T; 2],
    /// Yaw of the tip less that of what it holds, rad; `None` for a pin, which turns freely.
    pub yaw: Option<T>,
}

impl<T: Real> LoopConstraint<T> {
    /// The hold that a contact begins, from the poses of the tip and of what it touches at that instant; `None` for a
    /// bounce. The point that is held is where the tip is.
    #[must_use]
    pub fn new(contact: &Contact<T>, [tip_yaw, tip_x, tip_y]: &[T; 3], [yaw, x, y]: &[T; 3]) -> Option<Self> {
        let (sin, cos) = Scalar::sin_cos(*yaw);
        let (dx, dy) = (*tip_x - *x, *tip_y - *y);
        let kind = contact.law.kind();
        if !kind.holds() {
            return None;
        }
        let yaw = kind.holds_yaw().then_some(*tip_yaw - *yaw);
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
    pub(super) fn errors(&self, [tip_yaw, tip_x, tip_y]: &[T; 3], held: &[T; 3]) -> impl Iterator<Item = T> + use<T> {
        let [yaw, x, y] = held;
        let [rx, ry] = self.contact(held).offset;
        let turned = self.yaw.map(|between| *tip_yaw - *yaw - between);
        turned.into_iter().chain([*tip_x - *x - rx, *tip_y - *y - ry])
    }
}
