//! Terminal errors: desired less reached end effector poses at the end of an approach.
//!
//! # Example
//! ```
//! use planar_capture::capture::{approach::ApproachTracking, terminal_error::TerminalError};
//! use planar_capture::registry;
//! use planar_capture::scenario::{EndEffectorGoal, Scenario};
//! use planar_capture::simulate::event::NoEvents;
//!
//! let path = "scenarios/redysim_single_arm_3r.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! let robot = registry::generated(&scenario.layout)?;
//! let approach = ApproachTracking::new(&scenario, 1.0);
//! let phase = approach.track(&*robot, &[0.0; 3], &mut NoEvents, &mut || ())?;
//! // a goal 3 cm to the right and 4 cm below
//! let [_, x, y] = phase.end().end_effector_poses[0];
//! scenario.approach.final_end_effector_poses = Some(vec![EndEffectorGoal::Position([x + 0.03, y - 0.04])]);
//! let errors = TerminalError::of(&scenario, &phase);
//! let error = errors[0].as_ref().expect("a goal");
//! assert!((error.distance - 0.05).abs() < 1e-12 && !error.reached);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use crate::scenario::{EndEffectorGoal, Scenario};
use crate::simulate::Phase;
use std::fmt::{Display, Formatter};

/// Largest error of a pose that counts as reached: m per m of the arm's reach, and rad.
const TOLERANCE: f64 = 1e-3;

/// Desired less reached pose of an end effector at the end of an approach.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TerminalError {
    /// As the goal has them: [yaw, x, y] or [x, y]; rad to the nearest turn, m.
    pub parts: Vec<f64>,
    /// m.
    pub distance: f64,
    /// Absolute error of the yaw, rad; `None` where the yaw is free.
    pub yaw: Option<f64>,
    /// Whether the errors are at most 1e-3 of the arm's reach and 1e-3 rad.
    pub reached: bool,
}

impl TerminalError {
    /// One per arm, `None` for an arm that may end anywhere; empty where the scenario gives no end effector poses.
    #[must_use]
    pub fn of(scenario: &Scenario, phase: &Phase) -> Vec<Option<Self>> {
        let goals = scenario.approach.final_end_effector_poses.iter().flatten();
        let arms = goals.zip(&phase.end().end_effector_poses).zip(&scenario.layout.arms);
        arms.map(|((goal, pose), arm)| Self::at(goal, pose, arm.reach())).collect()
    }

    fn at(goal: &EndEffectorGoal, pose: &[f64; 3], reach: f64) -> Option<Self> {
        let parts: Vec<f64> = goal.errors(pose).map(|(_, error)| error).collect();
        let (yaw, distance) = match parts.as_slice() {
            [x, y] => (None, libm::hypot(*x, *y)),
            [yaw, x, y] => (Some(yaw.abs()), libm::hypot(*x, *y)),
            _ => return None,
        };
        let reached = distance <= TOLERANCE * reach && yaw.is_none_or(|yaw| yaw <= TOLERANCE);
        Some(Self { parts, distance, yaw, reached })
    }
}

impl Display for TerminalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2e} m", self.distance)?;
        self.yaw.map_or(Ok(()), |yaw| write!(f, ", {yaw:.2e} rad"))
    }
}

#[cfg(test)]
mod tests;
