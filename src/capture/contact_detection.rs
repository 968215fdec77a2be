//! Contacts found by detection: the gaps between tips and their targets as events.

use crate::capture::assembly::{Assembly, turned};
use crate::error::Error;
use crate::scenario::Scenario;
use crate::simulate::event::{Events, Instant};
use crate::simulate::system::Body;

/// How the targets move meanwhile.
#[derive(Clone, Copy)]
pub enum TargetMotion<'a> {
    /// All of them freely, from these poses at the start of the phase.
    Free(&'a [Body]),
    /// As an assembly has them; these are their properties.
    Assembled(&'a Assembly, &'a [Body]),
}

/// One value for each pair of a tip and its target that may meet: the distance of the tip from the target's outline, m,
/// negative inside.
pub struct ContactDetection<'a> {
    scenario: &'a Scenario,
    flight: TargetMotion<'a>,
    pairs: Vec<ContactPair>,
    tips: Vec<[f64; 3]>,
}

/// A tip and a target.
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
        Self { scenario, flight, pairs, tips: vec![[0.0; 3]; scenario.layout.arms.len()] }
    }
}

/// Distance and outward normal, inertial axes, of a tip from a target of the scenario.
pub(crate) fn gap(scenario: &Scenario, target: usize, body: &Body, tip: &[f64; 3]) -> (f64, [f64; 2]) {
    let [yaw, x, y] = body.pose;
    match scenario.targets.get(target) {
        Some(target) => {
            let gap = target.surface.gap(turned([tip[1] - x, tip[2] - y], -yaw));
            (gap.distance, turned(gap.normal, yaw))
        }
        None => (f64::INFINITY, [1.0, 0.0]),
    }
}

impl Events for ContactDetection<'_> {
    fn count(&self) -> usize {
        self.pairs.len()
    }

    fn values(&mut self, now: &Instant<'_>, values: &mut [f64]) -> Result<(), Error> {
        let model = now.system.model;
        model.end_effector_poses(&now.state.base_pose, now.state.joint_angles, &mut self.tips)?;
        let targets = match self.flight {
            TargetMotion::Free(targets) => targets.iter().map(|target| target.after(now.time)).collect(),
            // of twists nothing is asked
            TargetMotion::Assembled(assembly, targets) => assembly.targets(targets, &self.tips, &self.tips, now.bodies),
        };
        for (value, pair) in values.iter_mut().zip(&self.pairs) {
            let (Some(body), Some(tip)) = (targets.get(pair.target), self.tips.get(pair.arm)) else { continue };
            (*value, _) = gap(self.scenario, pair.target, body, tip);
        }
        Ok(())
    }
}
