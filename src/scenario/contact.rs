//! `[contact]`: how contacts come about and how long they last.

/// When end effectors and targets meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detection {
    /// At the end of the approach, wherever the end effectors are, as in the paper: the default.
    #[default]
    Time,
    /// When an end effector reaches the surface of its target, which flies freely from the start on.
    Event,
}

/// The `[contact]` table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactRules {
    /// When end effectors and targets meet.
    pub detection: Detection,
    /// How long an impact takes, s: what turns its impulse into a mean force, and changes nothing else.
    pub duration: Option<f64>,
}
