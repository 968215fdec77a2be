//! Scenarios: the robot, its approach, the targets and the motion after their capture, as plain data read from TOML.

mod approach;
mod case;
mod clearance;
mod contact;
mod key_path;
mod keys;
mod post_impact;
mod reader;
mod sample_time;
mod source;
mod target;
pub mod variation;

use crate::frames::{Frame, frames};
use crate::layout::Layout;
use crate::owned::RobotState;
use crate::simulate::limits::JointLimits;

pub use crate::simulate::actuators::Actuation;
pub use approach::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, Tracking};
pub use case::Case;
pub use clearance::{ClearanceRules, OnOverlap};
pub use contact::{ContactRules, Detection};
pub use key_path::{KeyFile, find_key};
pub use keys::FORMAT;
pub use post_impact::{PostCaptureControl, PostImpact};
pub use source::{ScenarioSource, Source};
pub use target::{PlannedContact, Target, contact_name};

/// An approach and, where there are targets, their capture and the motion after it.
///
/// SI units, radians, inertial axes; twists are [ω, vx, vy], poses [yaw, x, y].
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    /// Names the results; usable as a file name.
    pub name: String,
    /// The robot.
    pub layout: Layout,
    /// The state at the start of the approach.
    pub initial: RobotState,
    /// Ranges of the joint angles and rates, one per joint, which are checked in every phase and not enforced; empty
    /// without `[limits]`.
    pub joint_limits: Vec<JointLimits>,
    /// The motion of the arms towards the targets.
    pub approach: Approach,
    /// The bodies that the arms capture, at most one per arm; empty for an approach alone.
    pub targets: Vec<Target>,
    /// When contacts begin, and how long an impact takes.
    pub contact: ContactRules,
    /// Which bodies may overlap, and what an overlap of others does.
    pub clearance: ClearanceRules,
    /// The variants to run, at least one; without `[[case]]` a single one named after the scenario.
    pub cases: Vec<Case>,
    /// The motion after the impact; given if and only if there are targets.
    pub post_impact: Option<PostImpact>,
}

impl Scenario {
    /// The frames of its robot and targets.
    #[must_use]
    pub fn frames(&self) -> Vec<Frame> {
        frames(&self.layout, self.targets.iter().map(|target| target.name.as_str()))
    }

    /// The largest distance of a point of the robot from its base's COM, or of a target held by it, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        let of_targets = self.targets.iter().map(|target| target.outline.reach());
        self.layout.reach() + 2.0 * of_targets.fold(0.0, f64::max)
    }
}
