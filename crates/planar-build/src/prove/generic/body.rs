//! One rigid body of the tree, and the frames that are mounted on it.

/// A rigid body with its frame at its joint; the base has no joint and its frame at its COM.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// About its COM, kg m².
    pub inertia: f64,
    /// In its frame, m.
    pub com: [f64; 2],
    /// The frame of its joint; `None` for the base.
    pub joint: Option<MountedFrame>,
}

/// A frame fixed to a body: of a joint, or of an end effector.
#[derive(Clone, Debug, PartialEq)]
pub struct MountedFrame {
    /// Which body.
    pub body: usize,
    /// In the body's frame, m.
    pub position: [f64; 2],
    /// Direction from the body's x axis, rad.
    pub angle: f64,
}
