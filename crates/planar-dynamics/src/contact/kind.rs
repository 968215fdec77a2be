//! The kinds of contacts, their constraints, the rows of each, and their laws of impact.

use crate::scalar::Scalar;

/// A kind of contact, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactKind {
    /// A rigid grasp: no relative twist after the impact.
    Rigid,
    /// The contact points coincide after the impact; the relative rotation is free.
    Pin,
    /// A frictionless unilateral contact, which separates.
    Bounce,
}

impl ContactKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Rigid, Self::Pin, Self::Bounce];

    /// The name in scenarios.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Pin => "pin",
            Self::Bounce => "bounce",
        }
    }

    /// Number of constraints after the impact: on the relative yaw and two coordinates.
    #[must_use]
    pub const fn constraints(self) -> usize {
        match self {
            Self::Rigid => 3,
            Self::Pin => 2,
            Self::Bounce => 0,
        }
    }

    /// Whether the contact continues after the impact.
    #[must_use]
    pub const fn holds(self) -> bool {
        self.constraints() > 0
    }

    /// Whether the relative yaw is constant after the impact.
    #[must_use]
    pub const fn holds_yaw(self) -> bool {
        self.constraints() == 3
    }

    /// Whether it transmits a push along the normal alone, with a restitution.
    #[must_use]
    pub const fn is_unilateral(self) -> bool {
        matches!(self, Self::Bounce)
    }
}

/// The relation between the impulse of a contact and the motion of the end effector relative to its partner.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ContactLaw<T> {
    /// See [`ContactKind::Rigid`].
    Rigid,
    /// See [`ContactKind::Pin`].
    Pin,
    /// Poisson's restitution along the normal. Other contacts have no restitution, which could increase their energy.
    Bounce {
        /// Outward unit normal of the partner's surface, inertial axes.
        normal: [T; 2],
        /// From 0, no impulse in the restitution phase, to 1, that of the compression.
        restitution: T,
    },
}

impl<T: Copy> ContactLaw<T> {
    /// Its kind.
    #[must_use]
    pub const fn kind(&self) -> ContactKind {
        match self {
            Self::Rigid => ContactKind::Rigid,
            Self::Pin => ContactKind::Pin,
            Self::Bounce { .. } => ContactKind::Bounce,
        }
    }

    /// The wrench directions [n, fx, fy] of its rows in inertial axes, and how many of the three there are.
    pub(super) fn wrenches(&self) -> ([[T; 3]; 3], usize)
    where
        T: Scalar,
    {
        let (zero, one) = (T::ZERO, T::ONE);
        match *self {
            Self::Rigid => ([[one, zero, zero], [zero, one, zero], [zero, zero, one]], 3),
            Self::Pin => ([[zero, one, zero], [zero, zero, one], [zero; 3]], 2),
            Self::Bounce { normal: [x, y], .. } => ([[zero, x, y], [zero; 3], [zero; 3]], 1),
        }
    }

    /// Normal and restitution of a bounce.
    #[must_use]
    pub fn bounce(&self) -> Option<([T; 2], T)> {
        match self {
            Self::Bounce { normal, restitution } => Some((*normal, *restitution)),
            Self::Rigid | Self::Pin => None,
        }
    }

    /// The law of a contact that continues, by whether it holds the relative yaw.
    #[must_use]
    pub const fn holding(yaw: bool) -> Self {
        if yaw { Self::Rigid } else { Self::Pin }
    }

    /// The law of a kind; only a bounce uses `normal` and `restitution`.
    #[must_use]
    pub fn new(kind: ContactKind, normal: impl FnOnce() -> [T; 2], restitution: T) -> Self {
        match kind {
            ContactKind::Rigid => Self::Rigid,
            ContactKind::Pin => Self::Pin,
            ContactKind::Bounce => Self::Bounce { normal: normal(), restitution },
        }
    }
}
