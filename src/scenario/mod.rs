//! Scenarios: the robot, its approach, the targets and the motion after their capture, as plain data read from TOML.

mod approach;
mod case;
mod clearance;
mod contact;
#[cfg(test)]
pub(crate) mod fixture;
mod key_path;
mod keys;
mod known;
mod post_impact;
mod reader;
mod sample_time;
mod source;
mod target;
mod variant;
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
#[cfg(feature = "cli")]
pub(crate) use keys::LARGEST_ANGLE;
pub use known::{Known, LawFormat, LawFormats, LawNumber, LawNumbers};
pub use post_impact::{PostCaptureControl, PostImpact};
pub use source::{ScenarioSource, Source};
pub use target::{PlannedContact, Target, contact_name};
pub use variant::Variant;

/// An approach and, where there are targets, their capture and the motion after it.
///
/// SI units, radians, inertial axes; twists are [ω, vx, vy], poses [yaw, x, y].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
    /// The cases that have this scenario's approach; without `[[case]]` a single one named after the scenario. None where
    /// every case is in `variants`.
    pub cases: Vec<Case>,
    /// The cases with values of their own, each a scenario that is computed by itself. A study of this one has none of
    /// them.
    pub variants: Vec<Variant>,
    /// The motion after the impact; given if and only if there are targets.
    pub post_impact: Option<PostImpact>,
}

impl Scenario {
    /// Names and numbers of the laws of the program's own that control the approach and the motion after the capture.
    #[must_use]
    pub fn own_laws(&self) -> [Option<(&'static str, &LawNumbers)>; 2] {
        let tracking = match &self.approach.tracking {
            Tracking::Own { name, numbers } => Some((*name, numbers)),
            _ => None,
        };
        let post_capture = match self.post_impact.as_ref().map(|after| &after.control) {
            Some(PostCaptureControl::Own { name, numbers }) => Some((*name, numbers)),
            _ => None,
        };
        [tracking, post_capture]
    }

    /// The names of all cases, in the order of the file.
    #[must_use]
    pub fn case_names(&self) -> Vec<&str> {
        let own = self.variants.iter().flat_map(|variant| &variant.scenario.cases);
        let mut cases: Vec<_> = self.cases.iter().chain(own).collect();
        cases.sort_by_key(|case| case.index);
        cases.into_iter().map(|case| case.name.as_str()).collect()
    }

    /// The case of this name, where it has values of its own.
    #[must_use]
    pub fn variant(&self, case: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name() == case)
    }

    /// What is computed: this scenario with its cases, where it has any, and each case with values of its own.
    pub fn parts(&self) -> impl Iterator<Item = (&Self, Option<&Variant>)> {
        let common = (!self.cases.is_empty()).then_some((self, None));
        common.into_iter().chain(self.variants.iter().map(|variant| (&variant.scenario, Some(variant))))
    }

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
