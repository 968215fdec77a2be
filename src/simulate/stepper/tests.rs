//! A phase in the moving frame against the same in the inertial frame.

use crate::contact::{ContactPartner, LoopConstraint};
use crate::control::{BaseTorque, Control};
use crate::dynamics::AnyModel;
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::simulate::event::{EventState, Events, NoEvents};
use crate::simulate::moving_frame::MovingFrame;
use crate::simulate::path::PathPart;
use crate::simulate::stepper::{Formulation, Integration, Integrator};
use crate::simulate::system::{Body, System};
use crate::simulate::{Phase, Timing, simulate};
use crate::state::State;
use planar_proof::{assert_close, layout, tolerance};

/// Torques that depend on where the base is, how fast it is, and on the time.
struct ByPlace;

impl Control<f64> for ByPlace {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &AnyModel<f64>,
        state: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        let ([_, x, y], [_, vx, _]) = (state.base_pose, state.base_twist);
        torques.copy_from_slice(&[0.3 * libm::sin(0.5 * x), 0.1 * libm::cos(0.4 * y + time) * vx]);
        Ok(())
    }
}

/// The base passes this x, m.
struct Passes(f64);

impl Events for Passes {
    fn count(&self) -> usize {
        1
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        values.fill(self.0 - now.state.base_pose[1]);
        Ok(())
    }
}

/// The base turns by 0.02 rad/s, and goes by these velocities.
fn robot(velocity: [f64; 2]) -> (Box<dyn CloneModel>, RobotState) {
    let state = RobotState {
        base_pose: [0.2, -0.4, 0.7],
        joint_angles: vec![0.4, -0.9],
        base_twist: [0.02, velocity[0], velocity[1]],
        joint_rates: vec![-0.05, 0.12],
    };
    (registry::generic(&layout("single_arm_2r")), state)
}

/// From the body's COM to the end effector, 0.4 m away in −x, in the axes of the body, which are turned by −`angle`.
fn at_contact(angle: f64) -> [f64; 2] {
    [-0.4 * libm::cos(angle), -0.4 * libm::sin(angle)]
}

/// Up to x = 5 m; a reach that is farther than the phase goes has it in the inertial frame.
fn phase(integration: Integration, is_pinned: bool, reach: f64) -> Phase {
    let (model, state) = robot([1.2, -0.7]);
    let (mut tip, mut twist) = ([[0.0; 3]], [[0.0; 3]]);
    model.end_effector_poses(&state.base_pose, &state.joint_angles, &mut tip).expect("a pose");
    model.end_effector_twists(&state.view(), &mut twist).expect("a twist");
    // turning about the end effector
    let ([[_, x, y]], [[_, vx, vy]]) = (tip, twist);
    let bodies = [Body { mass: 3.0, inertia: 0.5, pose: [0.3, x + 0.4, y], twist: [0.6, vx, vy + 0.6 * 0.4] }];
    let pin = LoopConstraint { arm: 0, partner: ContactPartner::Body(0), offset: at_contact(-0.3), yaw: None };
    let system = System { reach, ..System::alone(&*model) };
    let system = if is_pinned { System { bodies: &bodies, constraints: &[pin], ..system } } else { system };
    let start = system.vector(&state.view()).expect("a vector");
    assert_eq!(MovingFrame::of(&system, &start, 8.0).expect("a frame").is_moving(), reach < 8.0);
    let timing = Timing { duration: 8.0, step: 0.01, sample: 0.5, integration, kink: None };
    simulate(&system, &mut ByPlace, &state, &timing, &mut Passes(5.0), &mut || ()).expect("a phase")
}

/// Positions, velocities, momentum and energy of all samples.
fn numbers(phase: &Phase) -> Vec<f64> {
    let each = phase.samples.iter().flat_map(|sample| {
        let bodies = sample.bodies.iter().flat_map(|body| [body.pose, body.twist].concat());
        let momentum = sample.momentum;
        [
            &sample.state.base_pose[..],
            &sample.state.joint_angles,
            &sample.state.base_twist,
            &sample.state.joint_rates,
            sample.end_effector_poses.as_flattened(),
            sample.end_effector_twists.as_flattened(),
            &momentum.linear_momentum,
            &[momentum.angular_momentum, momentum.kinetic_energy, sample.time, sample.work.total()],
        ]
        .concat()
        .into_iter()
        .chain(bodies)
        .collect::<Vec<_>>()
    });
    each.collect()
}

/// What the law is given, where an event is, and all that is reported.
#[test]
fn results_are_those_of_the_inertial_frame() {
    let full = Formulation::Full;
    for (integrator, coordinates) in [
        (Integrator::RungeKutta4, full),
        (Integrator::RungeKutta4, Formulation::Reduced),
        (Integrator::SemiImplicitEuler, full),
        (Integrator::GaussLegendre, full),
        (Integrator::Adaptive { tolerance: 1e-13 }, full),
    ] {
        for is_pinned in [false, true] {
            if is_pinned && coordinates == Formulation::Reduced {
                continue;
            }
            let integration = Integration { integrator, coordinates };
            let [moving, inertial] = [1.0, 1e3].map(|reach| phase(integration, is_pinned, reach));
            let name = format!("{integration:?}, pinned: {is_pinned}");
            assert!(inertial.event.is_some_and(|(_, time)| time > 3.0 && time < 7.0), "{name}: {:?}", inertial.event);
            assert_close(&name, &numbers(&moving), &numbers(&inertial), tolerance::SAME_MOTION_COARSE);
            assert!(moving.path_error < 1.5 * inertial.path_error + 1e-11, "{name}: {:e}", moving.path_error);
            // a path has cubics between knots: 1e-10 from the states of short steps, 1e-8 within adaptive ones
            let of_positions = if integrator.properties().is_adaptive { 4e-8 } else { 3e-10 };
            for time in [0.0, 1.3, 2.6] {
                let [[positions, rates], expected] = [&moving, &inertial].map(|phase| path_at(phase, time));
                assert_close(&name, &positions, &expected[0], of_positions);
                assert_close(&name, &rates, &expected[1], 4e-8);
            }
        }
    }
}

/// Positions and rates of the path.
fn path_at(phase: &Phase, time: f64) -> [Vec<f64>; 2] {
    let mut found = [Vec::new(), Vec::new()];
    let visited = phase.path.try_for_each(|interval| {
        let [start, end] = interval.span;
        if found[0].is_empty() && start <= time && time <= end {
            let size = interval.start[0].len();
            let (mut positions, mut rates) = (vec![0.0; size], vec![0.0; size]);
            interval.at(time, &mut positions, &mut rates);
            found = [positions, rates];
        }
        Ok::<(), std::io::Error>(())
    });
    visited.expect("a path in memory");
    assert!(!found[0].is_empty());
    found
}

/// The velocity is that of the centre of mass of all; a robot that goes less far than it reaches stays in the inertial frame.
#[test]
fn the_frame_moves_with_the_centre_of_mass() {
    let (model, state) = robot([1.2, -0.7]);
    let body = Body { mass: 7.0, inertia: 1.0, pose: [0.0, 2.0, 1.0], twist: [0.0, 1.25, -0.65] };
    let system = System { bodies: &[body], ..System::alone(&*model) };
    let x = system.vector(&state.view()).expect("a vector");
    let momentum = model.momentum(&state.view()).expect("a momentum").linear_momentum;
    let mut inertias = [[0.0; 2]; 3];
    model.body_inertias(&mut inertias).expect("inertias");
    let mass: f64 = inertias.iter().map(|[mass, _]| mass).sum();
    let expected = [0, 1].map(|i: usize| (momentum[i] + 7.0 * [1.25, -0.65][i]) / (mass + 7.0));
    let speed = libm::hypot(expected[0], expected[1]);
    let frame = |duration| MovingFrame::of(&system, &x, duration).expect("a frame").velocity;
    assert_close("velocity", &frame(1.01 / speed), &expected, tolerance::IDENTITY);
    assert_close("near", &frame(0.99 / speed), &[0.0; 2], 0.0);
    let far = MovingFrame::of(&system, &x, 2.0).expect("a frame");
    assert_close("rounding", &[far.rounding(1e9) / (1e9 * speed * f64::EPSILON)], &[1.0], 1e-7);
    let mut moved = x.clone();
    far.enter(0.0, &mut moved).expect("a vector");
    let at = |x: &[f64]| (State::from_vector(x, 2).expect("a state").base_pose, system.bodies_at(x).expect("bodies"));
    let ((base, bodies), (from, before)) = (at(&moved), at(&x));
    let came = |pose: [f64; 3], from: [f64; 3]| [pose[1] - from[1], pose[2] - from[2]];
    let origin = far.origin.map(|place| -place);
    assert_close("base", &came(base, from), &origin, tolerance::IDENTITY);
    assert_close("body", &came(bodies[0].pose, before[0].pose), &origin, tolerance::IDENTITY);
    let mut later = x.clone();
    far.enter(3.0, &mut later).expect("a vector");
    let went = [0, 1].map(|i: usize| -(far.origin[i] + 3.0 * far.velocity[i]));
    assert_close("later", &came(at(&later).0, from), &went, tolerance::IDENTITY);
    assert_close(
        "rounding",
        &[far.rounding(3.0) / f64::EPSILON],
        &[libm::hypot(went[0], went[1])],
        tolerance::IDENTITY,
    );
    // a fiftieth of the energy is of relative motion
    let slower = Body { twist: [0.0, 2.3, -0.7], ..body };
    let system = System { bodies: &[slower], ..system };
    let slower = MovingFrame::of(&system, &system.vector(&state.view()).expect("a vector"), 1e6).expect("a frame");
    assert_close("slower", &slower.velocity, &[0.0; 2], 0.0);
    // bodies that are as fast relative to each other stay in the inertial frame, however far they go
    let apart = Body { twist: [0.0, 40.0, 20.0], ..body };
    let system = System { bodies: &[apart], ..system };
    let x = system.vector(&state.view()).expect("a vector");
    let found = MovingFrame::of(&system, &x, 1e6).expect("a frame");
    assert_close("slow", &found.velocity, &[0.0; 2], 0.0);
}

/// Constant torques, with one on the base or without, which say so or not.
struct Constant {
    base_torque: Option<BaseTorque<f64>>,
    says_so: bool,
    calls: u32,
}

impl Control<f64> for Constant {
    fn joint_torques(
        &mut self,
        _: f64,
        _: &AnyModel<f64>,
        _: &State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        self.calls += 1;
        torques.iter_mut().zip(1_u8..).for_each(|(torque, joint)| *torque = 0.5 / f64::from(joint));
        Ok(())
    }

    fn is_constant(&self) -> bool {
        self.says_so
    }

    fn base_torque(&self) -> Option<BaseTorque<f64>> {
        self.base_torque
    }
}

/// The motion has the bits of that under torques that are asked for at every stage.
#[test]
fn constant_torques_are_asked_for_once_a_step() {
    const STEPS: u32 = 20;
    let model = registry::generated(&layout("single_arm_3r")).expect("a compiled layout");
    let (joint_angles, joint_rates) = (vec![0.3, -0.8, 0.5], vec![0.2, 0.1, -0.4]);
    let start = RobotState { base_pose: [0.1, 0.4, -0.2], joint_angles, base_twist: [0.05, 0.1, 0.0], joint_rates };
    let timing = Timing { duration: 0.05 * f64::from(STEPS), step: 0.05, sample: 0.05, ..Timing::default() };
    let run = |base_torque, says_so| {
        let mut law = Constant { base_torque, says_so, calls: 0 };
        let phase = simulate(&System::alone(&*model), &mut law, &start, &timing, &mut NoEvents, &mut || ());
        (phase.expect("a phase"), law.calls)
    };
    for base_torque in [None, Some(BaseTorque { torque: -0.7, saturated: false })] {
        let [(once, few), (each, many)] = [true, false].map(|says_so| run(base_torque, says_so));
        assert_eq!(once.samples, each.samples, "{base_torque:?}");
        assert!(base_torque.is_some() || few + 3 * STEPS < many, "{few} of {many} calls");
    }
}
