//! A target that is merged with the robot and so heavy that the momentum is not conserved as usual, and what helps.
//!
//! # Example
//! ```
//! use planar_capture::capture::heavy_target::HeavyTarget;
//!
//! let target = HeavyTarget { mass: 200.0, inertia: 50.0, is_reducible: true };
//! assert!(target.remedy().contains("`post_impact.coordinates = \"reduced\"`"));
//! // beyond 1e5 times the robot's mass reduced coordinates do not help either
//! let asteroid = HeavyTarget { mass: 1e7, ..target };
//! assert!(asteroid.remedy().contains("double precision does not resolve the momentum"));
//! ```

use crate::capture::assembly::{Assembly, TargetPlacement};
use crate::scalar::Real;
use crate::scenario::Scenario;
use crate::simulate::stepper::{Formulation, Integration};
use crate::simulate::system::Body;

/// Mass over the robot's from which the errors of the base's and joints' rates, times the target's mass, are seen in the
/// momentum. At the default tolerance drifts of a target at rest exceed their bound from some 100.
const FROM: f64 = 100.0;

/// Mass over the robot's, or inertia over the robot's mass · reach², up to which the momentum is conserved within its bound
/// whatever the motion. The target's velocity is a difference of those of base and joints, rounded to some 1e-16 of these.
/// Where the target is all but at rest, its momentum is that of the robot, of which that rounding is 5e-15 times the
/// ratio (measured, 1e3 to 1e8): 1e-9 at 2e5.
const MOST: f64 = 1e5;

/// Of the targets that are merged with the robot, how far the heaviest is from what double precision resolves.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HeavyTarget {
    /// Its mass over the robot's.
    pub mass: f64,
    /// The largest inertia over the robot's mass · reach².
    pub inertia: f64,
    /// Whether reduced coordinates could integrate the motion and do not.
    pub is_reducible: bool,
}

impl HeavyTarget {
    /// Of an assembly and its targets in a phase; `None` where none is far heavier than the robot.
    pub(crate) fn of(scenario: &Scenario, assembly: &Assembly, targets: &[Body], by: Integration) -> Option<Self> {
        let (robot, reach) = (scenario.layout.mass(), scenario.reach());
        let merged = targets.iter().zip(&assembly.places);
        let merged = merged.filter(|(_, place)| matches!(place, TargetPlacement::Merged { .. }));
        let sizes = merged.map(|(body, _)| [body.mass / robot, body.inertia / (robot * reach * reach)]);
        let [mass, inertia] = sizes.fold([0.0; 2], |most, size| [0, 1].map(|i| Real::maximum(most[i], size[i])));
        let is_alone = assembly.system().beside() == 0;
        let is_full = by.coordinates == Formulation::Full && !by.integrator.properties().is_canonical;
        (mass > FROM || inertia > MOST).then_some(Self { mass, inertia, is_reducible: is_alone && is_full })
    }

    /// What a drift of the momentum follows from, and what helps.
    #[must_use]
    pub fn remedy(&self) -> String {
        let Self { mass, inertia, is_reducible } = *self;
        let beyond = [(mass, "mass"), (inertia, "mass · reach²")].into_iter().find(|(ratio, _)| *ratio > MOST);
        if let Some((ratio, what)) = beyond {
            let till_there =
                if is_reducible { " `post_impact.coordinates = \"reduced\"` does up to there," } else { "" };
            return format!(
                "the robot holds a target of {ratio:.1e} times its {what}, and beyond {MOST:.0e} times double precision does \
                 not resolve the momentum of one that is all but at rest;{till_there} and a target of {MOST:.0e} times moves \
                 the robot alike"
            );
        }
        let help = if is_reducible {
            "`post_impact.coordinates = \"reduced\"` conserves the momentum"
        } else {
            "a smaller `post_impact.tolerance` makes it less"
        };
        format!(
            "the robot holds a target of {mass:.1e} times its mass, by which the errors of rates are multiplied: {help}"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::HeavyTarget;
    use crate::capture::assembly::{Assembly, Attachment};
    use crate::contact::ContactKind;
    use crate::owned::RobotState;
    use crate::registry;
    use crate::scenario::Scenario;
    use crate::simulate::stepper::{Formulation, Integration, Integrator};
    use crate::simulate::system::Body;
    use planar_proof::{file, layout};

    /// m · reach² of the robot with a disc: 210 kg, and the stretched arm with its longest link once more and two radii, m.
    const UNIT: f64 = 210.0 * (1.9 + 0.8 + 2.0 * 0.5) * (1.9 + 0.8 + 2.0 * 0.5);

    #[test]
    fn inertias_are_compared_with_mass_and_reach_squared() {
        let text = "name = \"it\"\nlayout = \"single_arm_2r\"\n[initial]\njoint_angles = [0.4, -0.9]\n[approach]\n\
                    duration = 1.0\ntrajectory = \"cycloidal\"\nfinal_joint_angles = [0.4, -0.9]\n\
                    [[target]]\nname = \"disc\"\narm = \"arm1\"\nmass = 1.0\ninertia = 1.0\ncontact = [0.0, 0.5]\n\
                    radius = 0.5\n[post_impact]\nduration = 1.0\n";
        let scenario = Scenario::parse(text, "it.toml", &file("scenarios"), registry::SHIPPED).expect("a scenario");
        let (base_pose, base_twist) = ([0.0; 3], [0.0; 3]);
        let state = RobotState { base_pose, joint_angles: vec![0.4, -0.9], base_twist, joint_rates: vec![0.0; 2] };
        let by = |ratio: f64, integration: Integration| {
            let target = Body { mass: 1.0, inertia: ratio * UNIT, pose: [0.0, 1.5, 0.5], twist: [0.0; 3] };
            let grasp = Attachment { target: 0, arm: 0, kind: ContactKind::Rigid };
            let model = registry::generic(&layout("single_arm_2r"));
            let assembly = Assembly::new(model, &state, &[target], &[grasp]).expect("an assembly");
            HeavyTarget::of(&scenario, &assembly, &[target], integration)
        };
        let of = |ratio: f64| by(ratio, Integration::default());
        assert_eq!(of(0.9e5), None);
        let found = of(1.5e5).expect("a heavy target");
        assert!((found.inertia / 1.5e5 - 1.0).abs() < 1e-9 && found.mass < 0.01, "{found:?}");
        // canonical variables and reduced coordinates are no coordinates that reduced ones could replace
        for integrator in Integrator::ALL {
            for coordinates in [Formulation::Full, Formulation::Reduced] {
                let found = by(1.5e5, Integration { integrator: *integrator, coordinates }).expect("a heavy target");
                let expected = coordinates == Formulation::Full && *integrator != Integrator::GaussLegendre;
                assert_eq!(found.is_reducible, expected, "{integrator:?} {coordinates:?}");
            }
        }
    }

    /// The first of two targets is free, and the second one is held and heavy.
    #[test]
    fn every_held_target_counts() {
        let disc = |name: &str, arm: &str| {
            format!(
                "[[target]]\nname = \"{name}\"\narm = \"{arm}\"\nmass = 1.0\ninertia = 1.0\ncontact = [0.0, 0.5]\n\
                 radius = 0.5\n"
            )
        };
        let angles = "[0.4, -0.9, 2.4, 0.9]";
        let text = format!(
            "name = \"it\"\nlayout = \"dual_arm_2r\"\n[initial]\njoint_angles = {angles}\n[approach]\nduration = 1.0\n\
             trajectory = \"cycloidal\"\nfinal_joint_angles = {angles}\n{}{}[post_impact]\nduration = 1.0\n",
            disc("first", "arm1"),
            disc("second", "arm2")
        );
        let scenario = Scenario::parse(&text, "it.toml", &file("scenarios"), registry::SHIPPED).expect("a scenario");
        let joint_angles = scenario.initial.joint_angles.clone();
        let state = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0; 3], joint_rates: vec![0.0; 4] };
        let body = |mass: f64, x: f64| Body { mass, inertia: 1.0, pose: [0.0, x, 0.5], twist: [0.0; 3] };
        let targets = [body(1.0, 9.0), body(1e3 * scenario.layout.mass(), -1.5)];
        let grasp = Attachment { target: 1, arm: 1, kind: ContactKind::Rigid };
        let model = registry::generic(&layout("dual_arm_2r"));
        let assembly = Assembly::new(model, &state, &targets, &[grasp]).expect("an assembly");
        let found = HeavyTarget::of(&scenario, &assembly, &targets, Integration::default()).expect("a heavy target");
        assert!((found.mass / 1e3 - 1.0).abs() < 1e-12 && !found.is_reducible, "{found:?}");
        // merged with one arm, and in a closed loop with the other
        let both = [grasp, Attachment { arm: 0, ..grasp }];
        let model = registry::generic(&layout("dual_arm_2r"));
        let assembly = Assembly::new(model, &state, &targets[1..], &both.map(|it| Attachment { target: 0, ..it }));
        let assembly = assembly.expect("an assembly");
        let found =
            HeavyTarget::of(&scenario, &assembly, &targets[1..], Integration::default()).expect("a heavy target");
        assert!(assembly.bodies.is_empty() && !found.is_reducible, "{found:?}");
    }
}
