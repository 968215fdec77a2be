//! `[[target]]`: what the arms touch, and how.

use crate::contact::ContactKind;
use crate::outline::Outline;

/// A free body that arms touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Unique in the scenario.
    pub name: String,
    /// Which arms touch it, at least one; no arm touches two targets.
    pub touches: Vec<PlannedContact>,
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the COM in kg m², greater than 0.
    pub inertia: f64,
    /// Its outline, in its own frame.
    pub surface: Outline,
    /// Of bounces, 0 to 1; default 0.
    pub restitution: f64,
    /// Twist of the COM before the impact [ω, vx, vy] in rad/s, m/s, m/s; default zero.
    pub twist: [f64; 3],
    /// Of its frame, rad, default 0: at the impact, or at the start where contacts are found by detection.
    pub yaw: f64,
    /// [x, y] of the COM in m, inertial frame: where it was expected at the impact, for reporting the miss only; where
    /// contacts are found by detection, where it is at the start.
    pub position: Option<[f64; 2]>,
}

/// An arm that touches a target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlannedContact {
    /// Index of the arm.
    pub arm: usize,
    /// From the target's COM to the contact point at the impact, [x, y] in m, inertial axes; zero where it is found by
    /// detection.
    pub contact: [f64; 2],
    /// What the contact does; `None` where it does nothing, and the grasp fails.
    pub kind: Option<ContactKind>,
}

/// The name of a contact that does nothing.
pub(super) const NONE: &str = "none";

/// As in a scenario.
#[must_use]
pub fn contact_name(kind: Option<ContactKind>) -> &'static str {
    kind.map_or(NONE, ContactKind::name)
}

impl Target {
    /// The arm that touches it, the first where there are several.
    #[must_use]
    pub fn arm(&self) -> usize {
        self.touches.first().map_or(0, |touch| touch.arm)
    }

    /// Where that arm touches it, from its COM, m.
    #[must_use]
    pub fn contact(&self) -> [f64; 2] {
        self.touches.first().map_or([0.0; 2], |touch| touch.contact)
    }

    /// Whether one of these contacts, one per touch, would bounce where a disc has no outward normal: prescribed at its
    /// COM.
    pub(super) fn bounces_at_its_com(&self, kinds: &[Option<ContactKind>]) -> bool {
        let at_com = |touch: &PlannedContact| touch.contact.iter().all(|x| *x == 0.0);
        let mut touches = self.touches.iter().zip(kinds);
        let bounces = touches.any(|(touch, kind)| *kind == Some(ContactKind::Bounce) && at_com(touch));
        bounces && matches!(self.surface, Outline::Disc { .. })
    }
}
