//! The product's impacts, in joint coordinates by the inverse inertia at the contacts, against those of free bodies.

use crate::product::{Outcome, both_models, described, law, strike};
use crate::robot;
use planar_capture::capture::assembly::{Assembly, Attachment};
use planar_capture::capture::contact_at_time::ImpactContact;
use planar_capture::capture::impact::{ImpactResult, ImpactSolution, solve_impact};
use planar_capture::contact::{self, ContactKind, ContactPartner};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r;
use planar_capture::layout::Layout;
use planar_capture::owned::RobotState;
use planar_capture::state::State;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::{Contact, Impact, Kind, Left, impact};
use planar_proof::maximal::random::{PlannedContact, Scene, random_contacts};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{close, layout, tolerance};
use proptest::prelude::*;

/// The reference's impact and the bodies after it.
fn reference(layout: &Layout, scene: &Scene) -> (Impact, System) {
    let mut all = scene.system(layout);
    let contacts = scene.contacts(&all);
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    (found, all)
}

/// All velocities and impulses; where contacts depend on each other, that they do.
fn check(layout: &Layout, scene: &Scene) {
    let (wanted, after) = reference(layout, scene);
    let (bodies, contacts) = described(scene);
    for model in both_models(layout) {
        match strike(&*model, &scene.state.state(), &bodies, &contacts) {
            Ok(found) => {
                let seen = !wanted.redundant || wanted.margin < tolerance::SEEN_MARGIN;
                assert!(seen, "dependent contacts were solved: {found:?}\n{wanted:?}");
                let bound = tolerance::CONTACT_IMPACT / wanted.margin.powi(2);
                close("velocities", &found.velocities(), &after.velocities(), bound);
                if !wanted.redundant && !wanted.bounces_redundant {
                    close("impulses", found.impulses.as_flattened(), wanted.impulses.as_flattened(), bound);
                }
            }
            Err(Error::Singular { .. }) => assert!(wanted.redundant || wanted.bounces_redundant, "{wanted:?}"),
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
mixtures!(asymmetric_wheel boom_7r dual_arm_2r dual_arm_3r single_arm_2r single_arm_3r triple_arm_3r);

/// Arms of one link: too few joints for most loops.
fn short_arms(name: &str) -> Layout {
    let mut short = layout(name);
    short.arms.iter_mut().for_each(|arm| arm.links.truncate(1));
    short
}

/// The same with these arms at one target, and holding.
fn all_hold(layout: &Layout, mut scene: Scene, kinds: &[Kind]) -> Scene {
    let all = scene.system(layout);
    scene.targets.truncate(1);
    let [_, x, y] = scene.targets[0].pose;
    let touch = |(arm, kind): (usize, &Kind)| {
        let tip = all.position(&all.tips[arm]);
        PlannedContact { arm, target: 0, offset: [tip.x - x, tip.y - y], kind: *kind }
    };
    scene.touches = kinds.iter().enumerate().map(touch).collect();
    scene
}

proptest! {
    #![proptest_config(config())]

    /// Two arms of one link close no rigid loop, two pins they do; a third arm is too many.
    #[test]
    fn dependent_contacts_are_refused(
        one in random_contacts(short_arms("dual_arm_3r")),
        other in random_contacts(short_arms("triple_arm_3r")),
    ) {
        for (kinds, redundant) in [([Kind::Rigid; 2], true), ([Kind::Rigid, Kind::Pin], false), ([Kind::Pin; 2], false)] {
            let layout = short_arms("dual_arm_3r");
            let scene = all_hold(&layout, one.clone(), &kinds);
            prop_assert_eq!(reference(&layout, &scene).0.redundant, redundant);
            check(&layout, &scene);
        }
        let layout = short_arms("triple_arm_3r");
        let scene = all_hold(&layout, other, &[Kind::Rigid, Kind::Pin, Kind::Pin]);
        prop_assert!(reference(&layout, &scene).0.redundant);
        check(&layout, &scene);
    }

    /// Holds that are said twice are refused; a bounce is what it is once, with its impulse on one of the two.
    #[test]
    fn the_same_contact_twice(scene in random_contacts(layout("dual_arm_3r"))) {
        let layout = layout("dual_arm_3r");
        let (wanted, after) = reference(&layout, &scene);
        let (bodies, mut contacts) = described(&scene);
        contacts.push(contacts[0]);
        let bound = tolerance::CONTACT_IMPACT / wanted.margin.powi(2);
        for model in both_models(&layout) {
            let found = strike(&*model, &scene.state.state(), &bodies, &contacts);
            if let Kind::Bounce { .. } = scene.touches[0].kind {
                let mut found = found.expect("an impact");
                close("velocities", &found.velocities(), &after.velocities(), bound);
                let again = found.impulses.pop().expect("an impulse");
                found.impulses[0].iter_mut().zip(again).for_each(|(sum, part)| *sum += part);
                close("impulses", found.impulses.as_flattened(), wanted.impulses.as_flattened(), bound);
            } else {
                prop_assert!(matches!(found, Err(Error::Singular { .. })), "{:?}", found);
            }
        }
    }

    /// The same in single precision, loosely.
    #[test]
    fn in_single_precision(scene in random_contacts(layout("dual_arm_3r"))) {
        let layout = layout("dual_arm_3r");
        let (wanted, after) = reference(&layout, &scene);
        let (bodies, contacts) = described(&scene);
        let found = strike_singly(&scene.state, &bodies, &contacts).expect("an impact");
        let bound = tolerance::CONTACT_IMPACT_SINGLE / wanted.margin.powi(2);
        close("velocities", &found.velocities(), &after.velocities(), bound);
        let impulses: Vec<f64> = found.impulses.as_flattened().iter().map(|p| f64::from(*p)).collect();
        close("impulses", &impulses, wanted.impulses.as_flattened(), bound);
    }
}

/// [`strike`] with everything rounded.
#[allow(clippy::cast_possible_truncation, reason = "that is the test")]
fn strike_singly(
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
    strike(&dual_arm_3r::Model::<f32>::default(), &state, &bodies, &contacts)
}

/// Any kind, of a contact in this direction.
/// What a study's impact left.
fn left(found: &ImpactSolution) -> Left {
    let ImpactResult { base_twist_after, joint_rates_after, .. } = &found.exact;
    let velocities = base_twist_after.iter().chain(joint_rates_after).chain(found.target_twists.as_flattened());
    let impulses = found.contacts.iter().map(|contact| contact.impulse).collect();
    Left { velocities: velocities.copied().collect(), impulses }
}

fn kinds() -> impl Strategy<Value = Kind> {
    let bounce = (-3.2..3.2_f64, 0.0..1.0_f64).prop_map(|(direction, restitution)| {
        let (sin, cos) = direction.sin_cos();
        Kind::Bounce { normal: [cos, sin], restitution }
    });
    prop_oneof![Just(Kind::Rigid), Just(Kind::Pin), bounce.clone(), bounce]
}

/// A robot of three arms, with targets of the sample's at tips 0 and 2, and some arms' hold of the first of them.
struct Held {
    before: System,
    /// Which of the reference's bodies the targets are.
    bodies: [usize; 2],
    hold: Vec<Contact>,
}

fn held(layout: &Layout, s: &RandomState, holding: &[(usize, Kind)]) -> Held {
    let mut before = robot(layout, s);
    let bodies = [0, 1].map(|i| {
        let ([mass, inertia, rx, ry], twist) = s.targets[i];
        let tip = before.position(&before.tips[2 * i]);
        before.add(Body { mass, inertia, pose: [0.2, tip.x - rx, tip.y - ry], twist })
    });
    let hold: Vec<_> = holding.iter().map(|(arm, kind)| Contact::new(&before, *arm, bodies[0], *kind)).collect();
    before.apply(&hold, &impact(&before, &hold));
    Held { before, bodies, hold }
}

impl Held {
    fn motion(&self, s: &RandomState) -> RobotState {
        let (base_twist, joint_rates) = (self.before.bodies[0].twist, self.before.joint_rates());
        RobotState { base_pose: s.base_pose, joint_angles: s.joint_angles.clone(), base_twist, joint_rates }
    }

    /// The targets as the product has them.
    fn targets(&self) -> Vec<planar_capture::body::Body<f64>> {
        let of = |body: &usize| {
            let Body { mass, inertia, pose, twist } = self.before.bodies[*body];
            planar_capture::body::Body { mass, inertia, pose, twist }
        };
        self.bodies.iter().map(of).collect()
    }
}

proptest! {
    #![proptest_config(config())]

    /// A target that is one with the link of arm 1 is struck by arm 0, while arm 2 touches another, or the same.
    #[test]
    fn what_a_tip_holds_is_struck(s in sample(3, 9), first in kinds(), second in kinds(), same in any::<bool>()) {
        let layout = layout("triple_arm_3r");
        let held = held(&layout, &s, &[(1, Kind::Rigid)]);
        let touched = [held.bodies[0], held.bodies[usize::from(!same)]];
        let contacts = [(0, touched[0], first), (2, touched[1], second)]
            .map(|(arm, body, kind)| Contact::new(&held.before, arm, body, kind));
        let wanted = impact(&held.before, &contacts);
        let mut after = held.before.clone();
        after.apply(&contacts, &wanted);

        let point = |arm: usize| held.before.position(&held.before.tips[arm]);
        let from_tip = |arm: usize| (point(arm) - point(1)).into();
        let free = held.before.bodies[held.bodies[1]].com();
        let (second_partner, second_offset) =
            if same { (ContactPartner::EndEffector(1), from_tip(2)) } else { (ContactPartner::Body(0), (point(2) - free).into()) };
        let contacts = [
            contact::Contact { arm: 0, partner: ContactPartner::EndEffector(1), offset: from_tip(0), law: law(first) },
            contact::Contact { arm: 2, partner: second_partner, offset: second_offset, law: law(second) },
        ];
        let [first, second] = held.targets()[..] else { unreachable!() };
        let motion = held.motion(&s);
        let grip = [Attachment { target: 0, arm: 1, kind: ContactKind::Rigid }];
        for model in both_models(&layout) {
            let merged = Assembly::new(model, &motion, &[first, second], &grip).expect("one with the link").model;
            let found = strike(&*merged, &motion.view(), &[second], &contacts).expect("an impact");
            let all = after.velocities();
            let but_held = [&all[..12], &all[15..]].concat();
            close("velocities", &found.velocities(), &but_held, tolerance::CONTACT_IMPACT / wanted.margin.powi(2));
            let bound = tolerance::CONTACT_IMPACT / wanted.margin.powi(2);
            close("impulses", found.impulses.as_flattened(), wanted.impulses.as_flattened(), bound);
        }
    }

    /// Two arms hold a target, one with a link, pinned, or by a closed loop; the third touches it, or another one.
    #[test]
    fn a_closed_loop_is_struck(
        s in sample(3, 9),
        holding in prop::array::uniform2(prop_oneof![Just(Kind::Rigid), Just(Kind::Pin)]),
        what in kinds(),
        same in any::<bool>(),
    ) {
        let layout = layout("triple_arm_3r");
        let held = held(&layout, &s, &[(0, holding[0]), (1, holding[1])]);
        let contacts = [Contact::new(&held.before, 2, held.bodies[usize::from(!same)], what)];
        let wanted = impact(&held.before, &contacts);
        let mut after = held.before.clone();
        after.apply(&contacts, &wanted);

        let motion = held.motion(&s);
        let grips = [0, 1].map(|arm| Attachment { target: 0, arm, kind: law(holding[arm]).kind() });
        let target = usize::from(!same);
        let offset = held.before.position(&held.before.tips[2]) - held.before.bodies[held.bodies[target]].com();
        let touching = [ImpactContact { target, arm: 2, law: law(what), offset: offset.into(), miss: 0.0 }];
        for model in both_models(&layout) {
            let assembly = Assembly::new(model, &motion, &held.targets(), &grips).expect("an assembly");
            let found = solve_impact(&assembly, &motion, &held.targets(), &touching).expect("an impact");
            let bound = tolerance::CONTACT_IMPACT / wanted.margin.powi(2);
            left(&found).assert_is(&after, &wanted.impulses, bound);
        }
        prop_assert_eq!(held.hold.len(), 2);
    }
}
