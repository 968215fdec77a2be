//! The origin that a study is computed about: the base's position at the start, so that a robot far from the inertial
//! origin loses no digits of the distances between its end effectors and targets.
//!
//! Mechanics does not depend on the origin but for positions and the angular momentum about it,
//! `l = l' + r × p`. Conservation is audited about the same point.

use crate::capture::Study;
use crate::capture::impact::{ImpactResult, ImpactSolution};
use crate::scenario::{EndEffectorGoal, Scenario};
use crate::simulate::translation::{moment, translate, translate_bodies};

/// A position [x, y], m, inertial frame.
#[derive(Clone, Copy)]
pub(crate) struct Origin([f64; 2]);

impl Origin {
    /// Of a scenario; `None` where it is the inertial origin.
    pub(crate) fn of(scenario: &Scenario) -> Option<Self> {
        let [_, x, y] = scenario.initial.base_pose;
        (x != 0.0 || y != 0.0).then_some(Self([x, y]))
    }

    /// [x, y], m, inertial frame.
    pub(crate) fn position(self) -> [f64; 2] {
        self.0
    }

    /// The scenario with its positions counted from here.
    pub(crate) fn relative(self, scenario: &Scenario) -> Scenario {
        let mut scenario = scenario.clone();
        self.subtract(&mut scenario.initial.base_pose);
        for position in scenario.targets.iter_mut().filter_map(|target| target.position.as_mut()) {
            self.subtract(position);
        }
        for goal in scenario.approach.final_end_effector_poses.iter_mut().flatten() {
            match goal {
                EndEffectorGoal::Any => {}
                EndEffectorGoal::Position(position) => self.subtract(position),
                EndEffectorGoal::Pose(pose) => self.subtract(pose),
            }
        }
        scenario
    }

    /// The results of that scenario with positions and angular momenta from and about the inertial origin.
    pub(crate) fn absolute(self, mut study: Study) -> Study {
        study.approach.translate(self.0);
        for case in &mut study.cases {
            case.approach.iter_mut().for_each(|approach| approach.translate(self.0));
            translate_bodies(&mut case.targets, self.0);
            let Some(capture) = &mut case.capture else { continue };
            let later = capture.later_impacts.iter_mut().map(|later| &mut later.impact);
            for ImpactSolution { exact, paper, .. } in std::iter::once(&mut capture.impact).chain(later) {
                self.impact(exact);
                if let Some(paper) = paper {
                    self.impact(paper);
                }
            }
            capture.post_impact.translate(self.0);
            capture.targets.iter_mut().for_each(|targets| translate_bodies(targets, self.0));
        }
        study
    }

    fn impact(self, impact: &mut ImpactResult) {
        let [l, px, py] = &mut impact.momentum_jump;
        *l += moment(self.0, [*px, *py]);
    }

    /// Moves [x, y] or [yaw, x, y] from the inertial frame to this origin.
    fn subtract(self, pose: &mut [f64]) {
        translate(pose, self.0.map(|value| -value));
    }
}

#[cfg(test)]
mod tests;
