//! Contacts found by detection: the gaps between end effectors and their targets as events.

use crate::capture::assembly::{Assembly, turned};
use crate::error::Error;
use crate::scenario::Scenario;
use crate::simulate::event::{EventState, Events};
use crate::simulate::system::Body;

/// How the targets move meanwhile.
#[derive(Clone, Copy)]
pub enum TargetMotion<'a> {
    /// All of them freely, from these poses at the start of the phase.
    Free(&'a [Body]),
    /// As an assembly has them; these are their properties.
    Assembled(&'a Assembly, &'a [Body]),
}

/// One value for each pair of an end effector and its target that may meet: the distance of the end effector from the
/// target's outline, m, negative inside.
pub struct ContactDetection<'a> {
    scenario: &'a Scenario,
    flight: TargetMotion<'a>,
    pairs: Vec<ContactPair>,
    end_effectors: Vec<[f64; 3]>,
}

/// An end effector and a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactPair {
    /// Index of the target.
    pub target: usize,
    /// Which of its touches.
    pub touch: usize,
    /// Index of the arm.
    pub arm: usize,
}

impl<'a> ContactDetection<'a> {
    /// Watches these pairs.
    #[must_use]
    pub fn new(scenario: &'a Scenario, flight: TargetMotion<'a>, pairs: Vec<ContactPair>) -> Self {
        Self { scenario, flight, pairs, end_effectors: vec![[0.0; 3]; scenario.layout.arms.len()] }
    }
}

/// Distance and outward normal, inertial axes, of an end effector from a target of the scenario.
pub(crate) fn signed_distance(
    scenario: &Scenario,
    target: usize,
    body: &Body,
    end_effector: &[f64; 3],
) -> (f64, [f64; 2]) {
    let [yaw, x, y] = body.pose;
    match scenario.targets.get(target) {
        Some(target) => {
            let signed_distance =
                target.outline.signed_distance(turned([end_effector[1] - x, end_effector[2] - y], -yaw));
            (signed_distance.distance, turned(signed_distance.normal, yaw))
        }
        None => (f64::INFINITY, [1.0, 0.0]),
    }
}

impl Events for ContactDetection<'_> {
    fn count(&self) -> usize {
        self.pairs.len()
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        let model = now.system.model;
        model.end_effector_poses(&now.state.base_pose, now.state.joint_angles, &mut self.end_effectors)?;
        let targets = match self.flight {
            TargetMotion::Free(targets) => targets.iter().map(|target| target.after(now.time)).collect(),
            // of twists nothing is asked
            TargetMotion::Assembled(assembly, targets) => {
                assembly.targets(targets, &self.end_effectors, &self.end_effectors, now.bodies)
            }
        };
        for (value, pair) in values.iter_mut().zip(&self.pairs) {
            let (Some(body), Some(end_effector)) = (targets.get(pair.target), self.end_effectors.get(pair.arm)) else {
                continue;
            };
            (*value, _) = signed_distance(self.scenario, pair.target, body, end_effector);
        }
        Ok(())
    }
}
