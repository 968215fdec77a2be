//! The product's motion with holds, by constraint forces on recursions and merged links, against that of free bodies.

use crate::against_product::{Shaken, shaken};
use crate::product::law;
use crate::robot;
use planar_capture::capture::assembly::{Assembly, Attachment};
use planar_capture::control::{Control, ZeroTorque};
use planar_capture::layout::Layout;
use planar_capture::owned::RobotState;
use planar_capture::registry;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::{Integration, Scheme};
use planar_capture::simulate::{Phase, Sample, Timing, simulate};
use planar_capture::state::State;
use planar_proof::maximal::body::Body;
use planar_proof::maximal::impact::{Contact, Kind, impact};
use planar_proof::maximal::motion::run;
use planar_proof::maximal::system::System;
use planar_proof::sample::{RandomState, config, sample};
use planar_proof::{assert_close, close, layout, tolerance};
use proptest::prelude::*;

/// A robot that holds a target of the sample's, in both terms.
struct Held {
    all: System,
    assembly: Assembly,
    state: RobotState,
    target: planar_capture::body::Body<f64>,
}

fn held(layout: &Layout, s: &RandomState, holding: &[(usize, Kind)]) -> Held {
    let mut all = robot(layout, s);
    let ([mass, inertia, rx, ry], twist) = s.targets[0];
    let tip = all.position(&all.tips[holding[0].0]);
    let body = all.add(Body { mass, inertia, pose: [0.7, tip.x - rx, tip.y - ry], twist });
    let contacts: Vec<_> = holding.iter().map(|(arm, kind)| Contact::new(&all, *arm, body, *kind)).collect();
    all.apply(&contacts, &impact(&all, &contacts));
    let state = RobotState {
        base_pose: s.base_pose,
        joint_angles: s.joint_angles.clone(),
        base_twist: all.bodies[0].twist,
        joint_rates: all.joint_rates(),
    };
    let Body { mass, inertia, pose, twist } = all.bodies[body];
    let target = planar_capture::body::Body { mass, inertia, pose, twist };
    let grips: Vec<_> =
        holding.iter().map(|(arm, kind)| Attachment { target: 0, arm: *arm, kind: law(*kind).kind() }).collect();
    let model = registry::generated(layout).unwrap_or_else(|_| registry::generic(layout));
    let assembly = Assembly::new(model, &state, &[target], &grips).expect("an assembly");
    Held { all, assembly, state, target }
}

impl Held {
    fn simulated(&self, controlled: bool, timing: &Timing) -> Phase {
        let control: &mut dyn Control<f64> = if controlled { &mut Shaken } else { &mut ZeroTorque };
        simulate(&self.assembly.system(), control, &self.state, timing, &mut NoEvents, &mut || ()).expect("a motion")
    }

    fn target_at(&self, now: &Sample) -> planar_capture::body::Body<f64> {
        let (tips, twists) = (&now.end_effector_poses, &now.end_effector_twists);
        self.assembly.targets(&[self.target], tips, twists, &now.bodies)[0]
    }

    /// Where the tips that hold are in the target's frame, [x, y] of each, and their yaws of the rigid ones.
    fn relative_tips(&self, now: &Sample, holding: &[(usize, Kind)]) -> Vec<f64> {
        let [yaw, x, y] = self.target_at(now).pose;
        let (sin, cos) = yaw.sin_cos();
        let of = |(arm, kind): &(usize, Kind)| {
            let [tip_yaw, tip_x, tip_y] = now.end_effector_poses[*arm];
            let (dx, dy) = (tip_x - x, tip_y - y);
            let turned = (*kind == Kind::Rigid).then_some(tip_yaw - yaw);
            [cos * dx + sin * dy, cos * dy - sin * dx].into_iter().chain(turned)
        };
        holding.iter().flat_map(of).collect()
    }
}

const MIXTURES: [&[(usize, Kind)]; 5] = [
    &[(0, Kind::Rigid), (1, Kind::Rigid)],
    &[(0, Kind::Rigid), (1, Kind::Pin)],
    &[(0, Kind::Pin), (1, Kind::Rigid)],
    &[(0, Kind::Pin), (1, Kind::Pin)],
    &[(1, Kind::Pin)],
];

/// Slower by a factor.
fn slowly(mut s: RandomState) -> RandomState {
    s.base_twist = s.base_twist.map(|value| 0.2 * value);
    s.joint_rates.iter_mut().for_each(|value| *value *= 0.2);
    s.targets.iter_mut().for_each(|(_, twist)| *twist = twist.map(|value| 0.2 * value));
    s
}

/// The end of a motion, and of the reference's; `false` where a loop came near a configuration that locks it.
fn check(layout: &Layout, s: &RandomState, holding: &[(usize, Kind)], controlled: bool, duration: f64) -> bool {
    let mut held = held(layout, s, holding);
    let none = |_: f64, angles: &[f64], _: &[f64]| vec![0.0; angles.len()];
    let seen = run(&mut held.all, duration, 0.25, if controlled { &shaken } else { &none });
    if seen.margin < tolerance::SEEN_MARGIN {
        return false;
    }
    let integration = Integration { scheme: Scheme::Adaptive { tolerance: 1e-12 }, ..Integration::default() };
    let phase = held.simulated(controlled, &Timing { duration, step: 0.05, sample: duration, integration });
    let end = phase.end();
    let (all, bound) = (&held.all, tolerance::HELD_MOTION);
    close("angles", &end.state.joint_angles, &all.joint_angles(), bound);
    close("rates", &end.state.joint_rates, &all.joint_rates(), bound);
    close("base pose", &end.state.base_pose, &all.bodies[0].pose, bound);
    close("base twist", &end.state.base_twist, &all.bodies[0].twist, bound);
    let (target, body) = (held.target_at(end), all.bodies.last().expect("the target"));
    close("target pose", &target.pose, &body.pose, bound);
    close("target twist", &target.twist, &body.twist, bound);
    assert_close("work", &[end.work.joint_work], &[seen.work], bound * end.momentum.kinetic_energy.max(1.0));
    true
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2, ..config() })]

    #[test]
    fn what_is_held_moves_freely(s in sample(2, 6)) {
        for holding in MIXTURES {
            prop_assume!(check(&layout("dual_arm_3r"), &slowly(s.clone()), holding, false, 8.0));
        }
    }

    #[test]
    fn what_is_held_moves_under_torques(s in sample(2, 6)) {
        for holding in MIXTURES {
            prop_assume!(check(&layout("dual_arm_3r"), &slowly(s.clone()), holding, true, 5.0));
        }
    }

    /// Three hands on one target, with a model of another structure.
    #[test]
    fn three_arms_hold_one_target(s in sample(3, 9)) {
        for holding in [[(0, Kind::Pin), (1, Kind::Rigid), (2, Kind::Pin)], [(2, Kind::Pin), (0, Kind::Pin), (1, Kind::Pin)]] {
            prop_assume!(check(&layout("triple_arm_3r"), &slowly(s.clone()), &holding, true, 4.0));
        }
    }
}

/// One start for long and repeated runs: elbows out, the tips at two sides of a target.
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

/// No hold opens in 10,000 steps, and what rounding does at the end is no more than at the beginning.
#[test]
fn nothing_opens() {
    for holding in MIXTURES {
        let held = held(&layout("dual_arm_3r"), &start(), holding);
        let phase = held.simulated(false, &Timing { duration: 100.0, step: 0.01, sample: 0.01, ..Timing::default() });
        let [position, rate] = phase.constraint_errors;
        assert!(position.max(rate) <= tolerance::HELD_CLOSED, "{holding:?}: {position:e} {rate:e}");
        let first = held.relative_tips(&phase.samples[0], holding);
        let open: Vec<f64> = phase
            .samples
            .iter()
            .map(|sample| planar_proof::difference(&held.relative_tips(sample, holding), &first))
            .collect();
        let tenth = open.len() / 10;
        let most = |part: &[f64]| part.iter().fold(0.0_f64, |most, value| most.max(*value));
        let (early, late) = (most(&open[..tenth]), most(&open[open.len() - tenth..]));
        assert!(most(&open) <= tolerance::HELD_CLOSED, "{holding:?}: {:e}", most(&open));
        assert!(late <= 2.0 * early + tolerance::HELD_CLOSED / 10.0, "{holding:?}: {early:e}, then {late:e}");
    }
}

/// Momentum, energy and where it ends: errors of Runge–Kutta steps, which fall with their fourth power.
#[test]
fn holds_keep_the_order_of_the_integrator() {
    for holding in MIXTURES {
        let mut exact = held(&layout("dual_arm_3r"), &start(), holding);
        run(&mut exact.all, 4.0, 0.25, &shaken);
        let held = held(&layout("dual_arm_3r"), &start(), holding);
        let errors = [0.08, 0.04, 0.02].map(|step| {
            let phase = held.simulated(true, &Timing { duration: 4.0, step, sample: 4.0, ..Timing::default() });
            let end = &phase.end().state;
            let angles = planar_proof::difference(&end.joint_angles, &exact.all.joint_angles());
            [phase.drift.momentum_drift, phase.drift.energy_error, angles]
        });
        for (what, k) in ["momentum", "energy", "angles"].iter().zip(0..) {
            let order = (errors[1][k] / errors[2][k]).log2();
            assert!(order > 4.0 - tolerance::ORDER_OF_DIFFERENCE, "{what} of {holding:?}: {errors:?}");
        }
    }
}

/// Centre of mass of robot and target, and momentum [l, px, py], at an integrated vector.
fn whole(held: &Held, x: &[f64]) -> ([f64; 2], [f64; 3]) {
    let system = held.assembly.system();
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

/// What opened is closed by the least that the masses allow: as by internal forces, without moving the centre of mass
/// or changing the momentum.
#[test]
fn closing_keeps_centre_and_momentum() {
    for holding in MIXTURES {
        let held = held(&layout("dual_arm_3r"), &start(), holding);
        let system = held.assembly.system();
        let closed = system.vector(&held.state.view()).expect("a vector");
        let half = (closed.len() - 3) / 2;
        let off = |i: usize| tolerance::OPENED * (3.0 * f64::from(u8::try_from(i).expect("few"))).sin();
        let mut opened = closed.clone();
        opened.iter_mut().enumerate().take(half).for_each(|(i, value)| *value += off(i));
        let ((was, _), mut x) = (whole(&held, &opened), opened.clone());
        system.restore(&mut x).expect("closed again");
        let moved = planar_proof::difference(&x[..half], &opened[..half]);
        assert!(moved > 0.1 * tolerance::OPENED, "{moved:e}");
        assert_close("centre", &whole(&held, &x).0, &was, tolerance::CENTRE);
        let [open, opening] = system.constraint_errors(&x).expect("errors");
        assert!(open.max(opening) <= tolerance::HELD_CLOSED, "{holding:?} {open:e} {opening:e}");

        let mut opened = closed.clone();
        opened.iter_mut().enumerate().skip(half).take(half).for_each(|(i, value)| *value += off(i));
        let ((_, was), mut x) = (whole(&held, &opened), opened);
        system.restore(&mut x).expect("closed again");
        close("momentum", &whole(&held, &x).1, &was, tolerance::IDENTITY);
    }
}
