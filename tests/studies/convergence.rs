//! Orders of convergence and conservation of the integrators, and their agreement, in full and in reduced coordinates.

use crate::scenario;
use planar_capture::contact::{Contact, ContactLaw, ContactPartner, LoopConstraint};
use planar_capture::control::{Control, ProportionalDerivative, SampledControl, Stabilisation, ZeroTorque};
use planar_capture::error::Error;
use planar_capture::integrate::GaussLegendre;
use planar_capture::owned::{CloneModel, RobotState};
use planar_capture::registry;
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};
use planar_capture::simulate::system::{Body, System};
use planar_capture::simulate::{Phase, Sample, Timing, simulate};
use planar_capture::state::State;
use planar_capture::trajectory::{ConstantSetpoint, Cycloidal, PointToPoint};
use planar_proof::{assert_close, difference, tolerance};
use std::f64::consts::PI;

const FULL: Formulation = Formulation::Full;
const REDUCED: Formulation = Formulation::Reduced;
const ADAPTIVE: Integrator = Integrator::Adaptive { tolerance: 1e-13 };

fn model() -> Box<dyn CloneModel> {
    registry::generated(&scenario("raina_shah_2017").layout).expect("the paper's robot")
}

/// Moving arms and a rotating, drifting base.
fn tumbling() -> RobotState {
    RobotState {
        base_pose: [0.3, 1.0, -2.0],
        joint_angles: vec![0.7, -1.5, 1.0, 2.4, 1.5, -1.0],
        base_twist: [0.2, 0.05, -0.03],
        joint_rates: vec![0.5, -0.8, 0.6, -0.4, 0.9, 0.7],
    }
}

fn run(
    law: &mut dyn Control<f64>,
    duration: f64,
    step: f64,
    integrator: Integrator,
    coordinates: Formulation,
) -> Phase {
    let model = model();
    let timing = Timing {
        duration,
        step,
        sample: duration / 8.0,
        integration: Integration { integrator, coordinates },
        kink: None,
    };
    simulate(&System::alone(&*model), law, &tumbling(), &timing, &mut NoEvents, &mut || ()).expect("a phase")
}

/// Under a law that depends on time, angles and rates.
fn swing(duration: f64, step: f64, integrator: Integrator, coordinates: Formulation) -> Phase {
    let start = tumbling();
    let motion =
        PointToPoint { initial_angles: &start.joint_angles, final_angles: &[0.2, -0.5, 0.4, 2.0, 1.0, 0.1], duration };
    let (stiffness, damping) = ([2.0; 6], [1.5; 6]);
    let trajectory = Cycloidal { motion };
    let mut law = ProportionalDerivative { trajectory, proportional_gain: &stiffness, derivative_gain: &damping };
    run(&mut law, duration, step, integrator, coordinates)
}

fn values(motion: &RobotState) -> Vec<f64> {
    [&motion.base_pose[..], &motion.joint_angles, &motion.base_twist, &motion.joint_rates].concat()
}

fn error(phase: &Phase, reference: &Phase) -> f64 {
    let values = |phase: &Phase| [&values(&phase.end().state)[..], &[phase.end().work.joint_work]].concat();
    difference(&values(phase), &values(reference))
}

/// The error falls by 2^order when the step is halved: under a law that depends on time, angles and rates, and with it
/// the work of its torques.
#[test]
fn orders_of_convergence() {
    let reference = swing(2.0, 0.05, ADAPTIVE, FULL);
    for (integrator, coordinates, order, steps) in [
        (Integrator::RungeKutta4, FULL, 4.0, [40.0, 80.0, 160.0]),
        (Integrator::RungeKutta4, REDUCED, 4.0, [40.0, 80.0, 160.0]),
        (Integrator::SemiImplicitEuler, FULL, 1.0, [1000.0, 2000.0, 4000.0]),
        (Integrator::SemiImplicitEuler, REDUCED, 1.0, [1000.0, 2000.0, 4000.0]),
        (Integrator::GaussLegendre, FULL, 6.0, [20.0, 40.0, 80.0]),
    ] {
        let errors = steps.map(|steps| error(&swing(2.0, 2.0 / steps, integrator, coordinates), &reference));
        for pair in errors.windows(2) {
            let found = (pair[0] / pair[1]).log2();
            let name = format!("{integrator:?}, {coordinates:?}");
            assert!((found - order).abs() < tolerance::ORDER, "{name}: order {found}, not {order}, {errors:?}");
        }
    }
}

/// The error follows the tolerance down to rounding, in both coordinates; that this goes on from one version of the
/// crate to the next is why it is pinned.
#[test]
fn the_adaptive_integrator_keeps_its_tolerance() {
    // a reference of another kind: Richardson's extrapolation of two Gauss–Legendre solutions
    let [coarse, fine] = [0.02, 0.01].map(|step| swing(2.0, step, Integrator::GaussLegendre, FULL));
    let [coarse, fine] = [&coarse, &fine].map(|phase| values(&phase.end().state));
    let reference: Vec<f64> = fine.iter().zip(&coarse).map(|(fine, coarse)| fine + (fine - coarse) / 63.0).collect();
    for coordinates in [FULL, REDUCED] {
        for tolerance in [1e-5, 1e-7, 1e-9, 1e-11, 1e-13] {
            let phase = swing(2.0, 0.05, Integrator::Adaptive { tolerance }, coordinates);
            let error = difference(&values(&phase.end().state), &reference);
            let bound = tolerance::ADAPTIVE * tolerance + tolerance::ROUNDED_MOTION;
            assert!(error <= bound, "{coordinates:?}, {tolerance:e}: {error:e}");
        }
    }
}

/// Between its steps the interpolant is as good as they are: samples of a long run are the ends of shorter ones.
#[test]
fn dense_output_is_as_good_as_steps() {
    let integrator = Integrator::Adaptive { tolerance: 1e-10 };
    let long = run(&mut ZeroTorque, 4.0, 0.01, integrator, FULL);
    assert_eq!(long.samples.len(), 9);
    for sample in &long.samples[1..8] {
        let short = run(&mut ZeroTorque, sample.time, sample.time, integrator, FULL);
        assert_close("sample", &values(&sample.state), &values(&short.end().state), tolerance::DENSE);
    }
}

/// Full and reduced coordinates give the same motion up to errors of fourth order; and the momentum
/// error of the latter is rounding for any step.
#[test]
fn full_and_reduced_coordinates_agree() {
    let differences = [0.05, 0.025].map(|step| {
        let [full, reduced] =
            [FULL, REDUCED].map(|mode| run(&mut ZeroTorque, 4.0, step, Integrator::RungeKutta4, mode));
        let drift = reduced.drift.momentum_drift;
        assert!(drift < tolerance::MOMENTUM_RECOVERED, "{drift:e} at {step} s");
        assert!(full.drift.momentum_drift > 1e4 * drift, "the drift of full coordinates is there to be seen");
        let mut worst: f64 = 0.0;
        for (a, b) in full.samples.iter().zip(&reduced.samples) {
            worst = worst.max(difference(&values(&a.state), &values(&b.state)));
        }
        worst
    });
    let order = (differences[0] / differences[1]).log2();
    assert!((order - 4.0).abs() < tolerance::ORDER_OF_DIFFERENCE, "{order} {differences:?}");
    let adaptive = [FULL, REDUCED].map(|mode| run(&mut ZeroTorque, 4.0, 0.05, ADAPTIVE, mode));
    let [full, reduced] = adaptive.each_ref().map(|phase| values(&phase.end().state));
    assert_close("full and reduced", &full, &reduced, tolerance::SAME_MOTION);
}

/// A base torque gives momentum, joint torques under limits none: both modes count it alike.
#[test]
fn both_coordinates_take_a_base_torque() {
    let joints = 6;
    let phases = [FULL, REDUCED].map(|coordinates| {
        let mut law = Stabilisation {
            joint_gain: &[0.5; 6],
            base_gain: 0.5,
            wheels: &[false; 6],
            base_torque_limit: Some(20.0),
            base_torque: None,
            mass_matrix: &mut vec![0.0; (3 + joints) * (3 + joints)],
            bias: &mut vec![0.0; 3 + joints],
        };
        run(&mut law, 4.0, 0.01, Integrator::RungeKutta4, coordinates)
    });
    let [full, reduced] = phases.each_ref().map(Phase::end);
    assert!(full.work.base_impulse.abs() > 1.0, "{} N m s", full.work.base_impulse);
    assert_close("motion", &values(&full.state), &values(&reduced.state), tolerance::CONTROLLED);
    let [of_full, of_reduced] =
        [full, reduced].map(|end| [end.work.base_impulse, end.work.base_work, end.work.joint_work]);
    assert_close("effort", &of_full, &of_reduced, tolerance::CONTROLLED);
    let drift = phases[1].drift.momentum_drift;
    assert!(drift < tolerance::MOMENTUM_RECOVERED, "{drift:e}");
}

/// Reduced coordinates are refused with free bodies; canonical variables integrate these too.
#[test]
fn free_bodies_are_integrated() {
    let model = model();
    let body = Body { mass: 3.0, inertia: 0.4, pose: [0.1, 2.0, 3.0], twist: [0.7, -0.2, 0.5] };
    let system = System { bodies: &[body], ..System::alone(&*model) };
    let run = |integrator, coordinates| {
        let integration = Integration { integrator, coordinates };
        let timing = Timing { duration: 1.0, step: 0.02, sample: 1.0, integration, kink: None };
        simulate(&system, &mut ZeroTorque, &tumbling(), &timing, &mut NoEvents, &mut || ())
    };
    let refused = run(Integrator::RungeKutta4, REDUCED).expect_err("a body is beside the robot").to_string();
    assert!(refused.contains("found 1 bodies") && refused.contains("`coordinates = \"full\"`"), "{refused}");
    let alone = self::run(&mut ZeroTorque, 1.0, 0.02, Integrator::GaussLegendre, FULL);
    for integrator in [Integrator::GaussLegendre, ADAPTIVE] {
        let phase = run(integrator, FULL).expect("a phase");
        let end = phase.end();
        assert_close("pose", &end.bodies[0].pose, &[0.8, 1.8, 3.5], tolerance::STRAIGHT);
        assert_close("twist", &end.bodies[0].twist, &body.twist, 0.0);
        assert_close("robot", &values(&end.state), &values(&alone.end().state), tolerance::SAME_MOTION_COARSE);
    }
}

/// A body captured by both arms, one contact rigid and one pinned, under joint control: constraints and momentum hold,
/// and all integrators agree.
#[test]
fn a_closed_loop_by_every_scheme() {
    let model = model();
    let start = RobotState { joint_rates: vec![0.0; 6], ..tumbling() };
    let [omega, vx, vy] = start.base_twist;
    let mut poses = [[0.0; 3]; 2];
    model.end_effector_poses(&start.base_pose, &start.joint_angles, &mut poses).expect("poses");
    // the whole moves as one rigid body
    let pose @ [_, x, y] = [0.4, 0.5 * (poses[0][1] + poses[1][1]), 0.5 * (poses[0][2] + poses[1][2])];
    let (rx, ry) = (x - start.base_pose[1], y - start.base_pose[2]);
    let body = Body { mass: 20.0, inertia: 3.0, pose, twist: [omega, vx - omega * ry, vy + omega * rx] };
    let constraint = |arm: usize, law| {
        let contact = Contact { arm, partner: ContactPartner::Body(0), offset: [0.0; 2], law };
        LoopConstraint::new(&contact, &poses[arm], &pose).expect("a constraint")
    };
    let constraints = [constraint(0, ContactLaw::Rigid), constraint(1, ContactLaw::Pin)];
    let system = System { bodies: &[body], constraints: &constraints, ..System::alone(&*model) };
    let expected: Vec<f64> = start.joint_angles.iter().map(|angle| angle + 0.2).collect();
    let run = |integrator, step| {
        let timing = Timing {
            duration: 1.0,
            step,
            sample: 1.0,
            integration: Integration { integrator, coordinates: FULL },
            kink: None,
        };
        let mut law = ProportionalDerivative {
            trajectory: ConstantSetpoint { angles: &expected },
            proportional_gain: &[5.0; 6],
            derivative_gain: &[3.0; 6],
        };
        simulate(&system, &mut law, &start, &timing, &mut NoEvents, &mut || ()).expect("a phase")
    };
    let reference = run(Integrator::RungeKutta4, 0.002);
    for (integrator, step) in [(Integrator::GaussLegendre, 0.02), (ADAPTIVE, 0.02), (Integrator::RungeKutta4, 0.004)] {
        let phase = run(integrator, step);
        let motion = |phase: &Phase| [&values(&phase.end().state)[..], &phase.end().bodies[0].pose].concat();
        assert_close(&format!("{integrator:?}"), &motion(&phase), &motion(&reference), tolerance::CLOSED_LOOP);
        let open = phase.constraint_errors[0];
        assert!(open < 1e-10 && phase.drift.momentum_drift < 1e-9, "{integrator:?}: {open:e} {:?}", phase.drift);
    }
    let moved = difference(&reference.end().state.joint_angles, &start.joint_angles);
    assert!(moved > 0.01, "{moved} rad");
}

/// Constraints that are open at the start are closed before the first adaptive step, not only after the last one: the
/// motion is that of the closed state.
#[test]
fn adaptive_steps_start_on_the_constraints() {
    let model = model();
    let start = tumbling();
    let mut poses = [[0.0; 3]; 2];
    model.end_effector_poses(&start.base_pose, &start.joint_angles, &mut poses).expect("poses");
    let pose = [0.4, poses[0][1] + 0.2, poses[0][2] - 0.1];
    let body = Body { mass: 20.0, inertia: 3.0, pose, twist: [0.0; 3] };
    let contact = Contact { arm: 0, partner: ContactPartner::Body(0), offset: [-0.2, 0.1], law: ContactLaw::Rigid };
    let constraints = [LoopConstraint::new(&contact, &poses[0], &pose).expect("a constraint")];
    // open by a millimetre, and at a rate, as the body is at rest
    let open = Body { pose: [0.4, pose[1] + 1e-3, pose[2]], ..body };
    let system = System { bodies: &[open], constraints: &constraints, ..System::alone(&*model) };
    let mut x = system.vector(&start.view()).expect("a vector");
    system.restore(&mut x).expect("a closed state");
    let closed = RobotState::from_view(&State::from_vector(&x, 6).expect("a state"));
    let bodies = system.bodies_at(&x).expect("bodies");
    let run = |system: &System<'_>, start: &RobotState| {
        // one step of the phase, many of the integrator
        let integration = Integration { integrator: ADAPTIVE, coordinates: FULL };
        let timing = Timing { duration: 1.0, step: 1.0, sample: 1.0, integration, kink: None };
        let phase = simulate(system, &mut ZeroTorque, start, &timing, &mut NoEvents, &mut || ()).expect("a phase");
        [&values(&phase.end().state)[..], &phase.end().bodies[0].pose].concat()
    };
    let expected = run(&System { bodies: &bodies, ..system }, &closed);
    assert_close("motion", &run(&system, &start), &expected, tolerance::CLOSED_LOOP);
}

/// A Gauss–Legendre step of three stages multiplies a solution of x' = z x by the Padé approximant (3, 3) of exp z: its
/// iteration stops at rounding, also where it contracts slowly.
#[test]
fn gauss_legendre_stages_are_solved_to_rounding() {
    for step in [0.1_f64, 0.5, 1.0, 1.5] {
        // x'' = -x: z = i h
        let square = step * step;
        let (even, odd) = (1.0 - square / 10.0, step * (0.5 - square / 120.0));
        // (even + i odd) / (even - i odd)
        let norm = even * even + odd * odd;
        let (cosine, sine) = ((even * even - odd * odd) / norm, 2.0 * even * odd / norm);
        let mut workspace = [0.0; 2 * GaussLegendre::<f64>::WORKSPACE];
        let mut x = [1.0, 0.0];
        let mut integrator = GaussLegendre::new(&mut workspace).expect("a workspace");
        let rate = |_: f64, x: &[f64], rate: &mut [f64]| {
            (rate[0], rate[1]) = (x[1], -x[0]);
            Ok(())
        };
        integrator.step(0.0, step, &mut x, rate).expect("a step");
        assert_close(&format!("step {step}"), &x, &[cosine, -sine], tolerance::SETTLED);
    }
}

/// A derivative that is known to 1e-9 alone: the stages cannot settle, and are not taken for settled.
#[test]
fn gauss_legendre_stages_that_do_not_settle_are_an_error() {
    let mut workspace = [0.0; GaussLegendre::<f64>::WORKSPACE];
    let mut integrator = GaussLegendre::new(&mut workspace).expect("a workspace");
    let mut noise = 1e-9;
    let rate = |_: f64, x: &[f64], rate: &mut [f64]| {
        noise = -noise;
        rate[0] = -x[0] + noise;
        Ok(())
    };
    let mut x = [1.0];
    let found = integrator.step(0.0, 0.5, &mut x, rate);
    assert!(matches!(found, Err(Error::NotConverged { change, .. }) if change > 1e-11), "{found:?}");
    assert_close("x", &x, &[1.0], 0.0);
    // as one that is not a number
    let nowhere = |_: f64, _: &[f64], rate: &mut [f64]| {
        rate[0] = f64::NAN;
        Ok(())
    };
    let found = integrator.step(0.0, 0.5, &mut x, nowhere);
    assert!(matches!(found, Err(Error::NotConverged { change, .. }) if change.is_nan()), "{found:?}");
}

/// Sampled torques: the adaptive integrator restarts at every sample, and agrees with short steps.
#[test]
fn sampled_torques_and_adaptive_steps() {
    let start = tumbling();
    let setpoint = ConstantSetpoint { angles: &start.joint_angles };
    let mut phases = [(Integrator::RungeKutta4, 0.002, 75), (ADAPTIVE, 0.05, 3), (Integrator::GaussLegendre, 0.05, 3)]
        .map(|(integrator, step, steps)| {
            let gains = ([2.0; 6], [1.5; 6]);
            let law =
                ProportionalDerivative { trajectory: setpoint, proportional_gain: &gains.0, derivative_gain: &gains.1 };
            let mut torques = [0.0; 6];
            // 0.15 s: the last sample is cut short by the end
            run(&mut SampledControl::new(law, steps, &mut torques), 1.0, step, integrator, FULL)
        });
    let reference = phases[0].samples.pop().expect("an end");
    for phase in &phases[1..] {
        assert_close("motion", &values(&phase.end().state), &values(&reference.state), tolerance::SAMPLED);
        assert_close("time", &[phase.end().time], &[1.0], 0.0);
    }
}

/// Any number of steps per sample: the end of a sample is a sum of steps, which rounding puts before or after the
/// exact time.
#[test]
fn samples_of_any_number_of_steps() {
    let start = tumbling();
    let setpoint = ConstantSetpoint { angles: &start.joint_angles };
    for steps in [1, 2, 3, 5, 7, 10, 20, 50, 100] {
        let mut ends = [Integrator::RungeKutta4, ADAPTIVE].map(|integrator| {
            let gains = ([2.0; 6], [1.5; 6]);
            let law =
                ProportionalDerivative { trajectory: setpoint, proportional_gain: &gains.0, derivative_gain: &gains.1 };
            let mut torques = [0.0; 6];
            run(&mut SampledControl::new(law, steps, &mut torques), 1.0, 0.005, integrator, FULL)
        });
        let [fixed, adaptive] = ends.each_mut().map(|phase| values(&phase.end().state));
        assert_close("motion", &adaptive, &fixed, tolerance::SAMPLED);
    }
}

/// Gauss–Legendre steps over 1,000 s of turning with both arms out, which swing about that: momenta to rounding, and an
/// energy error that does not grow, where that of Runge–Kutta steps grows with the time.
#[test]
fn a_thousand_seconds() {
    let start = RobotState {
        base_pose: [0.0; 3],
        joint_angles: vec![0.15, -0.1, 0.1, PI + 0.1, 0.15, -0.15],
        base_twist: [0.5, 0.02, -0.01],
        joint_rates: vec![0.0; 6],
    };
    let model = model();
    let run = |integrator, step| {
        let integration = Integration { integrator, coordinates: FULL };
        let timing = Timing { duration: 1000.0, step, sample: 1.0, integration, kink: None };
        simulate(&System::alone(&*model), &mut ZeroTorque, &start, &timing, &mut NoEvents, &mut || ()).expect("a phase")
    };
    // the largest energy error of each quarter
    let errors = |phase: &Phase| -> Vec<f64> {
        let energy = phase.samples[0].momentum.kinetic_energy;
        let error = |sample: &Sample| (sample.momentum.kinetic_energy - energy).abs() / energy;
        phase.samples.chunks(251).map(|part| part.iter().map(error).fold(0.0, f64::max)).collect()
    };
    let (gauss, runge_kutta) = (run(Integrator::GaussLegendre, 0.25), run(Integrator::RungeKutta4, 0.1));
    assert!(gauss.drift.momentum_drift < tolerance::MOMENTUM_KEPT, "{:?}", gauss.drift);
    assert!(runge_kutta.drift.momentum_drift > 1e4 * tolerance::MOMENTUM_KEPT, "{:?}", runge_kutta.drift);
    let [kept, strayed] = [&gauss, &runge_kutta].map(errors);
    assert!(kept[0] < 1e-8 && kept[3] < 1.3 * kept[0], "{kept:?}");
    assert!(strayed[3] > 3.0 * strayed[0], "{strayed:?}");
}
