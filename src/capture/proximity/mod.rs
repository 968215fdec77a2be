//! Signed distances of convex parts of bodies along the path of a phase, and their bounds over intervals.

pub(super) mod convex;
pub(super) mod motion;
pub(super) mod part_pair;
#[cfg(test)]
mod tests;
pub(super) mod workspace;
