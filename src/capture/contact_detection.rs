//! Contact detection: events where the signed distance of an end effector from the outline of its target falls to zero.

use crate::capture::assembly::rotated;
use crate::capture::target_motion::TargetMotion;
use crate::error::Error;
use crate::outline::SignedDistance;
use crate::scenario::Scenario;
use crate::simulate::event::{EventState, Events};
use crate::simulate::system::Body;

/// One event for each pair: its value is the distance of the end effector from the outline of the target, m, negative
/// inside.
pub struct ContactDetection<'a> {
    scenario: &'a Scenario,
    motion: TargetMotion<'a>,
    pairs: Vec<ContactPair>,
    end_effectors: Vec<[f64; 3]>,
}

/// An end effector and a target that may come into contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ContactPair {
    /// Index of the target.
    pub target: usize,
    /// Index of the contact among the target's.
    pub contact: usize,
    /// Index of the arm.
    pub arm: usize,
}

impl<'a> ContactDetection<'a> {
    /// Detects the contacts of these pairs.
    #[must_use]
    pub fn new(scenario: &'a Scenario, motion: TargetMotion<'a>, pairs: Vec<ContactPair>) -> Self {
        Self { scenario, motion, pairs, end_effectors: vec![[0.0; 3]; scenario.layout.arms.len()] }
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
    let point = rotated([end_effector[1] - x, end_effector[2] - y], -yaw);
    let SignedDistance { distance, normal } = scenario.targets[target].outline.signed_distance(point);
    (distance, rotated(normal, yaw))
}

impl Events for ContactDetection<'_> {
    fn count(&self) -> usize {
        self.pairs.len()
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        let model = now.system.model;
        model.end_effector_poses(&now.state.base_pose, now.state.joint_angles, &mut self.end_effectors)?;
        let targets = match self.motion {
            TargetMotion::Free(targets) => targets.iter().map(|target| target.after(now.time)).collect(),
            // the twists are not used
            TargetMotion::Assembled(assembly, targets) => {
                assembly.targets(targets, &self.end_effectors, &self.end_effectors, now.bodies)
            }
        };
        for (value, pair) in values.iter_mut().zip(&self.pairs) {
            let (body, end_effector) = (&targets[pair.target], &self.end_effectors[pair.arm]);
            (*value, _) = signed_distance(self.scenario, pair.target, body, end_effector);
        }
        Ok(())
    }
}
