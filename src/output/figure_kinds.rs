//! The kinds of figures, by which some of them are asked for.
//!
//! # Example
//! ```
//! use planar_capture::output::figure_kinds::{FIGURE_KINDS, begins_with, is_kind};
//!
//! // angles, rates, base and end effectors
//! assert_eq!(FIGURE_KINDS.iter().filter(|kind| begins_with(kind, "approach")).count(), 4);
//! assert!(is_kind("momentum") && !is_kind("moment"));
//! assert!(begins_with("momentum_case1", "momentum")); // that of a case
//! ```

/// The beginnings of the figures' names: what follows is a case's name.
pub const FIGURE_KINDS: [&str; 15] = [
    "initial_configuration",
    "final_configuration",
    "impact_configuration",
    "approach_joint_angles",
    "approach_joint_rates",
    "approach_base",
    "approach_end_effector_velocities",
    "impact_velocities",
    "momentum",
    "energy",
    "clearance",
    "post_impact_joints",
    "post_impact_base",
    "post_impact_end_effector_velocities",
    "post_impact_motion",
];

/// Whether a name is a kind, or the beginning of kinds: `approach` is that of four.
#[must_use]
pub fn is_kind(name: &str) -> bool {
    FIGURE_KINDS.iter().any(|kind| begins_with(kind, name))
}

/// Whether a name is this word, or goes on after it with `_`.
#[must_use]
pub fn begins_with(name: &str, word: &str) -> bool {
    name.strip_prefix(word).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
}
