//! Contacts of tips with bodies, and with bodies that another tip holds: impacts of any mixture of kinds, and loops that
//! stay closed afterwards.
//!
//! Every contact is one to three rows of a constraint. A row is a wrench direction w = [n, fx, fy] at the tip; the same
//! with the other sign acts on what the tip touches, and the row's velocity u is that of the tip relative to it along w.
//!
//! | kind | rows | transmits |
//! |---|---|---|
//! | [`Kind::Rigid`] | relative twist | moment and force |
//! | [`Kind::Pin`] | relative velocity of the contact points | force |
//! | [`Kind::Bounce`] | relative velocity along the normal | force along the normal, pushing only |
//!
//! With W the rows' velocities per row impulses ([`Rows`]), an impact is solved by Poisson's law with the rigid and pinned
//! contacts closed throughout ([`impact`]); what stays held moves under the forces that keep it closed ([`Hold`]).

mod closure;
mod complementarity;
mod hold;
mod impact;
mod inverse_inertia;
mod row;
mod rows;

pub use closure::Closure;
pub use hold::{Hold, Workspace};
pub use impact::{After, impact};
pub use inverse_inertia::{ImpulseEllipse, InverseInertia};
pub use rows::{Rows, workspace_length};

use crate::scalar::Real;

/// What a contact does to the motion of a tip relative to what it touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind<T> {
    /// The tip takes hold: no relative twist after the impact.
    Rigid,
    /// The contact points move together after the impact, and turn freely about each other.
    Pin,
    /// The tip is pushed away without friction: Poisson's restitution along the normal. It is a law for contacts that do not
    /// hold; a holding contact with restitution could create energy.
    Bounce {
        /// Of the surface that the tip touches, outwards, unit length, inertial axes.
        normal: [T; 2],
        /// 0, nothing is given back, to 1, all of it.
        restitution: T,
    },
}

impl<T> Kind<T> {
    /// As in a scenario.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Pin => "pin",
            Self::Bounce { .. } => "bounce",
        }
    }
}

/// What a tip touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Other {
    /// A free body, by its index.
    Body(usize),
    /// Something that the tip of that arm holds rigidly, part of its last link.
    Tip(usize),
}

/// One contact at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact<T> {
    /// The arm whose tip touches.
    pub arm: usize,
    /// What it touches.
    pub other: Other,
    /// From the COM of the body, or from the other tip, to the contact point, inertial axes, m.
    pub offset: [T; 2],
    /// What the contact does.
    pub kind: Kind<T>,
}

impl<T: Real> Contact<T> {
    /// Any contact, to fill working space with.
    #[must_use]
    pub fn any() -> Self {
        Self { arm: 0, other: Other::Tip(0), offset: [T::ZERO; 2], kind: Kind::Pin }
    }
}
