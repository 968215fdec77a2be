//! The product's impacts, in joint coordinates with the inverse inertia at the contacts, against the reference.

use crate::product::{self, Outcome, body, both_models, law, targets_and_contacts};
use crate::{add_target, robot, robot_state};
use planar_capture::capture::assembly::{Assembly, Attachment};
use planar_capture::capture::contact_at_time::ImpactContact;
use planar_capture::capture::impact::{ImpactResult, ImpactSolution, solve_impact};
use planar_capture::contact::{self, ContactKind, ContactPartner};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r;
use planar_capture::layout::Layout;
use planar_capture::state::State;
use planar_proof::maximal::impact::{Contact, Impact, Kind, ProductImpact, impact};
use planar_proof::maximal::random::{PlannedContact, Scene, random_contacts};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{close, for_every_layout, layout, tolerance};
use proptest::prelude::*;

/// The reference's impact and the bodies after it.
fn reference(layout: &Layout, scene: &Scene) -> (Impact, System) {
    let mut all = scene.system(layout);
    let contacts = scene.contacts(&all);
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    (found, all)
}

/// Compares velocities and impulses; dependent contacts are refused.
fn check(layout: &Layout, scene: &Scene) {
    let (expected, after) = reference(layout, scene);
    let (bodies, contacts) = targets_and_contacts(scene);
    for model in both_models(layout) {
        match product::solve_impact(&*model, &scene.state.state(), &bodies, &contacts) {
            Ok(found) => {
                let admissible = !expected.redundant || expected.margin < tolerance::DEPENDENCE_MARGIN;
                assert!(admissible, "dependent contacts were solved: {found:?}\n{expected:?}");
                let bound = tolerance::CONTACT_IMPACT / expected.margin.powi(2);
                close("velocities", &found.velocities(), &after.velocities(), bound);
                if !expected.redundant && !expected.bounces_redundant {
                    close("impulses", found.impulses.as_flattened(), expected.impulses.as_flattened(), bound);
                }
            }
            Err(Error::Singular { .. }) => assert!(expected.redundant || expected.bounces_redundant, "{expected:?}"),
            Err(error) => panic!("{error}"),
        }
    }
}

macro_rules! mixtures {
    ($($layout:ident)*) => {
        proptest! {
            #![proptest_config(config())]
            $(
            #[test]
            fn $layout(scene in random_contacts(layout(stringify!($layout)))) {
                check(&layout(stringify!($layout)), &scene);
            })*
        }
    };
}
for_every_layout!(mixtures);

/// Arms of one link, which have too few joints for most loops.
fn short_arms(name: &str) -> Layout {
    let mut short = layout(name);
    short.arms.iter_mut().for_each(|arm| arm.links.truncate(1));
    short
}

/// The scene with captures of these kinds, by the first arms, of one target.
fn captures_of_one_target(layout: &Layout, mut scene: Scene, kinds: &[Kind]) -> Scene {
    let all = scene.system(layout);
    scene.targets.truncate(1);
    let com = scene.targets[0].com();
    let contact = |(arm, kind): (usize, &Kind)| PlannedContact {
        arm,
        target: 0,
        offset: (all.end_effector(arm) - com).into(),
        kind: *kind,
    };
    scene.planned = kinds.iter().enumerate().map(contact).collect();
    scene
}

proptest! {
    #![proptest_config(config())]

    /// Two arms of one link close a loop with a pin, but no rigid one; a third arm makes it redundant.
    #[test]
    fn dependent_contacts_are_refused(
        one in random_contacts(short_arms("dual_arm_3r")),
        other in random_contacts(short_arms("triple_arm_3r")),
    ) {
        for (kinds, redundant) in [([Kind::Rigid; 2], true), ([Kind::Rigid, Kind::Pin], false), ([Kind::Pin; 2], false)] {
            let layout = short_arms("dual_arm_3r");
            let scene = captures_of_one_target(&layout, one.clone(), &kinds);
            prop_assert_eq!(reference(&layout, &scene).0.redundant, redundant);
            check(&layout, &scene);
        }
        let layout = short_arms("triple_arm_3r");
        let scene = captures_of_one_target(&layout, other, &[Kind::Rigid, Kind::Pin, Kind::Pin]);
        prop_assert!(reference(&layout, &scene).0.redundant);
        check(&layout, &scene);
    }

    /// Repeated captures are refused; a repeated bounce gives the same motion, and the two impulses sum to the one.
    #[test]
    fn the_same_contact_twice(scene in random_contacts(layout("dual_arm_3r"))) {
        let layout = layout("dual_arm_3r");
        let (expected, after) = reference(&layout, &scene);
        let (bodies, mut contacts) = targets_and_contacts(&scene);
        contacts.push(contacts[0]);
        let bound = tolerance::CONTACT_IMPACT / expected.margin.powi(2);
        for model in both_models(&layout) {
            let found = product::solve_impact(&*model, &scene.state.state(), &bodies, &contacts);
            if let Kind::Bounce { .. } = scene.planned[0].kind {
                let mut found = found.expect("an impact");
                close("velocities", &found.velocities(), &after.velocities(), bound);
                let again = found.impulses.pop().expect("an impulse");
                found.impulses[0].iter_mut().zip(again).for_each(|(sum, part)| *sum += part);
                close("impulses", found.impulses.as_flattened(), expected.impulses.as_flattened(), bound);
            } else {
                prop_assert!(matches!(found, Err(Error::Singular { .. })), "{:?}", found);
            }
        }
    }

    /// In single precision, with a larger bound.
    #[test]
    fn in_single_precision(scene in random_contacts(layout("dual_arm_3r"))) {
        let layout = layout("dual_arm_3r");
        let (expected, after) = reference(&layout, &scene);
        let (bodies, contacts) = targets_and_contacts(&scene);
        let found = solve_in_single_precision(&scene.state, &bodies, &contacts).expect("an impact");
        let bound = tolerance::CONTACT_IMPACT_SINGLE / expected.margin.powi(2);
        close("velocities", &found.velocities(), &after.velocities(), bound);
        let impulses: Vec<f64> = found.impulses.as_flattened().iter().map(|p| f64::from(*p)).collect();
        close("impulses", &impulses, expected.impulses.as_flattened(), bound);
    }
}

/// [`product::solve_impact`] with rounded input.
#[allow(clippy::cast_possible_truncation, reason = "that is the test")]
fn solve_in_single_precision(
    s: &RandomState,
    bodies: &[planar_capture::body::Body<f64>],
    contacts: &[contact::Contact<f64>],
) -> Result<Outcome<f32>, Error> {
    let single = |values: [f64; 3]| values.map(|value| value as f32);
    let body = |b: &planar_capture::body::Body<f64>| planar_capture::body::Body {
        mass: b.mass as f32,
        inertia: b.inertia as f32,
        pose: single(b.pose),
        twist: single(b.twist),
    };
    let contact = |c: &contact::Contact<f64>| contact::Contact {
        arm: c.arm,
        partner: c.partner,
        offset: c.offset.map(|value| value as f32),
        law: match c.law {
            contact::ContactLaw::Rigid => contact::ContactLaw::Rigid,
            contact::ContactLaw::Pin => contact::ContactLaw::Pin,
            contact::ContactLaw::Bounce { normal, restitution } => {
                contact::ContactLaw::Bounce { normal: normal.map(|n| n as f32), restitution: restitution as f32 }
            }
        },
    };
    let bodies: Vec<_> = bodies.iter().map(body).collect();
    let contacts: Vec<_> = contacts.iter().map(contact).collect();
    let angles: Vec<f32> = s.joint_angles.iter().map(|angle| *angle as f32).collect();
    let rates: Vec<f32> = s.joint_rates.iter().map(|rate| *rate as f32).collect();
    let state = State {
        base_pose: single(s.base_pose),
        joint_angles: &angles,
        base_twist: single(s.base_twist),
        joint_rates: &rates,
    };
    product::solve_impact(&dual_arm_3r::Model::<f32>::default(), &state, &bodies, &contacts)
}

/// Velocities and impulses of a study's impact.
fn product_impact(found: &ImpactSolution) -> ProductImpact {
    let ImpactResult { base_twist_after, joint_rates_after, .. } = &found.exact;
    let velocities = base_twist_after.iter().chain(joint_rates_after).chain(found.target_twists.as_flattened());
    let impulses = found.contacts.iter().map(|contact| contact.impulse).collect();
    ProductImpact { velocities: velocities.copied().collect(), impulses }
}

fn impact_kinds() -> impl Strategy<Value = Kind> {
    let bounce = (-3.2..3.2_f64, 0.0..1.0_f64).prop_map(|(direction, restitution)| {
        let (sin, cos) = direction.sin_cos();
        Kind::Bounce { normal: [cos, sin], restitution }
    });
    prop_oneof![Just(Kind::Rigid), Just(Kind::Pin), bounce.clone(), bounce]
}

/// A robot of three arms with targets at the end effectors of arms 0 and 2, of which it has captured the first.
struct AfterCapture {
    before: System,
    /// Indices of the targets among the reference's bodies.
    bodies: [usize; 2],
    captures: Vec<Contact>,
}

fn after_capture(layout: &Layout, s: &RandomState, kinds: &[(usize, Kind)]) -> AfterCapture {
    let mut before = robot(layout, s);
    let bodies = [0, 1].map(|i| add_target(&mut before, &s.targets[i], 2 * i, 0.2));
    let captures: Vec<_> = kinds.iter().map(|(arm, kind)| Contact::new(&before, *arm, bodies[0], *kind)).collect();
    before.apply(&captures, &impact(&before, &captures));
    AfterCapture { before, bodies, captures }
}

impl AfterCapture {
    /// The targets in the product's terms.
    fn targets(&self) -> Vec<planar_capture::body::Body<f64>> {
        self.bodies.iter().map(|index| body(&self.before.bodies[*index])).collect()
    }
}

proptest! {
    #![proptest_config(config())]

    /// Impact of arms 0 and 2 where arm 1 has captured a target: arm 0 on it, arm 2 on it or on the free one.
    #[test]
    fn impact_on_a_captured_target(s in sample(3, 9), first in impact_kinds(), second in impact_kinds(), same in any::<bool>()) {
        let layout = layout("triple_arm_3r");
        let captured = after_capture(&layout, &s, &[(1, Kind::Rigid)]);
        let partners = [captured.bodies[0], captured.bodies[usize::from(!same)]];
        let contacts = [(0, partners[0], first), (2, partners[1], second)]
            .map(|(arm, body, kind)| Contact::new(&captured.before, arm, body, kind));
        let expected = impact(&captured.before, &contacts);
        let mut after = captured.before.clone();
        after.apply(&contacts, &expected);

        let point = |arm: usize| captured.before.end_effector(arm);
        let offset_to_end_effector = |arm: usize| (point(arm) - point(1)).into();
        let free = captured.before.bodies[captured.bodies[1]].com();
        let (second_partner, second_offset) =
            if same { (ContactPartner::EndEffector(1), offset_to_end_effector(2)) } else { (ContactPartner::Body(0), (point(2) - free).into()) };
        let contacts = [
            contact::Contact { arm: 0, partner: ContactPartner::EndEffector(1), offset: offset_to_end_effector(0), law: law(first) },
            contact::Contact { arm: 2, partner: second_partner, offset: second_offset, law: law(second) },
        ];
        let [first, second] = captured.targets()[..] else { unreachable!() };
        let motion = robot_state(&captured.before, &s);
        let attachments = [Attachment { target: 0, arm: 1, kind: ContactKind::Rigid }];
        for model in both_models(&layout) {
            let merged = Assembly::new(model, &motion, &[first, second], &attachments).expect("a merged model").model;
            let found = product::solve_impact(&*merged, &motion.view(), &[second], &contacts).expect("an impact");
            let all = after.velocities();
            let without_captured = [&all[..12], &all[15..]].concat();
            close("velocities", &found.velocities(), &without_captured, tolerance::CONTACT_IMPACT / expected.margin.powi(2));
            let bound = tolerance::CONTACT_IMPACT / expected.margin.powi(2);
            close("impulses", found.impulses.as_flattened(), expected.impulses.as_flattened(), bound);
        }
    }

    /// Two arms have captured a target; impact of the third on it or on the free one.
    #[test]
    fn impact_on_a_closed_loop(
        s in sample(3, 9),
        kinds in prop::array::uniform2(prop_oneof![Just(Kind::Rigid), Just(Kind::Pin)]),
        third in impact_kinds(),
        same in any::<bool>(),
    ) {
        let layout = layout("triple_arm_3r");
        let captured = after_capture(&layout, &s, &[(0, kinds[0]), (1, kinds[1])]);
        let contacts = [Contact::new(&captured.before, 2, captured.bodies[usize::from(!same)], third)];
        let expected = impact(&captured.before, &contacts);
        let mut after = captured.before.clone();
        after.apply(&contacts, &expected);

        let motion = robot_state(&captured.before, &s);
        let attachments = [0, 1].map(|arm| Attachment { target: 0, arm, kind: law(kinds[arm]).kind() });
        let target = usize::from(!same);
        let offset = captured.before.end_effector(2) - captured.before.bodies[captured.bodies[target]].com();
        let contacts = [ImpactContact { target, arm: 2, law: law(third), offset: offset.into(), miss: 0.0 }];
        for model in both_models(&layout) {
            let assembly = Assembly::new(model, &motion, &captured.targets(), &attachments).expect("an assembly");
            let found = solve_impact(&assembly, &motion, &captured.targets(), &contacts).expect("an impact");
            let bound = tolerance::CONTACT_IMPACT / expected.margin.powi(2);
            product_impact(&found).assert_agrees(&after, &expected.impulses, bound);
        }
        prop_assert_eq!(captured.captures.len(), 2);
    }
}
