//! `[[target]]`: the bodies that the arms capture, and their contacts.

use crate::contact::ContactKind;
use crate::outline::Outline;

/// A free rigid body that arms capture.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Target {
    /// Unique in the scenario.
    pub name: String,
    /// Its contacts, one for each arm that captures it, at least one; no arm captures two targets.
    pub contacts: Vec<PlannedContact>,
    /// Mass in kg, greater than 0.
    pub mass: f64,
    /// Moment of inertia about the COM in kg m², greater than 0.
    pub inertia: f64,
    /// In its own frame.
    pub outline: Outline,
    /// Coefficient of restitution of bounces, 0 to 1.
    pub restitution: f64,
    /// Twist of the COM before the impact [ω, vx, vy] in rad/s, m/s, m/s.
    pub twist: [f64; 3],
    /// Yaw of its frame in rad: at the impact, or at the start where contacts are found by detection.
    pub yaw: f64,
    /// [x, y] of the COM in m, inertial frame: expected at the impact and used only to report the distance from there,
    /// or, where contacts are found by detection, the position at the start (then always given).
    pub position: Option<[f64; 2]>,
}

/// The contact of an arm with a target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PlannedContact {
    /// Index of the arm.
    pub arm: usize,
    /// Contact point from the target's COM at the impact, [x, y] in m, inertial axes; zero where it is found by
    /// detection.
    pub point: [f64; 2],
    /// Rigid, pinned or bouncing; `None` for a grasp that fails, which exerts no impulse.
    pub kind: Option<ContactKind>,
}

/// The name of a contact in a scenario: that of its kind, or `none`.
#[must_use]
pub fn contact_name(kind: Option<ContactKind>) -> &'static str {
    kind.map_or("none", ContactKind::name)
}
