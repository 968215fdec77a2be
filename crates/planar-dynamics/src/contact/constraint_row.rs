//! One row of a contact.

use super::{Contact, ContactLaw, ContactPartner};
use crate::linear::dot;
use crate::scalar::Real;

/// A wrench direction between an end effector and what it touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConstraintRow<T> {
    pub(super) arm: usize,
    pub(super) other: ContactPartner,
    /// [n, fx, fy] on the robot at the end effector.
    pub(super) wrench: [T; 3],
    /// The same about the origin of what is touched, on which it acts with the other sign.
    pub(super) at_other: [T; 3],
    /// Of the contact point from that origin along the force, m: rx fx + ry fy.
    pub(super) reach: T,
    /// `None` for a row that pulls as well as it pushes.
    pub(super) restitution: Option<T>,
}

impl<T: Real> ConstraintRow<T> {
    /// Its velocity u, or acceleration, for these of the end effectors and of the bodies: rad/s for a moment, m/s for a
    /// force.
    pub(super) fn velocity_of(&self, end_effectors: &[[T; 3]], bodies: &[[T; 3]]) -> T {
        let other = match self.other {
            ContactPartner::Body(i) => bodies.get(i),
            ContactPartner::EndEffector(arm) => end_effectors.get(arm),
        };
        let part = |wrench: &[T; 3], twist: Option<&[T; 3]>| twist.map_or(T::ZERO, |twist| dot(wrench, twist));
        part(&self.wrench, end_effectors.get(self.arm)) - part(&self.at_other, other)
    }
}

impl<T: Real> Contact<T> {
    /// Its rows: 3, 2 or 1.
    pub(super) fn rows(&self) -> impl Iterator<Item = ConstraintRow<T>> + use<T> {
        let (zero, one) = (T::ZERO, T::ONE);
        let (wrenches, count, restitution) = match self.law {
            ContactLaw::Rigid => ([[one, zero, zero], [zero, one, zero], [zero, zero, one]], 3, None),
            ContactLaw::Pin => ([[zero, one, zero], [zero, zero, one], [zero; 3]], 2, None),
            ContactLaw::Bounce { normal: [x, y], restitution } => {
                ([[zero, x, y], [zero; 3], [zero; 3]], 1, Some(restitution))
            }
        };
        let Self { arm, other, offset: [rx, ry], .. } = *self;
        wrenches.into_iter().take(count).map(move |wrench| {
            let [n, fx, fy] = wrench;
            ConstraintRow {
                arm,
                other,
                wrench,
                at_other: [n + (rx * fy - ry * fx), fx, fy],
                reach: rx * fx + ry * fy,
                restitution,
            }
        })
    }
}

/// A set of rows, by their bits: no more than 64.
pub(super) type Set = u64;

/// Whether a row is in a set.
pub(super) fn has(set: Set, row: usize) -> bool {
    row < 64 && set >> row & 1 == 1
}
