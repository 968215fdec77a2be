//! Scenarios: what a run simulates, read from TOML.

mod approach;
mod case;
mod contact;
mod post_impact;
mod reader;
mod target;

use crate::layout::Layout;
use crate::owned::RobotState;

pub use crate::simulate::actuators::Actuation;
pub use approach::{Approach, EndEffectorGoal, EndEffectorTwistGoal, FinalRates, Tracking};
pub use case::Case;
pub use contact::{ContactRules, Detection};
pub use post_impact::{PostCaptureControl, PostImpact};
pub use reader::{DEFAULT_STEP, MOST_STEPS};
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
    /// The motion of the arms towards the targets.
    pub approach: Approach,
    /// What the arms capture, at most one target per arm; empty for an approach alone.
    pub targets: Vec<Target>,
    /// How contacts come about.
    pub contact: ContactRules,
    /// The variants to run, at least one; without `[[case]]` a single one named after the scenario.
    pub cases: Vec<Case>,
    /// The motion after the impact; given if and only if there are targets.
    pub post_impact: Option<PostImpact>,
}
