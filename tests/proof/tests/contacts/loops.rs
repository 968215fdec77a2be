//! Motion with loops: two arms that hold one target, rigid or pinned.

use crate::{robot, simulated};
use nalgebra::{DMatrix, DVector};
use planar_capture::control::ZeroTorque;
use planar_capture::layout::{Layout, Link};
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::constraint::{Tie, centripetal, residual, rows};
use planar_proof::maximal::impact::{Contact, Kind, impact};
use planar_proof::maximal::kkt_system::Constrained;
use planar_proof::maximal::motion::{accelerations, project, run};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, close, layout, tolerance};
use proptest::prelude::*;

/// The robot, its first two arms with hold of one target by these kinds, after the impact that made it so.
fn looped(layout: &Layout, s: &RandomState, kinds: [Kind; 2]) -> System {
    let mut all = robot(layout, s);
    let ([mass, inertia, rx, ry], twist) = s.targets[0];
    let tip = all.position(&all.tips[0]);
    let body = all.add(Body { mass, inertia, pose: [0.7, tip.x - rx, tip.y - ry], twist });
    let contacts = [0, 1].map(|arm| Contact::new(&all, arm, body, kinds[arm]));
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    all
}

const MIXTURES: [[Kind; 2]; 4] =
    [[Kind::Rigid, Kind::Rigid], [Kind::Rigid, Kind::Pin], [Kind::Pin, Kind::Rigid], [Kind::Pin, Kind::Pin]];

/// The whole system as one matrix: [M −Aᵀ; A 0] [a; λ] = [f; −Ȧ v].
fn whole(all: &System, forces: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
    let ties: Vec<Tie> = all.ties().copied().collect();
    let a = rows(all, &ties);
    let (m, n) = a.shape();
    let mut matrix = DMatrix::zeros(n + m, n + m);
    matrix.view_mut((0, 0), (n, n)).set_diagonal(&all.masses());
    matrix.view_mut((0, n), (n, m)).copy_from(&-a.transpose());
    matrix.view_mut((n, 0), (m, n)).copy_from(&a);
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(forces);
    right.rows_mut(n, m).copy_from(&-centripetal(all, &ties));
    let solution = matrix.full_piv_lu().solve(&right).expect("a regular matrix");
    (solution.rows(0, n).into_owned(), solution.rows(n, m).into_owned())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..config() })]

    #[test]
    fn accelerations_are_those_of_the_whole_matrix(s in sample(2, 6)) {
        for kinds in MIXTURES {
            let all = looped(&layout("dual_arm_3r"), &s, kinds);
            let mut forces = DVector::zeros(3 * all.bodies.len());
            for (joint, torque) in s.joint_torques.iter().enumerate() {
                let tie = &all.joints[joint].tie;
                forces[3 * tie.a.body] += torque;
                forces[3 * tie.b.body] -= torque;
            }
            let (wanted, wanted_multipliers) = whole(&all, &forces);
            let found = accelerations(&all, &s.joint_torques);
            close("accelerations", found.as_slice(), wanted.as_slice(), tolerance::MAXIMAL_ACCELERATION);
            let ties: Vec<Tie> = all.ties().copied().collect();
            let system = Constrained::new(&all, &ties);
            prop_assert!(!system.redundant);
            let multipliers = system.solve(&forces, &-centripetal(&all, &ties)).1;
            close("forces", multipliers.as_slice(), wanted_multipliers.as_slice(), tolerance::MAXIMAL_ACCELERATION);
        }
    }

    /// A v is the rate of the residual and Ȧ v that of A v, for any motion, by central differences.
    #[test]
    fn rows_are_derivatives(s in sample(2, 6), twists in prop::collection::vec(-1.0..1.0_f64, 24)) {
        let mut all = looped(&layout("dual_arm_3r"), &s, [Kind::Rigid, Kind::Pin]);
        all.set_twists(&DVector::from_vec(twists));
        let ties: Vec<Tie> = all.ties().copied().collect();
        let h = 1e-5;
        let moved = |by: f64| {
            let mut moved = all.clone();
            moved.bodies.iter_mut().for_each(|b| (0..3).for_each(|i| b.pose[i] += by * b.twist[i]));
            (residual(&moved, &ties), rows(&moved, &ties) * all.twists())
        };
        let ((to, faster), (from, slower)) = (moved(h), moved(-h));
        let velocity = rows(&all, &ties) * all.twists();
        assert_close("A v", ((to - from) / (2.0 * h)).as_slice(), velocity.as_slice(), tolerance::DIFFERENCE_QUOTIENT);
        let by_differences = (faster - slower) / (2.0 * h);
        assert_close("Ȧ v", by_differences.as_slice(), centripetal(&all, &ties).as_slice(), tolerance::DIFFERENCE_QUOTIENT);
    }
}

/// Slower by a factor.
fn slowly(mut s: RandomState) -> RandomState {
    s.base_twist = s.base_twist.map(|value| 0.3 * value);
    s.joint_rates.iter_mut().for_each(|value| *value *= 0.3);
    s.targets.iter_mut().for_each(|(_, twist)| *twist = twist.map(|value| 0.3 * value));
    s
}

/// A spring, a damper and something that shakes each joint.
fn law(time: f64, angles: &[f64], rates: &[f64]) -> Vec<f64> {
    angles.iter().zip(rates).map(|(angle, rate)| 0.4 * (3.0 * time).cos() - 0.1 * angle - 0.3 * rate).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, ..config() })]

    /// Momentum, the balance of energy and work, and the ties; and backwards in time it comes from where it came.
    #[test]
    fn loops_move(s in sample(2, 6)) {
        for kinds in MIXTURES {
            let start = looped(&layout("dual_arm_3r"), &slowly(s.clone()), kinds);
            let mut all = start.clone();
            let seen = run(&mut all, 3.0, 0.2, &law);
            prop_assert!(seen.momentum[0].max(seen.momentum[1]).max(seen.energy) < tolerance::MAXIMAL_DRIFT, "{:?}", seen);
            prop_assert!(seen.constraint < tolerance::MAXIMAL_DRIFT && seen.projected < tolerance::MAXIMAL_TIE, "{:?}", seen);
            all.set_twists(&-all.twists());
            let back = |time: f64, angles: &[f64], rates: &[f64]| {
                law(3.0 - time, angles, &rates.iter().map(|rate| -rate).collect::<Vec<_>>())
            };
            run(&mut all, 3.0, 0.2, &back);
            close("angles", &all.joint_angles(), &start.joint_angles(), tolerance::MAXIMAL_MOTION);
            close("twists", (-all.twists()).as_slice(), start.twists().as_slice(), tolerance::MAXIMAL_MOTION);
        }
    }

    /// A target that a tip pins is a link more: the product's robot with that link moves so.
    #[test]
    fn a_pinned_target_is_a_link(s in sample(2, 6)) {
        let layout = layout("dual_arm_3r");
        let mut all = robot(&layout, &s);
        let ([mass, inertia, rx, ry], twist) = s.targets[1];
        let tip = all.position(&all.tips[1]);
        let yaw = 0.4;
        let body = all.add(Body { mass, inertia, pose: [yaw, tip.x - rx, tip.y - ry], twist });
        let contacts = [Contact::new(&all, 1, body, Kind::Pin)];
        all.apply(&contacts, &impact(&all, &contacts));

        let mut longer = layout.clone();
        let at = all.held[0].b.at;
        longer.arms[1].links.push(Link { length: 0.0, mass, inertia, com: [-at.x, -at.y] });
        let hand = all.tips[1].body;
        let between = |of: fn(&Body) -> f64, all: &System| of(&all.bodies[body]) - of(&all.bodies[hand]);
        let angle = |all: &System| [all.joint_angles(), vec![between(|b| b.pose[0], all)]].concat();
        let rate = |all: &System| [all.joint_rates(), vec![between(|b| b.twist[0], all)]].concat();
        let start = RobotState {
            base_pose: s.base_pose,
            joint_angles: angle(&all),
            base_twist: all.bodies[0].twist,
            joint_rates: rate(&all),
        };
        let end = simulated(&*registry::generic(&longer), &mut ZeroTorque, &start, 1.5);
        run(&mut all, 1.5, 0.2, &|_, angles, _| vec![0.0; angles.len()]);
        close("angles", &angle(&all), &end.joint_angles, tolerance::MAXIMAL_MOTION);
        close("rates", &rate(&all), &end.joint_rates, tolerance::MAXIMAL_MOTION);
        close("base pose", &all.bodies[0].pose, &end.base_pose, tolerance::MAXIMAL_MOTION);
    }
}

/// Where arms hold the target so that nothing can move any more, all turns as one body.
#[test]
fn a_locked_loop_is_one_body() {
    let layout = layout("asymmetric_wheel");
    let angles = [0.3, -0.8, 0.5, 0.9, -0.7, 0.2];
    let mut all = System::new(&layout, [0.2, 0.1, -0.3], &angles, [0.2, 0.1, -0.1], &[0.1, -0.3, 0.2, 0.4, -0.2, 0.5]);
    let tip = all.position(&all.tips[1]);
    let body = all.add(Body { mass: 8.0, inertia: 1.5, pose: [0.0, tip.x + 0.2, tip.y], twist: [0.3, -0.2, 0.4] });
    // arm, of two links, and wheel: three joints in a loop that takes three freedoms
    let contacts = [1, 2].map(|arm| Contact::new(&all, arm, body, Kind::Rigid));
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    let rates = all.joint_rates();
    assert_close("locked joints", &rates[3..], &[0.0; 3], tolerance::IDENTITY);
    assert!(rates[0].abs() > 0.01, "the free arm moves");
    let locked = all.joint_angles()[3..].to_vec();
    let seen = run(&mut all, 2.0, 0.2, &law);
    assert_close("locked joints", &all.joint_angles()[3..], &locked, tolerance::MAXIMAL_TIE);
    assert!(seen.energy < tolerance::MAXIMAL_DRIFT, "{seen:?}");
}

/// Poses and twists that miss the ties come onto them without moving the COM, or losing momentum.
#[test]
fn projection_keeps_centre_and_momentum() {
    let layout = layout("dual_arm_2r");
    let mut all = System::new(&layout, [0.2, 0.0, 0.0], &[0.3, -1.2, 2.1, 1.4], [0.1, 0.2, 0.0], &[0.3; 4]);
    for (i, body) in all.bodies.iter_mut().enumerate() {
        let off = 0.01 * f64::from(u8::try_from(i).expect("few")).sin();
        body.pose.iter_mut().chain(&mut body.twist).for_each(|value| *value += off);
    }
    let centre = |all: &System| [1, 2].map(|i| all.bodies.iter().map(|b| b.mass * b.pose[i]).sum::<f64>());
    let (was, momentum) = (centre(&all), all.momentum());
    let [before, ..] = project(&mut all);
    project(&mut all);
    let [_, after, _] = project(&mut all);
    assert!(before > 1e-3 && after < tolerance::MAXIMAL_TIE, "{before:e} {after:e}");
    close("centre", &centre(&all), &was, tolerance::IDENTITY);
    close("linear momentum", &all.momentum()[1..], &momentum[1..], tolerance::IDENTITY);
    let ties: Vec<Tie> = all.ties().copied().collect();
    assert!((rows(&all, &ties) * all.twists()).amax() < tolerance::MAXIMAL_TIE);
}
