//! Impacts and lasting contacts of end effectors with free bodies and with other end effectors.
//!
//! Each contact has one to three rows. A row is a wrench direction w = [n, fx, fy] at the end effector; the opposite
//! wrench acts on the contact partner, and the row's velocity u is the component along w of the twist of the end effector
//! relative to the partner.
//!
//! | kind | rows | transmits |
//! |---|---|---|
//! | [`ContactLaw::Rigid`] | relative twist | moment and force |
//! | [`ContactLaw::Pin`] | relative velocity of the contact points | force |
//! | [`ContactLaw::Bounce`] | relative velocity along the normal | compressive force along the normal |
//!
//! With the [`DelassusMatrix`] W, the change of the rows' velocities per row impulse, [`impact`] applies Poisson's law
//! of restitution, and [`balance_momentum`] solves it again where inertias differ by many orders of magnitude; the
//! [`ConstraintSolver`] computes the constraint forces of lasting contacts.

mod complementarity;
mod constraint_row;
mod constraint_solver;
mod delassus_matrix;
mod impact;
mod inverse_inertia;
mod kind;
mod loop_constraint;
mod momentum_balance;

pub use constraint_solver::{ConstraintSolver, ConstraintWorkspace};
pub use delassus_matrix::{DelassusMatrix, workspace_length};
pub use impact::{ImpactOutput, impact};
pub use inverse_inertia::{ImpulseEllipse, InverseInertia};
pub use kind::{ContactKind, ContactLaw};
pub use loop_constraint::LoopConstraint;
pub use momentum_balance::{balance_length, balance_momentum, bilateral_rows};

use crate::error::Error;
use crate::scalar::Real;

/// The body or end effector with which an end effector is in contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactPartner {
    /// The free body of this index.
    Body(usize),
    /// A body rigidly attached to the end effector of this arm.
    EndEffector(usize),
}

impl ContactPartner {
    /// The partner's entry in lists with one entry per end effector and per body.
    ///
    /// # Errors
    /// [`Error::Index`] for an arm or body that does not exist.
    pub fn select<'a, X>(self, end_effectors: &'a [X], bodies: &'a [X]) -> Result<&'a X, Error> {
        match self {
            Self::Body(i) => entry("body", bodies, i),
            Self::EndEffector(arm) => entry("arm", end_effectors, arm),
        }
    }
}

/// An entry of a list per arm or per body, or [`Error::Index`].
fn entry<'a, X>(what: &'static str, list: &'a [X], index: usize) -> Result<&'a X, Error> {
    list.get(index).ok_or(Error::Index { what, index, count: list.len() })
}

/// As [`entry`], mutable.
fn entry_mut<'a, X>(what: &'static str, list: &'a mut [X], index: usize) -> Result<&'a mut X, Error> {
    let count = list.len();
    list.get_mut(index).ok_or(Error::Index { what, index, count })
}

/// One contact at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Contact<T> {
    /// The arm of the end effector.
    pub arm: usize,
    /// The body or end effector that it touches.
    pub partner: ContactPartner,
    /// From the partner's origin, the COM of a body or an end effector, to the contact point; inertial axes, m.
    pub offset: [T; 2],
    /// The relation between relative velocity and impulse.
    pub law: ContactLaw<T>,
}

impl<T: Real> Contact<T> {
    /// A contact to initialise working space with.
    #[must_use]
    pub fn any() -> Self {
        Self { arm: 0, partner: ContactPartner::EndEffector(0), offset: [T::ZERO; 2], law: ContactLaw::Pin }
    }
}
