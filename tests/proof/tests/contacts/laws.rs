//! Impacts of every mixture of contacts at random states: what mechanics and the contacts' laws promise.

use nalgebra::{DMatrix, DVector, Vector2};
use planar_capture::layout::Layout;
use planar_capture::registry;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::{Contact, Impact, Kind, impact};
use planar_proof::maximal::random::{Scene, random_contacts};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config};
use planar_proof::{assert_close, layout, tolerance};
use proptest::prelude::*;

/// The scene's impact: bodies before, contacts, what happened, bodies after.
fn happen(layout: &Layout, scene: &Scene) -> (System, Vec<Contact>, Impact, System) {
    let before = scene.system(layout);
    let contacts = scene.contacts(&before);
    for (touch, contact) in scene.touches.iter().zip(&contacts) {
        let arrow = before.position(&before.tips[touch.arm]) - before.bodies[contact.target.body].com();
        assert_close("offset", &touch.offset, arrow.as_slice(), tolerance::POLYNOMIAL);
    }
    let found = impact(&before, &contacts);
    let mut after = before.clone();
    after.apply(&contacts, &found);
    (before, contacts, found, after)
}

/// The larger scales of momentum, and of velocity, before and after.
fn scales(before: &System, after: &System) -> ([f64; 2], f64) {
    let (a, b) = (before.momentum_scale(), after.momentum_scale());
    ([a[0].max(b[0]), a[1].max(b[1])], before.twists().amax().max(after.twists().amax()))
}

/// Momentum of everything, and the energy: never above what the captures alone would leave.
fn check_conservation(before: &System, contacts: &[Contact], after: &System) {
    let ([angular, linear], _) = scales(before, after);
    let (was, is) = (before.momentum(), after.momentum());
    assert_close("angular momentum", &is[..1], &was[..1], tolerance::IDENTITY * angular);
    assert_close("linear momentum", &is[1..], &was[1..], tolerance::IDENTITY * linear);
    let captures: Vec<_> = contacts.iter().filter(|contact| contact.tie(before).is_some()).copied().collect();
    let mut caught = before.clone();
    caught.apply(&captures, &impact(before, &captures));
    let most = caught.kinetic_energy() + tolerance::IDENTITY * before.kinetic_energy();
    assert!(after.kinetic_energy() <= most, "{:e} J, at most {most:e} J", after.kinetic_energy());
    assert!(caught.kinetic_energy() <= before.kinetic_energy() * (1.0 + tolerance::IDENTITY));
}

/// What each contact promises of the velocities and the impulse.
fn check_contacts(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let (_, speed) = scales(before, after);
    let small = tolerance::MAXIMAL_IMPACT * speed;
    for (contact, [n, fx, fy]) in contacts.iter().zip(&found.impulses) {
        let apart = after.velocity(&contact.robot) - after.velocity(&contact.target);
        let spin = |all: &System| all.bodies[contact.robot.body].twist[0] - all.bodies[contact.target.body].twist[0];
        match contact.kind {
            Kind::Rigid => assert!(apart.amax().max(spin(after).abs()) <= small, "{apart}"),
            Kind::Pin => assert!(apart.amax() <= small && *n == 0.0, "{apart}"),
            Kind::Bounce { normal, .. } => {
                let push = Vector2::new(*fx, *fy).dot(&Vector2::from(normal));
                let across = fx * normal[1] - fy * normal[0];
                assert!(*n == 0.0 && across.abs() <= tolerance::IDENTITY * push.abs() && push >= -1e-9);
                assert!(apart.dot(&Vector2::from(normal)) >= -small, "{contact:?} closes by {apart}");
            }
        }
    }
}

/// Poisson's law: p₁ ≥ 0, u₁ ≥ 0, p₁ u₁ = 0, and p₂ ≥ e p₁, (p₂ − e p₁) u₂ = 0; u₁ is what e = 0 leaves.
fn check_phases(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let soft = |contact: &Contact| match contact.kind {
        Kind::Bounce { normal, .. } => Contact { kind: Kind::Bounce { normal, restitution: 0.0 }, ..*contact },
        _ => *contact,
    };
    let soft: Vec<_> = contacts.iter().map(soft).collect();
    let squeezed = impact(before, &soft);
    let mut between = before.clone();
    between.apply(&soft, &squeezed);
    let [first, second] = &found.phases;
    let (_, speed) = scales(before, after);
    let bounces: Vec<_> = contacts.iter().filter(|contact| contact.tie(before).is_none()).collect();
    assert_eq!(bounces.len(), first.len());
    for ((contact, p1), p2) in bounces.iter().zip(first).zip(second) {
        let Kind::Bounce { restitution, .. } = contact.kind else { unreachable!() };
        let [u1, u2] = [&between, after].map(|all| contact.opening(all).expect("u"));
        let small = tolerance::MAXIMAL_IMPACT * speed * p1.abs().max(p2.abs());
        let more = p2 - restitution * p1;
        assert!(*p1 >= 0.0 && (p1 * u1).abs() <= small, "{p1} {u1}");
        assert!(more >= 0.0 && (more * u2).abs() <= small, "{p1} {p2} {restitution} {u2}");
    }
}

/// Impulses change the targets' momenta about their COMs, and nothing else does.
fn check_targets(contacts: &[Contact], found: &Impact, before: &System, after: &System) {
    let ([angular, linear], _) = scales(before, after);
    for body in 1 + before.joints.len()..before.bodies.len() {
        let (was, is) = (&before.bodies[body], &after.bodies[body]);
        let mut change = [0.0; 3];
        for (contact, [n, fx, fy]) in contacts.iter().zip(&found.impulses).filter(|(c, _)| c.target.body == body) {
            let arrow = before.position(&contact.target) - was.com();
            change[0] -= n + arrow.x * fy - arrow.y * fx;
            change[1] -= fx;
            change[2] -= fy;
        }
        let found = [0, 1, 2].map(|i| if i == 0 { was.inertia } else { was.mass } * (is.twist[i] - was.twist[i]));
        assert_close("target", &found, &change, tolerance::MAXIMAL_IMPACT * angular.max(linear));
    }
}

/// M Δv = `J_eᵀ` F̄ with the product's M and J: joints transmit no moment, and the impulses are those on the tips.
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
    let given = DMatrix::from_row_slice(3 * arms, size, &jacobian).tr_mul(&wrenches);
    let taken = DMatrix::from_row_slice(size, size, &mass) * (velocity(after) - velocity(before));
    let ([angular, linear], _) = scales(before, after);
    assert_close("robot", taken.as_slice(), given.as_slice(), tolerance::MAXIMAL_IMPACT * angular.max(linear));
}

macro_rules! mixtures {
    ($($layout:ident)*) => {
        proptest! {
            #![proptest_config(config())]
            $(
            #[test]
            fn $layout(scene in random_contacts(layout(stringify!($layout)))) {
                let layout = layout(stringify!($layout));
                let (before, contacts, found, after) = happen(&layout, &scene);
                check_conservation(&before, &contacts, &after);
                check_contacts(&contacts, &found, &before, &after);
                check_phases(&contacts, &found, &before, &after);
                check_targets(&contacts, &found, &before, &after);
                let impulses: Vec<_> = scene.touches.iter().map(|t| t.arm).zip(found.impulses).collect();
                check_robot(&layout, &scene.state, &impulses, &before, &after);
            })*
        }
    };
}
mixtures!(asymmetric_wheel boom_7r dual_arm_2r dual_arm_3r single_arm_2r single_arm_3r triple_arm_3r);

/// The scene with the bounce of its first contact alone, approaching, e = 1.
fn one_bounce(mut scene: Scene, layout: &Layout, direction: f64) -> Scene {
    scene.touches.truncate(1);
    let (sin, cos) = direction.sin_cos();
    scene.touches[0].kind = Kind::Bounce { normal: [cos, sin], restitution: 1.0 };
    let all = scene.system(layout);
    let opening = scene.contacts(&all)[0].opening(&all).expect("a bounce");
    if opening > 0.0 {
        scene.touches[0].kind = Kind::Bounce { normal: [-cos, -sin], restitution: 1.0 };
    }
    scene
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn one_elastic_bounce(scene in random_contacts(layout("triple_arm_3r")), direction in -3.0..3.0_f64) {
        let layout = layout("triple_arm_3r");
        let scene = one_bounce(scene, &layout, direction);
        let (before, contacts, found, after) = happen(&layout, &scene);
        let [energy, was] = [&after, &before].map(System::kinetic_energy);
        assert_close("energy", &[energy], &[was], tolerance::IDENTITY * was);
        let (closing, opening) = (contacts[0].opening(&before).expect("u"), contacts[0].opening(&after).expect("u"));
        let (_, speed) = scales(&before, &after);
        assert_close("speed", &[opening], &[-closing], tolerance::MAXIMAL_IMPACT * speed);

        // seen from the other body, it is the same
        let Kind::Bounce { normal, restitution } = contacts[0].kind else { unreachable!() };
        let kind = Kind::Bounce { normal: normal.map(|n| -n), restitution };
        let swapped = [Contact { robot: contacts[0].target, target: contacts[0].robot, kind }];
        let other = impact(&before, &swapped);
        assert_close("twists", other.twists.as_slice(), found.twists.as_slice(), tolerance::IDENTITY * speed);
        let opposite = found.impulses[0].map(|f| -f);
        assert_close("impulse", &other.impulses[0], &opposite, tolerance::IDENTITY * found.impulses[0][1].hypot(found.impulses[0][2]));

        // with the normal reversed they separate, and nothing happens
        let apart = impact(&before, &[Contact { kind, ..contacts[0] }]);
        assert_close("no impulse", &apart.impulses[0], &[0.0; 3], 0.0);
        assert_close("twists", apart.twists.as_slice(), before.twists().as_slice(), tolerance::IDENTITY * speed);
    }
}

proptest! {
    #![proptest_config(config())]

    /// Two arms hold a target as they took hold of it; the third touches it, or another one.
    #[test]
    fn a_closed_loop_is_struck(
        scene in random_contacts(layout("triple_arm_3r")),
        kinds in prop::array::uniform2(prop_oneof![Just(Kind::Rigid), Just(Kind::Pin)]),
        direction in -3.0..3.0_f64,
        same in any::<bool>(),
        what in 0..3_u8,
    ) {
        let layout = layout("triple_arm_3r");
        let mut before = Scene { touches: vec![], targets: vec![], ..scene.clone() }.system(&layout);
        let bodies = [0, 1].map(|i| {
            let ([mass, inertia, rx, ry], twist) = scene.state.targets[i];
            let tip = before.position(&before.tips[2 * i]);
            before.add(Body { mass, inertia, pose: [0.2, tip.x - rx, tip.y - ry], twist })
        });
        let hold = [0, 1].map(|arm| Contact::new(&before, arm, bodies[0], kinds[arm]));
        before.apply(&hold, &impact(&before, &hold));

        let (sin, cos) = direction.sin_cos();
        let kind = [Kind::Rigid, Kind::Pin, Kind::Bounce { normal: [cos, sin], restitution: 0.7 }][usize::from(what)];
        let contacts = [Contact::new(&before, 2, bodies[usize::from(!same)], kind)];
        let found = impact(&before, &contacts);
        let mut after = before.clone();
        after.apply(&contacts, &found);
        check_conservation(&before, &contacts, &after);
        check_contacts(&contacts, &found, &before, &after);
        let all = [contacts.to_vec(), hold.to_vec()].concat();
        let together = Impact { impulses: [found.impulses.clone(), found.held.clone()].concat(), ..found };
        // what holds closes again, and its impulses are those on targets and arms
        check_contacts(&all, &together, &before, &after);
        check_targets(&all, &together, &before, &after);
        let sample = RandomState { joint_rates: before.joint_rates(), base_twist: before.bodies[0].twist, ..scene.state };
        let impulses: Vec<_> = [2, 0, 1].into_iter().zip(together.impulses).collect();
        check_robot(&layout, &sample, &impulses, &before, &after);
    }
}
