//! The rows of a contact: wrench directions and their velocities.

use super::{Contact, ContactPartner, entry};
use crate::error::Error;
use crate::linear::dot;
use crate::scalar::Real;

/// A wrench direction between an end effector and its contact partner.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConstraintRow<T> {
    pub(super) arm: usize,
    pub(super) partner: ContactPartner,
    /// [n, fx, fy] on the robot at the end effector.
    pub(super) wrench: [T; 3],
    /// The same wrench about the partner's origin; it acts on the partner with the opposite sign.
    pub(super) partner_wrench: [T; 3],
    /// Distance of the contact point from the partner's origin along the force, m: rx fx + ry fy.
    pub(super) partner_distance: T,
    /// `None` for a bilateral row.
    pub(super) restitution: Option<T>,
}

impl<T: Real> ConstraintRow<T> {
    /// Its velocity u, or acceleration, from those of the end effectors and the bodies: rad/s for a moment, m/s for a
    /// force.
    ///
    /// # Errors
    /// [`Error::Index`] for an arm or body that does not exist.
    pub(super) fn velocity(&self, end_effectors: &[[T; 3]], bodies: &[[T; 3]]) -> Result<T, Error> {
        let (own, partner) = (entry("arm", end_effectors, self.arm)?, self.partner.select(end_effectors, bodies)?);
        Ok(dot(&self.wrench, own) - dot(&self.partner_wrench, partner))
    }
}

impl<T: Real> Contact<T> {
    /// Its rows: 3, 2 or 1.
    pub(super) fn rows(&self) -> impl Iterator<Item = ConstraintRow<T>> + use<T> {
        let (wrenches, count) = self.law.wrenches();
        let restitution = self.law.bounce().map(|(_, restitution)| restitution);
        let Self { arm, partner, offset: [rx, ry], .. } = *self;
        wrenches.into_iter().take(count).map(move |wrench| {
            let [n, fx, fy] = wrench;
            ConstraintRow {
                arm,
                partner,
                wrench,
                partner_wrench: [n + (rx * fy - ry * fx), fx, fy],
                partner_distance: rx * fx + ry * fy,
                restitution,
            }
        })
    }
}

/// A set of at most 64 rows, one bit each.
pub(super) type RowSet = u64;

/// Whether a row is in a set.
pub(super) fn contains(set: RowSet, row: usize) -> bool {
    row < 64 && set >> row & 1 == 1
}
