//! The kinds of contacts: what each transmits, and what lasts of it.

/// A kind of contact, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// The end effector takes hold: no relative twist after the impact.
    Rigid,
    /// The contact points move together after the impact, and turn freely about each other.
    Pin,
    /// The end effector is pushed away without friction.
    Bounce,
}

impl ContactKind {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Rigid, Self::Pin, Self::Bounce];

    /// As scenarios have it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Pin => "pin",
            Self::Bounce => "bounce",
        }
    }

    /// Number of constraints that last after the impact: of the relative yaw and of two coordinates.
    #[must_use]
    pub const fn constraints(self) -> usize {
        match self {
            Self::Rigid => 3,
            Self::Pin => 2,
            Self::Bounce => 0,
        }
    }

    /// Whether the contact lasts.
    #[must_use]
    pub const fn holds(self) -> bool {
        self.constraints() > 0
    }

    /// Whether a contact that lasts keeps the relative yaw too.
    #[must_use]
    pub const fn holds_yaw(self) -> bool {
        self.constraints() == 3
    }
}

/// What a contact does to the motion of an end effector relative to what it touches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactLaw<T> {
    /// See [`ContactKind::Rigid`].
    Rigid,
    /// See [`ContactKind::Pin`].
    Pin,
    /// Poisson's restitution along the normal. It is a law for contacts that do not hold; a holding contact with
    /// restitution could create energy.
    Bounce {
        /// Of the surface that the end effector touches, outwards, unit length, inertial axes.
        normal: [T; 2],
        /// 0, nothing is given back, to 1, all of it.
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

    /// Normal and restitution, where forces act along a normal alone.
    #[must_use]
    pub fn bounce(&self) -> Option<([T; 2], T)> {
        match self {
            Self::Bounce { normal, restitution } => Some((*normal, *restitution)),
            Self::Rigid | Self::Pin => None,
        }
    }

    /// The law of a kind; `normal` and `restitution` are for those that have them.
    #[must_use]
    pub fn new(kind: ContactKind, normal: impl FnOnce() -> [T; 2], restitution: T) -> Self {
        match kind {
            ContactKind::Rigid => Self::Rigid,
            ContactKind::Pin => Self::Pin,
            ContactKind::Bounce => Self::Bounce { normal: normal(), restitution },
        }
    }
}
