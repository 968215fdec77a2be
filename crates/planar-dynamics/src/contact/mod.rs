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
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::body::Body;
//! use planar_dynamics::contact::{Contact, ContactLaw, ContactPartner, DelassusMatrix};
//! use planar_dynamics::contact::{ImpactOutput, impact, workspace_length};
//! use planar_dynamics::state::State;
//!
//! let (robot, pose, angles) = (Model::<f64>::default(), [0.0; 3], [0.5; JOINTS]);
//! let at_rest = State { base_pose: pose, joint_angles: &angles, base_twist: [0.0; 3], joint_rates: &[0.0; JOINTS] };
//! let ball = [Body { mass: 2.0, inertia: 0.1, pose: [0.0; 3], twist: [0.0, -0.4, 0.0] }];
//! let law = ContactLaw::Bounce { normal: [-1.0, 0.0], restitution: 0.5 };
//! let contacts = [Contact { arm: 0, partner: ContactPartner::Body(0), offset: [-0.2, 0.0], law }];
//! let mut numbers = [0.0; workspace_length(JOINTS, 2, 1, 1)];
//! let delassus = DelassusMatrix::new(&robot, &pose, &angles, &ball, &contacts, &mut numbers)?;
//! let (mut joint_rates, mut ball_twist, mut impulse) = ([0.0; JOINTS], [[0.0; 3]], [[0.0; 3]]);
//! let mut after =
//!     ImpactOutput { joint_rates: &mut joint_rates, body_twists: &mut ball_twist, impulses: &mut impulse };
//! let base_twist = impact(&robot, &at_rest, &ball, delassus, &mut after)?;
//! // Newton's law: they meet at 0.4 m/s and part at half of it
//! let [end_effector, _] = robot.end_effector_twists(&pose, &angles, &base_twist, &joint_rates);
//! assert!((ball_twist[0][1] - end_effector[1] - 0.2).abs() < 1e-12);
//! # Ok::<(), planar_dynamics::error::Error>(())
//! ```

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
