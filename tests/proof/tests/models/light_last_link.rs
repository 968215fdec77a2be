//! A last link of mass and inertia ε, without torque, changes the rest by O(ε): a robot of one link less is its limit.

use planar_capture::generated::{dual_arm_2r, dual_arm_3r, single_arm_2r, single_arm_3r};
use planar_capture::manifest::{Manifest, ParameterKind};
use planar_proof::sample::{RandomState, config, sample};
use proptest::prelude::*;

/// Parameters of the longer robot: the shorter one's, and a last link of every arm of mass and inertia ε.
fn lengthened(longer: &Manifest, shorter: &Manifest, epsilon: f64) -> Vec<f64> {
    let default = |q, arm, link| {
        shorter.position(q, arm, link).and_then(|i| shorter.parameters.get(i)).map_or(0.0, |p| p.default)
    };
    let value = |quantity, arm, link| {
        let is_tip = link == shorter.links[arm];
        match quantity {
            ParameterKind::LinkLength if is_tip => 0.6,
            ParameterKind::LinkComX if is_tip => 0.3,
            ParameterKind::LinkMass | ParameterKind::LinkInertia if is_tip => epsilon,
            ParameterKind::LinkComY if is_tip => 0.0,
            _ => default(quantity, arm, link),
        }
    };
    longer.parameters.iter().map(|p| value(p.kind, p.arm, p.link)).collect()
}

/// The shorter robot's values among the longer one's, arm by arm.
fn inner<'a>(values: &'a [f64], links: &'a [usize]) -> impl Iterator<Item = f64> + 'a {
    let mut start = 0;
    links.iter().flat_map(move |n| {
        let arm = &values[start..=start + n];
        start += n + 1;
        arm[..*n].iter().copied()
    })
}

macro_rules! light_last_link {
    ($test:ident, $shorter:ident, $longer:ident) => {
        proptest! {
            #![proptest_config(config())]

            #[test]
            fn $test(s in sample($longer::ARMS, $longer::JOINTS)) {
                let RandomState { base_pose, joint_angles, base_twist, joint_rates, joint_torques, .. } = &s;
                let links = $shorter::MANIFEST.links;
                let short = |values: &[f64]| -> [f64; $shorter::JOINTS] {
                    inner(values, links).collect::<Vec<_>>().try_into().expect("as many")
                };
                let long = |values: &[f64]| -> [f64; $longer::JOINTS] { values.try_into().expect("as many") };
                let torques = short(joint_torques);
                let mut with_tip = [0.0; $longer::JOINTS];
                let (mut place, mut from) = (0, 0);
                for n in links {
                    with_tip[place..place + n].copy_from_slice(&torques[from..from + n]);
                    (place, from) = (place + n + 1, from + n);
                }
                let expected = $shorter::Model::<f64>::default().forward_dynamics(
                    base_pose, &short(joint_angles), base_twist, &short(joint_rates), &torques,
                );
                let difference = |epsilon: f64| {
                    let values = lengthened(&$longer::MANIFEST, &$shorter::MANIFEST, epsilon);
                    let model = $longer::Model::new($longer::Parameters::from_array(values.try_into().expect("as many")));
                    let found = model.forward_dynamics(
                        base_pose, &long(joint_angles), base_twist, &long(joint_rates), &with_tip,
                    );
                    let joints = short(&found.joint_accelerations).into_iter().zip(expected.joint_accelerations);
                    let base = found.base_acceleration.into_iter().zip(expected.base_acceleration);
                    joints.chain(base).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
                };
                // ε = 1e-4 kg and 1e-6 kg: a hundredth of the mass, a hundredth of the difference
                let (coarse, fine) = (difference(1e-4), difference(1e-6));
                prop_assume!(coarse > 1e-8); // below it, rounding dominates
                prop_assert!((coarse / fine / 100.0 - 1.0).abs() < 0.05, "{coarse:e} and {fine:e} are not a hundred apart");
            }
        }
    };
}

light_last_link!(single_arm, single_arm_2r, single_arm_3r);
light_last_link!(both_arms, dual_arm_2r, dual_arm_3r);
