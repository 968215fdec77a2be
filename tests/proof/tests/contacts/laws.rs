//! The reference's impacts at random states and contacts: conservation laws and contact laws.

use crate::add_target;
use nalgebra::{DMatrix, DVector, Vector2};
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_proof::maximal::impact::{Contact, Impact, Kind, impact};
use planar_proof::maximal::random::{Scene, random_contacts};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config};
use planar_proof::{assert_close, for_every_layout, layout, tolerance};
use proptest::prelude::*;

/// The scene's impact: bodies before, contacts, impact, bodies after.
fn solve(layout: &Layout, scene: &Scene) -> (System, Vec<Contact>, Impact, System) {
    let before = scene.system(layout);
    let contacts = scene.contacts(&before);
    for (planned, contact) in scene.planned.iter().zip(&contacts) {
        let offset = before.end_effector(planned.arm) - before.bodies[contact.target.body].com();
        assert_close("offset", &planned.offset, offset.as_slice(), tolerance::POLYNOMIAL);
    }
    let found = impact(&before, &contacts);
    let mut after = before.clone();
    after.apply(&contacts, &found);
    (before, contacts, found, after)
}

/// Scales of momentum and velocity: the larger of before and after.
fn scales(before: &System, after: &System) -> ([f64; 2], f64) {
    let (a, b) = (before.momentum_scale(), after.momentum_scale());
    ([a[0].max(b[0]), a[1].max(b[1])], before.twists().amax().max(after.twists().amax()))
}

/// Momentum is conserved; the energy is at most that after the captures alone.
fn check_conservation(before: &System, contacts: &[Contact], after: &System) {
    let ([angular, linear], _) = scales(before, after);
    let (was, is) = (before.momentum(), after.momentum());
    assert_close("angular momentum", &is[..1], &was[..1], tolerance::IDENTITY * angular);
    assert_close("linear momentum", &is[1..], &was[1..], tolerance::IDENTITY * linear);
    let captures: Vec<_> = contacts.iter().filter(|contact| contact.constraint(before).is_some()).copied().collect();
    let mut with_captures = before.clone();
    with_captures.apply(&captures, &impact(before, &captures));
    let bound = with_captures.kinetic_energy() + tolerance::IDENTITY * before.kinetic_energy();
    assert!(after.kinetic_energy() <= bound, "{:e} J, at most {bound:e} J", after.kinetic_energy());
    assert!(with_captures.kinetic_energy() <= before.kinetic_energy() * (1.0 + tolerance::IDENTITY));
}

/// Velocities and impulse of each contact satisfy its law.
fn check_contacts(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let (_, speed) = scales(before, after);
    let small = tolerance::MAXIMAL_IMPACT * speed;
    for (contact, [n, fx, fy]) in contacts.iter().zip(&found.impulses) {
        let relative = contact.robot.velocity(&after.bodies) - contact.target.velocity(&after.bodies);
        let spin = |all: &System| all.bodies[contact.robot.body].twist[0] - all.bodies[contact.target.body].twist[0];
        match contact.kind {
            Kind::Rigid => assert!(relative.amax().max(spin(after).abs()) <= small, "{relative}"),
            Kind::Pin => assert!(relative.amax() <= small && *n == 0.0, "{relative}"),
            Kind::Bounce { normal, .. } => {
                let push = Vector2::new(*fx, *fy).dot(&Vector2::from(normal));
                let across = fx * normal[1] - fy * normal[0];
                assert!(*n == 0.0 && across.abs() <= tolerance::IDENTITY * push.abs() && push >= -1e-9);
                assert!(relative.dot(&Vector2::from(normal)) >= -small, "{contact:?} closes by {relative}");
            }
        }
    }
}

/// Poisson's law: p₁ ≥ 0, u₁ ≥ 0, p₁ u₁ = 0, and p₂ ≥ e p₁, (p₂ − e p₁) u₂ = 0; u₁ is the velocity after the impact with
/// e = 0.
fn check_phases(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let plastic = |contact: &Contact| match contact.kind {
        Kind::Bounce { normal, .. } => Contact { kind: Kind::Bounce { normal, restitution: 0.0 }, ..*contact },
        _ => *contact,
    };
    let plastic: Vec<_> = contacts.iter().map(plastic).collect();
    let compression = impact(before, &plastic);
    let mut between = before.clone();
    between.apply(&plastic, &compression);
    let [first, second] = &found.phases;
    let (_, speed) = scales(before, after);
    let bounces: Vec<_> = contacts.iter().filter(|contact| contact.constraint(before).is_none()).collect();
    assert_eq!(bounces.len(), first.len());
    for ((contact, p1), p2) in bounces.iter().zip(first).zip(second) {
        let Kind::Bounce { restitution, .. } = contact.kind else { unreachable!() };
        let [u1, u2] = [&between, after].map(|all| contact.normal_velocity(all).expect("u"));
        let small = tolerance::MAXIMAL_IMPACT * speed * p1.abs().max(p2.abs());
        let more = p2 - restitution * p1;
        assert!(*p1 >= 0.0 && (p1 * u1).abs() <= small, "{p1} {u1}");
        assert!(more >= 0.0 && (more * u2).abs() <= small, "{p1} {p2} {restitution} {u2}");
    }
}

/// The change of each target's momentum about its COM equals the impulses on it.
fn check_targets(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let ([angular, linear], _) = scales(before, after);
    for body in 1 + before.joints.len()..before.bodies.len() {
        let (was, is) = (&before.bodies[body], &after.bodies[body]);
        let mut change = [0.0; 3];
        for (contact, [n, fx, fy]) in contacts.iter().zip(&found.impulses).filter(|(c, _)| c.target.body == body) {
            let arm = contact.target.lever_arm(&before.bodies);
            change[0] -= n + arm.x * fy - arm.y * fx;
            change[1] -= fx;
            change[2] -= fy;
        }
        let found = [0, 1, 2].map(|i| if i == 0 { was.inertia } else { was.mass } * (is.twist[i] - was.twist[i]));
        assert_close("target", &found, &change, tolerance::MAXIMAL_IMPACT * angular.max(linear));
    }
}

/// M Δv = `J_eᵀ` F̄ with the product's M and J: joints transmit no moment, and the impulses act on the end effectors.
fn check_robot(layout: &Layout, sample: &RandomState, impulses: &[(usize, [f64; 3])], before: &System, after: &System) {
    let model = registry::generic(layout);
    let (size, arms) = (3 + layout.joints(), layout.arms.len());
    let (mut mass, mut jacobian) = (vec![0.0; size * size], vec![0.0; 3 * arms * size]);
    let s = sample.state();
    model.mass_matrix(&s.base_pose, s.joint_angles, &mut mass).expect("M");
    model.end_effector_jacobian(&s.base_pose, s.joint_angles, &mut jacobian).expect("J");
    let velocity = |all: &System| {
        let rates = all.joint_rates();
        DVector::from_iterator(size, all.bodies[0].twist.into_iter().chain(rates))
    };
    let mut wrenches = DVector::zeros(3 * arms);
    for (arm, impulse) in impulses {
        wrenches.rows_mut(3 * arm, 3).copy_from_slice(impulse);
    }
    let impulse = DMatrix::from_row_slice(3 * arms, size, &jacobian).tr_mul(&wrenches);
    let change = DMatrix::from_row_slice(size, size, &mass) * (velocity(after) - velocity(before));
    let ([angular, linear], _) = scales(before, after);
    assert_close("robot", change.as_slice(), impulse.as_slice(), tolerance::MAXIMAL_IMPACT * angular.max(linear));
}

macro_rules! mixtures {
    ($($layout:ident)*) => {
        proptest! {
            #![proptest_config(config())]
            $(
            #[test]
            fn $layout(scene in random_contacts(layout(stringify!($layout)))) {
                let layout = layout(stringify!($layout));
                let (before, contacts, found, after) = solve(&layout, &scene);
                check_conservation(&before, &contacts, &after);
                check_contacts(&contacts, &found, &before, &after);
                check_phases(&contacts, &found, &before, &after);
                check_targets(&contacts, &found, &before, &after);
                let impulses: Vec<_> = scene.planned.iter().map(|contact| contact.arm).zip(found.impulses).collect();
                check_robot(&layout, &scene.state, &impulses, &before, &after);
            })*
        }
    };
}
for_every_layout!(mixtures);

/// The scene with its first contact alone, as an approaching bounce with e = 1.
fn one_bounce(mut scene: Scene, layout: &Layout, direction: f64) -> Scene {
    scene.planned.truncate(1);
    let (sin, cos) = direction.sin_cos();
    scene.planned[0].kind = Kind::Bounce { normal: [cos, sin], restitution: 1.0 };
    let all = scene.system(layout);
    let velocity = scene.contacts(&all)[0].normal_velocity(&all).expect("a bounce");
    if velocity > 0.0 {
        scene.planned[0].kind = Kind::Bounce { normal: [-cos, -sin], restitution: 1.0 };
    }
    scene
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn one_elastic_bounce(scene in random_contacts(layout("triple_arm_3r")), direction in -3.0..3.0_f64) {
        let layout = layout("triple_arm_3r");
        let scene = one_bounce(scene, &layout, direction);
        let (before, contacts, found, after) = solve(&layout, &scene);
        let [energy, was] = [&after, &before].map(System::kinetic_energy);
        assert_close("energy", &[energy], &[was], tolerance::IDENTITY * was);
        let (closing, opening) = (contacts[0].normal_velocity(&before).expect("u"), contacts[0].normal_velocity(&after).expect("u"));
        let (_, speed) = scales(&before, &after);
        assert_close("speed", &[opening], &[-closing], tolerance::MAXIMAL_IMPACT * speed);

        // with the bodies exchanged, the impact is the same
        let Kind::Bounce { normal, restitution } = contacts[0].kind else { unreachable!() };
        let kind = Kind::Bounce { normal: normal.map(|n| -n), restitution };
        let swapped = [Contact { robot: contacts[0].target, target: contacts[0].robot, kind }];
        let other = impact(&before, &swapped);
        assert_close("twists", other.twists.as_slice(), found.twists.as_slice(), tolerance::IDENTITY * speed);
        let opposite = found.impulses[0].map(|f| -f);
        assert_close("impulse", &other.impulses[0], &opposite, tolerance::IDENTITY * found.impulses[0][1].hypot(found.impulses[0][2]));

        // with the normal reversed the bodies separate: no impulse
        let separating = impact(&before, &[Contact { kind, ..contacts[0] }]);
        assert_close("no impulse", &separating.impulses[0], &[0.0; 3], 0.0);
        assert_close("twists", separating.twists.as_slice(), before.twists().as_slice(), tolerance::IDENTITY * speed);
    }
}

proptest! {
    #![proptest_config(config())]

    /// Two arms have captured a target; impact of the third on it or on a free one.
    #[test]
    fn impact_on_a_closed_loop(
        scene in random_contacts(layout("triple_arm_3r")),
        kinds in prop::array::uniform2(prop_oneof![Just(Kind::Rigid), Just(Kind::Pin)]),
        direction in -3.0..3.0_f64,
        same in any::<bool>(),
        third in 0..3_u8,
    ) {
        let layout = layout("triple_arm_3r");
        let mut before = Scene { planned: vec![], targets: vec![], ..scene.clone() }.system(&layout);
        let bodies = [0, 1].map(|i| {
            add_target(&mut before, &scene.state.targets[i], 2 * i, 0.2)
        });
        let captures = [0, 1].map(|arm| Contact::new(&before, arm, bodies[0], kinds[arm]));
        before.apply(&captures, &impact(&before, &captures));

        let (sin, cos) = direction.sin_cos();
        let kind = [Kind::Rigid, Kind::Pin, Kind::Bounce { normal: [cos, sin], restitution: 0.7 }][usize::from(third)];
        let contacts = [Contact::new(&before, 2, bodies[usize::from(!same)], kind)];
        let found = impact(&before, &contacts);
        let mut after = before.clone();
        after.apply(&contacts, &found);
        check_conservation(&before, &contacts, &after);
        check_contacts(&contacts, &found, &before, &after);
        let all = [contacts.to_vec(), captures.to_vec()].concat();
        let together = Impact { impulses: [found.impulses.clone(), found.capture_impulses.clone()].concat(), ..found };
        // the constraints of the captures hold after the impact, and their impulses act on targets and arms
        check_contacts(&all, &together, &before, &after);
        check_targets(&all, &together, &before, &after);
        let sample = RandomState { joint_rates: before.joint_rates(), base_twist: before.bodies[0].twist, ..scene.state };
        let impulses: Vec<_> = [2, 0, 1].into_iter().zip(together.impulses).collect();
        check_robot(&layout, &sample, &impulses, &before, &after);
    }
}
