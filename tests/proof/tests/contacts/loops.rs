//! The reference's motion of closed loops: two arms that have captured one target, rigid or pinned.

use crate::{add_target, robot, scaled_velocities, simulated};
use nalgebra::{DMatrix, DVector};
use planar_capture::control::ZeroTorque;
use planar_capture::layout::{Layout, Link};
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::constraint::{centripetal, jacobian, residual};
use planar_proof::maximal::impact::{Contact, Kind, impact};
use planar_proof::maximal::kkt_system::KktSystem;
use planar_proof::maximal::motion::{accelerations, project, run};
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, close, layout, tolerance};
use proptest::prelude::*;

/// The robot after the capture of one target by its first two arms, with contacts of these kinds.
fn closed_loop(layout: &Layout, s: &RandomState, kinds: [Kind; 2]) -> System {
    let mut all = robot(layout, s);
    let body = add_target(&mut all, &s.targets[0], 0, 0.7);
    let contacts = [0, 1].map(|arm| Contact::new(&all, arm, body, kinds[arm]));
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    all
}

const MIXTURES: [[Kind; 2]; 4] =
    [[Kind::Rigid, Kind::Rigid], [Kind::Rigid, Kind::Pin], [Kind::Pin, Kind::Rigid], [Kind::Pin, Kind::Pin]];

/// The KKT system as one dense matrix: [M −Aᵀ; A 0] [a; λ] = [f; −Ȧ v].
fn dense_solution(all: &System, forces: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
    let constraints = all.constraints();
    let a = jacobian(&all.bodies, &constraints);
    let (m, n) = a.shape();
    let mut matrix = DMatrix::zeros(n + m, n + m);
    matrix.view_mut((0, 0), (n, n)).set_diagonal(&all.masses());
    matrix.view_mut((0, n), (n, m)).copy_from(&-a.transpose());
    matrix.view_mut((n, 0), (m, n)).copy_from(&a);
    let mut right = DVector::zeros(n + m);
    right.rows_mut(0, n).copy_from(forces);
    right.rows_mut(n, m).copy_from(&-centripetal(&all.bodies, &constraints));
    let solution = matrix.full_piv_lu().solve(&right).expect("a regular matrix");
    (solution.rows(0, n).into_owned(), solution.rows(n, m).into_owned())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, ..config() })]

    #[test]
    fn accelerations_are_those_of_the_whole_matrix(s in sample(2, 6)) {
        for kinds in MIXTURES {
            let all = closed_loop(&layout("dual_arm_3r"), &s, kinds);
            let mut forces = DVector::zeros(3 * all.bodies.len());
            for (joint, torque) in s.joint_torques.iter().enumerate() {
                let constraint = &all.joints[joint].constraint;
                forces[3 * constraint.a.body] += torque;
                forces[3 * constraint.b.body] -= torque;
            }
            let (expected, wanted_multipliers) = dense_solution(&all, &forces);
            let found = accelerations(&all, &s.joint_torques);
            close("accelerations", found.as_slice(), expected.as_slice(), tolerance::MAXIMAL_ACCELERATION);
            let constraints = all.constraints();
            let system = KktSystem::new(&all, &constraints);
            prop_assert!(!system.redundant);
            let multipliers = system.solve(&forces, &-centripetal(&all.bodies, &constraints)).1;
            close("forces", multipliers.as_slice(), wanted_multipliers.as_slice(), tolerance::MAXIMAL_ACCELERATION);
        }
    }

    /// A v is the rate of the residual and Ȧ v that of A v, for any motion, by central differences.
    #[test]
    fn rows_are_derivatives(s in sample(2, 6), twists in prop::collection::vec(-1.0..1.0_f64, 24)) {
        let mut all = closed_loop(&layout("dual_arm_3r"), &s, [Kind::Rigid, Kind::Pin]);
        all.set_twists(&DVector::from_vec(twists));
        let constraints = all.constraints();
        let h = 1e-5;
        let moved = |by: f64| {
            let mut moved = all.clone();
            moved.bodies.iter_mut().for_each(|b| (0..3).for_each(|i| b.pose[i] += by * b.twist[i]));
            (residual(&moved.bodies, &constraints), jacobian(&moved.bodies, &constraints) * all.twists())
        };
        let ((to, faster), (from, slower)) = (moved(h), moved(-h));
        let velocity = jacobian(&all.bodies, &constraints) * all.twists();
        assert_close("A v", ((to - from) / (2.0 * h)).as_slice(), velocity.as_slice(), tolerance::DIFFERENCE_QUOTIENT);
        let by_differences = (faster - slower) / (2.0 * h);
        assert_close("Ȧ v", by_differences.as_slice(), centripetal(&all.bodies, &constraints).as_slice(), tolerance::DIFFERENCE_QUOTIENT);
    }
}

/// A spring, a damper and a periodic torque at each joint.
fn law(time: f64, angles: &[f64], rates: &[f64]) -> Vec<f64> {
    angles.iter().zip(rates).map(|(angle, rate)| 0.4 * (3.0 * time).cos() - 0.1 * angle - 0.3 * rate).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, ..config() })]

    /// Momentum, energy balance and constraints hold; motion backwards in time returns to the start.
    #[test]
    fn closed_loops_conserve_and_reverse(s in sample(2, 6)) {
        for kinds in MIXTURES {
            let start = closed_loop(&layout("dual_arm_3r"), &scaled_velocities(s.clone(), 0.3), kinds);
            let mut all = start.clone();
            let seen = run(&mut all, 3.0, 0.2, &law);
            prop_assert!(seen.momentum[0].max(seen.momentum[1]).max(seen.energy) < tolerance::MAXIMAL_DRIFT, "{:?}", seen);
            prop_assert!(seen.constraint < tolerance::MAXIMAL_DRIFT && seen.projected < tolerance::MAXIMAL_CONSTRAINT, "{:?}", seen);
            all.set_twists(&-all.twists());
            let back = |time: f64, angles: &[f64], rates: &[f64]| {
                law(3.0 - time, angles, &rates.iter().map(|rate| -rate).collect::<Vec<_>>())
            };
            run(&mut all, 3.0, 0.2, &back);
            close("angles", &all.joint_angles(), &start.joint_angles(), tolerance::MAXIMAL_MOTION);
            close("twists", (-all.twists()).as_slice(), start.twists().as_slice(), tolerance::MAXIMAL_MOTION);
        }
    }

    /// A target pinned to an end effector moves as a further link of the product's robot.
    #[test]
    fn a_pinned_target_is_a_link(s in sample(2, 6)) {
        let layout = layout("dual_arm_3r");
        let mut all = robot(&layout, &s);
        let ([mass, inertia, ..], _) = s.targets[1];
        let body = add_target(&mut all, &s.targets[1], 1, 0.4);
        let contacts = [Contact::new(&all, 1, body, Kind::Pin)];
        all.apply(&contacts, &impact(&all, &contacts));

        let mut longer = layout.clone();
        let contact = all.captures[0].b.offset;
        longer.arms[1].links.push(Link { length: 0.0, mass, inertia, com: [-contact.x, -contact.y], outline: None });
        let last_link = all.end_effectors[1].body;
        let relative = |of: fn(&Body) -> f64, all: &System| of(&all.bodies[body]) - of(&all.bodies[last_link]);
        let angle = |all: &System| [all.joint_angles(), vec![relative(|b| b.pose[0], all)]].concat();
        let rate = |all: &System| [all.joint_rates(), vec![relative(|b| b.twist[0], all)]].concat();
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

/// Arms whose joints are all locked by the loop rotate with the target as one rigid body.
#[test]
fn a_locked_loop_is_one_body() {
    let layout = layout("asymmetric_wheel");
    let angles = [0.3, -0.8, 0.5, 0.9, -0.7, 0.2];
    let mut all = System::new(&layout, [0.2, 0.1, -0.3], &angles, [0.2, 0.1, -0.1], &[0.1, -0.3, 0.2, 0.4, -0.2, 0.5]);
    let end_effector = all.end_effector(1);
    let body = all.add(Body {
        mass: 8.0,
        inertia: 1.5,
        pose: [0.0, end_effector.x + 0.2, end_effector.y],
        twist: [0.3, -0.2, 0.4],
    });
    // an arm of two links and a wheel: three joints in a loop with three constraints
    let contacts = [1, 2].map(|arm| Contact::new(&all, arm, body, Kind::Rigid));
    let found = impact(&all, &contacts);
    all.apply(&contacts, &found);
    let rates = all.joint_rates();
    assert_close("locked joints", &rates[3..], &[0.0; 3], tolerance::IDENTITY);
    assert!(rates[0].abs() > 0.01, "the free arm moves");
    let locked = all.joint_angles()[3..].to_vec();
    let seen = run(&mut all, 2.0, 0.2, &law);
    assert_close("locked joints", &all.joint_angles()[3..], &locked, tolerance::MAXIMAL_CONSTRAINT);
    assert!(seen.energy < tolerance::MAXIMAL_DRIFT, "{seen:?}");
}

/// Projection of poses and twists onto the constraints keeps the centre of mass and the momentum.
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
    assert!(before > 1e-3 && after < tolerance::MAXIMAL_CONSTRAINT, "{before:e} {after:e}");
    close("centre", &centre(&all), &was, tolerance::IDENTITY);
    close("linear momentum", &all.momentum()[1..], &momentum[1..], tolerance::IDENTITY);
    let constraints = all.constraints();
    assert!((jacobian(&all.bodies, &constraints) * all.twists()).amax() < tolerance::MAXIMAL_CONSTRAINT);
}
