//! Contacts of end effectors with bodies, and with bodies that another end effector holds: impacts of any mixture of
//! kinds, and loops that stay closed afterwards.
//!
//! Every contact is one to three rows of a constraint. A row is a wrench direction w = [n, fx, fy] at the end effector;
//! the same with the other sign acts on what the end effector touches, and the row's velocity u is that of the end
//! effector relative to it along w.
//!
//! | kind | rows | transmits |
//! |---|---|---|
//! | [`ContactLaw::Rigid`] | relative twist | moment and force |
//! | [`ContactLaw::Pin`] | relative velocity of the contact points | force |
//! | [`ContactLaw::Bounce`] | relative velocity along the normal | force along the normal, pushing only |
//!
//! With W the rows' velocities per row impulses ([`DelassusMatrix`]), an impact is solved by Poisson's law with the
//! rigid and pinned contacts closed throughout ([`impact`]); what stays held moves under the forces that keep it closed
//! ([`ConstraintSolver`]).

mod complementarity;
mod constraint_row;
mod constraint_solver;
mod delassus_matrix;
mod impact;
mod inverse_inertia;
mod kind;
mod loop_constraint;

pub use constraint_solver::{ConstraintSolver, ConstraintWorkspace};
pub use delassus_matrix::{DelassusMatrix, workspace_length};
pub use impact::{ImpactOutput, impact};
pub use inverse_inertia::{ImpulseEllipse, InverseInertia};
pub use kind::{ContactKind, ContactLaw};
pub use loop_constraint::LoopConstraint;

use crate::error::Error;
use crate::scalar::Real;

/// What an end effector touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactPartner {
    /// A free body, by its index.
    Body(usize),
    /// Something that the end effector of that arm holds rigidly, part of its last link.
    EndEffector(usize),
}

impl ContactPartner {
    /// That it is not there, among so many arms and bodies.
    pub(crate) fn missing(self, arms: usize, bodies: usize) -> Error {
        match self {
            Self::Body(index) => Error::Index { what: "body that is held", index, count: bodies },
            Self::EndEffector(index) => Error::Index { what: "arm that is held", index, count: arms },
        }
    }
}

/// One contact at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<T> {
    /// The arm whose end effector touches.
    pub arm: usize,
    /// What it touches.
    pub other: ContactPartner,
    /// From the COM of the body, or from the other end effector, to the contact point, inertial axes, m.
    pub offset: [T; 2],
    /// What the contact does.
    pub law: ContactLaw<T>,
}

impl<T: Real> Contact<T> {
    /// Any contact, to fill working space with.
    #[must_use]
    pub fn any() -> Self {
        Self { arm: 0, other: ContactPartner::EndEffector(0), offset: [T::ZERO; 2], law: ContactLaw::Pin }
    }
}
