//! By how much an end effector misses where it was wanted.

use crate::scenario::{EndEffectorGoal, Scenario};
use crate::simulate::Phase;
use std::fmt::{Display, Formatter};

/// Outboard this part of its reach, or so many rad, an end effector is not where it was wanted.
const REACHED: f64 = 1e-3;

/// Wanted less reached at the end of an approach.
#[derive(Clone, Debug, PartialEq)]
pub struct TerminalError {
    /// As the goal has them: [yaw, x, y] or [x, y]; rad to the nearest turn, m.
    pub parts: Vec<f64>,
    /// m.
    pub distance: f64,
    /// Its size, rad; `None` where the yaw is free.
    pub yaw: Option<f64>,
    /// Whether that is little: less than 1e-3 of the arm's reach, and 1e-3 rad.
    pub reached: bool,
}

impl TerminalError {
    /// One per arm, `None` for an arm that may end anywhere; empty where no end effector poses are wanted.
    #[must_use]
    pub fn of(scenario: &Scenario, phase: &Phase) -> Vec<Option<Self>> {
        let (Some(goals), Some(end)) = (&scenario.approach.final_end_effector_poses, phase.end()) else {
            return Vec::new();
        };
        let arms = goals.iter().zip(&end.end_effector_poses).zip(&scenario.layout.arms);
        arms.map(|((goal, pose), arm)| Self::at(goal, pose, arm.reach())).collect()
    }

    fn at(goal: &EndEffectorGoal, pose: &[f64; 3], reach: f64) -> Option<Self> {
        let parts: Vec<f64> = goal.missing(pose).map(|(_, missing)| missing).collect();
        let (yaw, distance) = match parts.as_slice() {
            [x, y] => (None, x.hypot(*y)),
            [yaw, x, y] => (Some(yaw.abs()), x.hypot(*y)),
            _ => return None,
        };
        let reached = distance <= REACHED * reach && yaw.is_none_or(|yaw| yaw <= REACHED);
        Some(Self { parts, distance, yaw, reached })
    }
}

impl Display for TerminalError {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2e} m", self.distance)?;
        self.yaw.map_or(Ok(()), |yaw| write!(f, ", {yaw:.2e} rad"))
    }
}
