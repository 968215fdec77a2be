//! The reference's impacts against closed-form solutions.

use nalgebra::Vector2;
use planar_capture::layout::{Arm, Base, Layout, Link};
use planar_proof::maximal::body::Body;
use planar_proof::maximal::body::BodyPoint;
use planar_proof::maximal::impact::{Contact, Kind, impact};
use planar_proof::maximal::system::System;
use planar_proof::{assert_close, layout, tolerance};

/// Discs in a row along x with these masses and speeds, each in contact with its neighbours; all normals are x.
fn row(masses: &[f64], speeds: &[f64], restitution: &[f64]) -> (System, Vec<Contact>) {
    let mut all = System { bodies: vec![], joints: vec![], end_effectors: vec![], captures: vec![] };
    let mut x = 0.0;
    for (mass, speed) in masses.iter().zip(speeds) {
        all.add(Body { mass: *mass, inertia: 0.02 * mass, pose: [0.4, x, 0.0], twist: [0.7, *speed, 0.3] });
        x -= 0.4;
    }
    let contact = |(i, e): (usize, &f64)| {
        let point = Vector2::new(-0.2 - 0.4 * f64::from(u8::try_from(i).expect("few")), 0.0);
        let kind = Kind::Bounce { normal: [1.0, 0.0], restitution: *e };
        Contact { robot: all.body_point(i, point), target: all.body_point(i + 1, point), kind }
    };
    let contacts = restitution.iter().enumerate().map(contact).collect();
    (all, contacts)
}

fn speeds(masses: &[f64], before: &[f64], restitution: &[f64]) -> Vec<f64> {
    let (mut all, contacts) = row(masses, before, restitution);
    all.apply(&contacts, &impact(&all, &contacts));
    for body in &all.bodies {
        assert_close("without friction", &[body.twist[0], body.twist[2]], &[0.7, 0.3], tolerance::POLYNOMIAL);
    }
    all.bodies.iter().map(|body| body.twist[1]).collect()
}

/// Two discs with e = 1, 0 and ½, unequal masses, and three discs with simultaneous contacts.
#[test]
fn discs_in_a_row() {
    let check = |masses: &[f64], before: &[f64], e: &[f64], expected: &[f64]| {
        assert_close("speeds", &speeds(masses, before, e), expected, tolerance::POLYNOMIAL);
    };
    check(&[2.0, 2.0], &[-1.0, 3.0], &[1.0], &[3.0, -1.0]);
    check(&[2.0, 2.0], &[-1.0, 3.0], &[0.0], &[1.0, 1.0]);
    check(&[2.0, 2.0], &[-1.0, 3.0], &[0.5], &[2.0, 0.0]);
    check(&[3.0, 1.0], &[0.0, 4.0], &[1.0], &[2.0, -2.0]);
    check(&[2.0, 2.0], &[3.0, -1.0], &[1.0], &[3.0, -1.0]);
    // p₁ = m v (1/3, 2/3) from the far end; restitution adds up to the same again
    let third = 1.0 / 3.0;
    check(&[1.0; 3], &[0.0, 0.0, 1.0], &[1.0, 1.0], &[2.0 * third, 2.0 * third, -third]);
    check(&[1.0; 3], &[0.0, 0.0, 1.0], &[0.0, 0.0], &[third; 3]);
    // restitution gives 2/3 at the near contact and none at the far one, which must not close: 1/3 there too
    check(&[1.0; 3], &[0.0, 0.0, 1.0], &[0.0, 1.0], &[2.0 * third, 2.0 * third, -third]);
    // restitution gives 1/3 at the far contact, which closes the near one by 1/3: 1/6 there
    check(&[1.0; 3], &[0.0, 0.0, 1.0], &[1.0, 0.0], &[2.0 * third, third / 2.0, third / 2.0]);
}

/// Contact off the line of the COMs: p = −(1 + e) u / (Σ 1/m + (r × n)²/I).
#[test]
fn eccentric_bounce() {
    let first = Body { mass: 3.0, inertia: 0.5, pose: [0.3, 0.0, 0.0], twist: [0.4, 0.1, -0.2] };
    let second = Body { mass: 5.0, inertia: 0.9, pose: [1.0, 1.0, 0.5], twist: [-0.6, -1.5, 0.3] };
    let all = System { bodies: vec![first, second], joints: vec![], end_effectors: vec![], captures: vec![] };
    let (point, normal, e) = (Vector2::new(0.4, 0.3), Vector2::new(-0.6, 0.8), 0.4);
    let kind = Kind::Bounce { normal: normal.into(), restitution: e };
    let contact = Contact { robot: all.body_point(0, point), target: all.body_point(1, point), kind };
    let lever_arm = |body: &Body| (point - body.com()).perp(&normal);
    let u = contact.normal_velocity(&all).expect("u");
    assert!(u < -0.1, "they approach");
    let each = |body: &Body| 1.0 / body.mass + lever_arm(body) * lever_arm(body) / body.inertia;
    let p = -(1.0 + e) * u / (each(&first) + each(&second));
    let found = impact(&all, &[contact]);
    assert_close("impulse", &found.impulses[0], &[0.0, p * normal.x, p * normal.y], tolerance::POLYNOMIAL);
    let moved = |body: &Body, p: f64| {
        let [omega, vx, vy] = body.twist;
        [omega + p * lever_arm(body) / body.inertia, vx + p * normal.x / body.mass, vy + p * normal.y / body.mass]
    };
    let expected = [moved(&first, p), moved(&second, -p)];
    assert_close("twists", found.twists.as_slice(), expected.as_flattened(), tolerance::POLYNOMIAL);
}

/// A ball hits the end effector of a link at rest on a heavy base: the link rotates about its joint.
#[test]
fn link_on_a_heavy_base() {
    let (length, mass, inertia, com) = (1.5, 4.0, 0.6, [0.7, 0.1]);
    let links = vec![Link { length, mass, inertia, com, outline: None }];
    let arms = vec![Arm { name: "arm".into(), mount: [0.4, 0.2], mount_angle: 0.3, links }];
    let layout = Layout { name: "heavy".into(), base: Base { mass: 1e14, inertia: 1e14, outline: None }, arms };
    let angle: f64 = -0.2;
    let mut all = System::new(&layout, [0.1, 2.0, -1.0], &[angle], [0.0; 3], &[0.0]);
    let across = Vector2::new(-(angle + 0.4).sin(), (angle + 0.4).cos());
    let end_effector = all.end_effector(0);
    let (ball, speed, spin) = (2.5, -3.0, 1.1);
    let velocity = speed * across;
    let body = all.add(Body {
        mass: ball,
        inertia: 0.05,
        pose: [0.0, end_effector.x, end_effector.y],
        twist: [spin, velocity.x, velocity.y],
    });
    let about_joint = inertia + mass * (com[0] * com[0] + com[1] * com[1]);
    let together = ball * length * speed / (about_joint + ball * length * length);
    let expected = [
        // as one body; with unchanged spin; with e = ½ and 1.5 times the impulse
        (Kind::Rigid, (ball * length * speed + 0.05 * spin) / (about_joint + ball * length * length + 0.05)),
        (Kind::Pin, together),
        (Kind::Bounce { normal: (-across).into(), restitution: 0.5 }, 1.5 * together),
    ];
    for (kind, rate) in expected {
        let mut after = all.clone();
        let contacts = [Contact::new(&all, 0, body, kind)];
        after.apply(&contacts, &impact(&all, &contacts));
        assert_close("joint rate", &after.joint_rates(), &[rate], tolerance::HEAVY_BASE);
        let spin_after = if kind == Kind::Rigid { rate } else { spin };
        assert_close("spin", &[after.bodies[body].twist[0]], &[spin_after], tolerance::HEAVY_BASE);
    }
}

/// Repeated captures and bounces give the same twists as single ones.
#[test]
fn the_same_contact_twice() {
    let layout = layout("dual_arm_3r");
    let mut all = System::new(&layout, [0.2, 0.0, 0.0], &[0.3, -1.2, 0.7, 2.1, 1.4, -0.6], [0.1, 0.2, 0.0], &[0.3; 6]);
    let end_effector = all.end_effector(0);
    let body = all.add(Body {
        mass: 9.0,
        inertia: 2.0,
        pose: [0.0, end_effector.x + 0.3, end_effector.y],
        twist: [0.5, -1.0, 0.2],
    });
    for kind in [Kind::Rigid, Kind::Pin, Kind::Bounce { normal: [-1.0, 0.0], restitution: 0.6 }] {
        let contact = Contact::new(&all, 0, body, kind);
        let (once, twice) = (impact(&all, &[contact]), impact(&all, &[contact, contact]));
        assert_close("twists", twice.twists.as_slice(), once.twists.as_slice(), tolerance::IDENTITY);
        assert!(!once.redundant && !once.bounces_redundant && (twice.redundant || twice.bounces_redundant));
        let sum: Vec<f64> = twice.impulses[0].iter().zip(&twice.impulses[1]).map(|(a, b)| a + b).collect();
        assert_close("impulse", &sum, &once.impulses[0], tolerance::IDENTITY * 10.0);
    }
    // a bounce on a captured target has no impulse
    let capture = [Contact::new(&all, 0, body, Kind::Rigid)];
    let captured = impact(&all, &capture);
    all.apply(&capture, &captured);
    let target = BodyPoint { body, offset: Vector2::new(0.1, 0.2) };
    let robot = all.body_point(all.end_effectors[0].body, target.position(&all.bodies));
    let kind = Kind::Bounce { normal: [0.0, 1.0], restitution: 1.0 };
    let idle = impact(&all, &[Contact { robot, target, kind }]);
    assert_close("twists", idle.twists.as_slice(), captured.twists.as_slice(), tolerance::IDENTITY);
    assert_close("impulse", &idle.impulses[0], &[0.0; 3], tolerance::IDENTITY);
}
