//! The `[clearance]` table: what follows from an overlap of bodies.

/// Which bodies may overlap, and what an overlap of others does.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ClearanceRules {
    /// Default: report it.
    pub on_overlap: OnOverlap,
    /// Pairs of bodies by the names of their frames, which may overlap.
    pub ignore: Vec<[String; 2]>,
    /// Most distances of a case of up to 100 s, more in proportion for a longer one. The default takes about ten seconds;
    /// a spin of more than some thousand turns per second needs more.
    pub max_distances: u64,
    /// Whether pairs with a default outline are left out, which fail no run.
    pub only_given: bool,
}

impl Default for ClearanceRules {
    fn default() -> Self {
        Self { on_overlap: OnOverlap::Report, ignore: Vec::new(), max_distances: 20_000_000, only_given: false }
    }
}

/// What an overlap does, of bodies whose outlines are both given; others are reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum OnOverlap {
    /// It is in the results.
    #[default]
    Report,
    /// The run fails its audit.
    Fail,
    /// The case ends there, and the run fails its audit.
    Stop,
}

impl OnOverlap {
    /// All of them with their names in scenarios.
    pub const ALL: [(&'static str, Self); 3] = [("report", Self::Report), ("fail", Self::Fail), ("stop", Self::Stop)];
}
