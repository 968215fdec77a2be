//! Constraints that last after an impact: closed loops and held bodies.

use super::{Contact, ContactLaw, ContactPartner};
use crate::scalar::{Real, Scalar};

/// A lasting contact between an end effector and a free body or another end effector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LoopConstraint<T> {
    /// The arm of the end effector.
    pub arm: usize,
    /// The body or end effector that it holds.
    pub partner: ContactPartner,
    /// From the partner's origin, the COM of a body or an end effector, to the contact point; axes of the body or the
    /// last link, m.
    pub offset: [T; 2],
    /// Constant yaw of the end effector relative to the partner, rad; `None` for a pin.
    pub yaw: Option<T>,
}

impl<T: Real> LoopConstraint<T> {
    /// The constraint that a contact begins, from the poses of the end effector and of the partner at that instant;
    /// `None` for a bounce. The contact point is the end effector's origin.
    #[must_use]
    pub fn new(contact: &Contact<T>, end_effector: &[T; 3], partner: &[T; 3]) -> Option<Self> {
        let kind = contact.law.kind();
        if !kind.holds() {
            return None;
        }
        let ([end_effector_yaw, end_effector_x, end_effector_y], [yaw, x, y]) = (*end_effector, *partner);
        let (sin, cos) = Scalar::sin_cos(yaw);
        let (dx, dy) = (end_effector_x - x, end_effector_y - y);
        Some(Self {
            arm: contact.arm,
            partner: contact.partner,
            offset: [cos * dx + sin * dy, cos * dy - sin * dx],
            yaw: kind.holds_yaw().then_some(end_effector_yaw - yaw),
        })
    }

    /// The law of its contact.
    #[must_use]
    pub const fn law(&self) -> ContactLaw<T> {
        ContactLaw::holding(self.yaw.is_some())
    }

    /// The contact for this pose of the partner.
    #[must_use]
    pub fn contact(&self, [yaw, ..]: &[T; 3]) -> Contact<T> {
        let (sin, cos) = Scalar::sin_cos(*yaw);
        let [x, y] = self.offset;
        let offset = [cos * x - sin * y, sin * x + cos * y];
        Contact { arm: self.arm, partner: self.partner, offset, law: self.law() }
    }

    /// The constraint errors in the order of the contact's rows: yaw (rad, rigid only), x and y (m).
    pub(super) fn errors(
        &self,
        [end_effector_yaw, end_effector_x, end_effector_y]: &[T; 3],
        partner: &[T; 3],
    ) -> impl Iterator<Item = T> + use<T> {
        let [yaw, x, y] = partner;
        let [rx, ry] = self.contact(partner).offset;
        let rotation = self.yaw.map(|relative| *end_effector_yaw - *yaw - relative);
        rotation.into_iter().chain([*end_effector_x - *x - rx, *end_effector_y - *y - ry])
    }
}
