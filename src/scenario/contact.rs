//! `[contact]`: contact detection and the duration of an impact.

/// When contacts begin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Detection {
    /// At the end of the approach, wherever the end effectors are, as in the paper: the default.
    #[default]
    Time,
    /// When an end effector reaches the outline of its target, which moves freely from the start.
    Event,
}

impl Detection {
    /// All of them with their names in scenarios.
    pub const ALL: [(&'static str, Self); 2] = [("time", Self::Time), ("event", Self::Event)];
}

/// The `[contact]` table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactRules {
    /// When contacts begin.
    pub detection: Detection,
    /// Duration of an impact, s, which gives the mean force of its impulse and has no other effect.
    pub duration: Option<f64>,
}
