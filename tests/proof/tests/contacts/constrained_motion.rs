//! The product's motion of captured targets, by loop constraints and merged links, against the reference.

use crate::against_product::{Excitation, excitation_torques};
use crate::product::{self, law};
use crate::{add_target, robot, robot_state, scaled_velocities};
use planar_capture::capture::assembly::{Assembly, Attachment};
use planar_capture::contact::{ContactPartner, LoopConstraint};
use planar_capture::control::{Control, ZeroTorque};
use planar_capture::layout::Layout;
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::{Integration, Integrator};
use planar_capture::simulate::{Phase, Sample, Timing, simulate};
use planar_capture::state::State;
use planar_proof::maximal::impact::{Contact, Kind, impact};
use planar_proof::maximal::motion::run;
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, close, layout, tolerance};
use proptest::prelude::*;

/// A robot after the capture of a target, in the terms of the reference and of the product.
struct Capture {
    all: System,
    assembly: Assembly,
    state: RobotState,
    target: planar_capture::body::Body<f64>,
}

fn capture(layout: &Layout, s: &RandomState, kinds: &[(usize, Kind)]) -> Capture {
    let mut all = robot(layout, s);
    let body = add_target(&mut all, &s.targets[0], kinds[0].0, 0.7);
    let contacts: Vec<_> = kinds.iter().map(|(arm, kind)| Contact::new(&all, *arm, body, *kind)).collect();
    all.apply(&contacts, &impact(&all, &contacts));
    let state = robot_state(&all, s);
    let target = product::body(&all.bodies[body]);
    let attachments: Vec<_> =
        kinds.iter().map(|(arm, kind)| Attachment { target: 0, arm: *arm, kind: law(*kind).kind() }).collect();
    let model = registry::generated(layout).unwrap_or_else(|_| registry::generic(layout));
    let assembly = Assembly::new(model, &state, &[target], &attachments).expect("an assembly");
    Capture { all, assembly, state, target }
}

impl Capture {
    fn simulated(&self, controlled: bool, timing: &Timing) -> Phase {
        let control: &mut dyn Control<f64> = if controlled { &mut Excitation } else { &mut ZeroTorque };
        simulate(&self.assembly.system(), control, &self.state, timing, &mut NoEvents, &mut || ()).expect("a motion")
    }

    fn target_at(&self, now: &Sample) -> planar_capture::body::Body<f64> {
        let (poses, twists) = (&now.end_effector_poses, &now.end_effector_twists);
        self.assembly.targets(&[self.target], poses, twists, &now.bodies)[0]
    }

    /// [x, y] of each constrained end effector in the target's frame, and its relative yaw where the contact is rigid.
    fn relative_poses(&self, now: &Sample, kinds: &[(usize, Kind)]) -> Vec<f64> {
        let [yaw, x, y] = self.target_at(now).pose;
        let (sin, cos) = yaw.sin_cos();
        let relative_pose = |(arm, kind): &(usize, Kind)| {
            let [end_effector_yaw, end_effector_x, end_effector_y] = now.end_effector_poses[*arm];
            let (dx, dy) = (end_effector_x - x, end_effector_y - y);
            let relative_yaw = (*kind == Kind::Rigid).then_some(end_effector_yaw - yaw);
            [cos * dx + sin * dy, cos * dy - sin * dx].into_iter().chain(relative_yaw)
        };
        kinds.iter().flat_map(relative_pose).collect()
    }
}

const MIXTURES: [&[(usize, Kind)]; 5] = [
    &[(0, Kind::Rigid), (1, Kind::Rigid)],
    &[(0, Kind::Rigid), (1, Kind::Pin)],
    &[(0, Kind::Pin), (1, Kind::Rigid)],
    &[(0, Kind::Pin), (1, Kind::Pin)],
    &[(1, Kind::Pin)],
];

/// Compares the end of a motion with the reference's; `false` where a loop came near a singular configuration.
fn check(layout: &Layout, s: &RandomState, kinds: &[(usize, Kind)], controlled: bool, duration: f64) -> bool {
    let mut capture = capture(layout, s, kinds);
    let zero = |_: f64, angles: &[f64], _: &[f64]| vec![0.0; angles.len()];
    let monitor = run(&mut capture.all, duration, 0.25, if controlled { &excitation_torques } else { &zero });
    if monitor.margin < tolerance::DEPENDENCE_MARGIN {
        return false;
    }
    let integration = Integration { integrator: Integrator::Adaptive { tolerance: 1e-12 }, ..Integration::default() };
    let phase =
        capture.simulated(controlled, &Timing { duration, step: 0.05, sample: duration, integration, kink: None });
    let end = phase.end();
    let (all, bound) = (&capture.all, tolerance::CONSTRAINED_MOTION);
    close("angles", &end.state.joint_angles, &all.joint_angles(), bound);
    close("rates", &end.state.joint_rates, &all.joint_rates(), bound);
    close("base pose", &end.state.base_pose, &all.bodies[0].pose, bound);
    close("base twist", &end.state.base_twist, &all.bodies[0].twist, bound);
    let (target, body) = (capture.target_at(end), all.bodies.last().expect("the target"));
    close("target pose", &target.pose, &body.pose, bound);
    close("target twist", &target.twist, &body.twist, bound);
    assert_close("work", &[end.work.joint_work], &[monitor.work], bound * end.momentum.kinetic_energy.max(1.0));
    true
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, ..config() })]

    #[test]
    fn constrained_motion_without_torques(s in sample(2, 6)) {
        for kinds in MIXTURES {
            prop_assume!(check(&layout("dual_arm_3r"), &scaled_velocities(s.clone(), 0.2), kinds, false, 8.0));
        }
    }

    #[test]
    fn constrained_motion_under_torques(s in sample(2, 6)) {
        for kinds in MIXTURES {
            prop_assume!(check(&layout("dual_arm_3r"), &scaled_velocities(s.clone(), 0.2), kinds, true, 5.0));
        }
    }

    /// Three arms on one target, with a model of another structure.
    #[test]
    fn three_arms_hold_one_target(s in sample(3, 9)) {
        for kinds in [[(0, Kind::Pin), (1, Kind::Rigid), (2, Kind::Pin)], [(2, Kind::Pin), (0, Kind::Pin), (1, Kind::Pin)]] {
            prop_assume!(check(&layout("triple_arm_3r"), &scaled_velocities(s.clone(), 0.2), &kinds, true, 4.0));
        }
    }
}

/// Initial state of long and repeated runs, with the end effectors at two sides of a target.
fn start() -> RandomState {
    RandomState {
        base_pose: [0.3, 0.0, 0.0],
        joint_angles: vec![1.1, 1.0, -1.2, 2.04, -1.0, 1.2],
        base_twist: [0.02, 0.01, -0.01],
        joint_rates: vec![0.04, -0.06, 0.05, -0.03, 0.05, -0.04],
        joint_torques: vec![0.0; 6],
        base_wrench: [0.0; 3],
        end_effector_wrenches: vec![[0.0; 3]; 2],
        targets: vec![([120.0, 60.0, 0.6, -0.4], [0.05, 0.02, -0.03]); 2],
    }
}

/// Constraint errors stay at rounding over 10,000 steps, without growth.
#[test]
fn constraint_errors_stay_at_rounding() {
    for kinds in MIXTURES {
        let capture = capture(&layout("dual_arm_3r"), &start(), kinds);
        let phase =
            capture.simulated(false, &Timing { duration: 100.0, step: 0.01, sample: 0.01, ..Timing::default() });
        let [position, rate] = phase.constraint_errors;
        assert!(position.max(rate) <= tolerance::CONSTRAINT_ERROR, "{kinds:?}: {position:e} {rate:e}");
        let first = capture.relative_poses(&phase.samples[0], kinds);
        let open: Vec<f64> = phase
            .samples
            .iter()
            .map(|sample| planar_proof::difference(&capture.relative_poses(sample, kinds), &first))
            .collect();
        let tenth = open.len() / 10;
        let largest = |part: &[f64]| part.iter().copied().fold(0.0_f64, f64::max);
        let (early, late) = (largest(&open[..tenth]), largest(&open[open.len() - tenth..]));
        assert!(largest(&open) <= tolerance::CONSTRAINT_ERROR, "{kinds:?}: {:e}", largest(&open));
        assert!(late <= 2.0 * early + tolerance::CONSTRAINT_ERROR / 10.0, "{kinds:?}: {early:e}, then {late:e}");
    }
}

/// Errors of momentum, energy and final angles are of order 4 in the Runge–Kutta step.
#[test]
fn constraints_keep_the_order_of_the_integrator() {
    for kinds in MIXTURES {
        let mut exact = capture(&layout("dual_arm_3r"), &start(), kinds);
        run(&mut exact.all, 4.0, 0.25, &excitation_torques);
        let capture = capture(&layout("dual_arm_3r"), &start(), kinds);
        let errors = [0.08, 0.04, 0.02].map(|step| {
            let phase = capture.simulated(true, &Timing { duration: 4.0, step, sample: 4.0, ..Timing::default() });
            let end = &phase.end().state;
            let angles = planar_proof::difference(&end.joint_angles, &exact.all.joint_angles());
            [phase.drift.momentum_drift, phase.drift.energy_error, angles]
        });
        for (what, k) in ["momentum", "energy", "angles"].iter().zip(0..) {
            let order = (errors[1][k] / errors[2][k]).log2();
            assert!(order > 4.0 - tolerance::ORDER_OF_DIFFERENCE, "{what} of {kinds:?}: {errors:?}");
        }
    }
}

/// Centre of mass and momentum [l, px, py] of robot and target at an integrated vector.
fn centre_and_momentum(capture: &Capture, x: &[f64]) -> ([f64; 2], [f64; 3]) {
    let system = capture.assembly.system();
    let model = system.model;
    let state = State::from_vector(x, model.joints()).expect("a state");
    let (mut inertias, mut poses) = (vec![[0.0; 2]; model.joints() + 1], vec![[0.0; 3]; model.joints() + 1]);
    model.body_inertias(&mut inertias).expect("masses");
    model.body_poses(&state.base_pose, state.joint_angles, &mut poses).expect("poses");
    let robot = model.momentum(&state).expect("momentum");
    let [px, py] = robot.linear_momentum;
    let (mut masses, mut momentum) = (0.0, [robot.angular_momentum, px, py]);
    let mut moments = [0.0; 2];
    let mut add = |mass: f64, [_, x, y]: [f64; 3]| {
        masses += mass;
        moments = [moments[0] + mass * x, moments[1] + mass * y];
    };
    inertias.iter().zip(&poses).for_each(|([mass, _], pose)| add(*mass, *pose));
    for body in system.bodies_at(x).expect("bodies") {
        add(body.mass, body.pose);
        momentum.iter_mut().zip(body.momentum().0).for_each(|(sum, part)| *sum += part);
    }
    (moments.map(|moment| moment / masses), momentum)
}

/// Projection onto the constraints in the metric of the masses keeps the centre of mass and the momentum.
#[test]
fn projection_keeps_centre_and_momentum() {
    for kinds in MIXTURES {
        let capture = capture(&layout("dual_arm_3r"), &start(), kinds);
        let system = capture.assembly.system();
        let closed = system.vector(&capture.state.view()).expect("a vector");
        let half = (closed.len() - 3) / 2;
        let perturbation = |i: usize| tolerance::OPENED * (3.0 * f64::from(u8::try_from(i).expect("few"))).sin();
        let mut opened = closed.clone();
        opened.iter_mut().enumerate().take(half).for_each(|(i, value)| *value += perturbation(i));
        let ((was, _), mut x) = (centre_and_momentum(&capture, &opened), opened.clone());
        system.restore(&mut x).expect("projection");
        let moved = planar_proof::difference(&x[..half], &opened[..half]);
        assert!(moved > 0.1 * tolerance::OPENED, "{moved:e}");
        assert_close("centre", &centre_and_momentum(&capture, &x).0, &was, tolerance::CENTRE);
        let [open, opening] = system.constraint_errors(&x).expect("errors");
        assert!(open.max(opening) <= tolerance::CONSTRAINT_ERROR, "{kinds:?} {open:e} {opening:e}");

        let mut opened = closed.clone();
        opened.iter_mut().enumerate().skip(half).take(half).for_each(|(i, value)| *value += perturbation(i));
        let ((_, was), mut x) = (centre_and_momentum(&capture, &opened), opened);
        system.restore(&mut x).expect("projection");
        close("momentum", &centre_and_momentum(&capture, &x).1, &was, tolerance::IDENTITY);
    }
}

/// Errors are those of an opened constraint: the larger coordinate of the gap, and of its rate.
#[test]
fn constraint_errors_are_the_gap_and_its_rate() {
    let capture = capture(&layout("dual_arm_3r"), &start(), &[(0, Kind::Pin), (1, Kind::Pin)]);
    let system = capture.assembly.system();
    let (closed, joints) = (system.vector(&capture.state.view()).expect("a vector"), system.model.joints());
    let body = 3 + joints;
    let half = (closed.len() - 3) / 2;
    let [open, opening] = system.constraint_errors(&closed).expect("errors");
    assert!(open.max(opening) <= tolerance::CONSTRAINT_ERROR, "{open:e} {opening:e}");
    // the largest coordinate with either sign
    for (dx, dy) in [(0.02, -0.3), (-0.4, 0.1), (-0.02, 0.3), (0.4, -0.1)] {
        let (mut x, largest) = (closed.clone(), f64::max(dx, -dx).max(f64::max(dy, -dy)));
        x[half + body + 1] += 3.0 * dx;
        x[half + body + 2] += 3.0 * dy;
        assert_close(
            "rate",
            &system.constraint_errors(&x).expect("errors"),
            &[0.0, 3.0 * largest],
            tolerance::IDENTITY,
        );
        x[body + 1] += dx;
        x[body + 2] += dy;
        let [gap, _] = system.constraint_errors(&x).expect("errors");
        assert_close("gap", &[gap], &[largest], tolerance::IDENTITY);
    }
}

/// A constraint that no configuration satisfies takes bounded time too: end effectors of two arms 100 m apart.
#[test]
fn a_projection_onto_an_impossible_constraint_ends() {
    let layout = layout("dual_arm_3r");
    let (model, state) = (registry::generic(&layout), robot_state(&robot(&layout, &start()), &start()));
    let apart = LoopConstraint { arm: 0, partner: ContactPartner::EndEffector(1), offset: [100.0, 0.0], yaw: None };
    let system = planar_capture::simulate::system::System {
        constraints: &[apart],
        ..planar_capture::simulate::system::System::alone(&*model)
    };
    let mut x = system.vector(&state.view()).expect("a vector");
    let found = system.restore(&mut x);
    let [gap, _] = system.constraint_errors(&x).expect("errors");
    assert!(found.is_ok() && gap > 10.0, "{found:?} {gap}");
}
