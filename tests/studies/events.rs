//! Events end a phase where a value decreases to zero: at the exact time for every integrator, also for short events.

use crate::scenario;
use planar_capture::control::{Control, ProportionalDerivative, SampledControl, ZeroTorque};
use planar_capture::error::Error;
use planar_capture::owned::{CloneModel, RobotState};
use planar_capture::registry;
use planar_capture::simulate::event::{EventState, Events, NoEvents};
use planar_capture::simulate::stepper::{Formulation, Integration, Integrator};
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Phase, Timing, simulate};
use planar_capture::trajectory::ConstantSetpoint;
use planar_proof::{assert_close, difference, tolerance};

const ADAPTIVE: Integrator = Integrator::Adaptive { tolerance: 1e-12 };

/// Every integrator, with the bound on the error of the event time, s.
const ALL: [(Integrator, Formulation, f64); 7] = [
    (Integrator::RungeKutta4, Formulation::Full, 1e-9),
    (Integrator::RungeKutta4, Formulation::Reduced, 1e-9),
    (Integrator::SemiImplicitEuler, Formulation::Full, 2e-2),
    (Integrator::SemiImplicitEuler, Formulation::Reduced, 2e-2),
    (Integrator::GaussLegendre, Formulation::Full, 1e-11),
    (ADAPTIVE, Formulation::Full, 1e-11),
    (ADAPTIVE, Formulation::Reduced, 1e-11),
];

fn model() -> Box<dyn CloneModel> {
    registry::generated(&scenario("redysim_single_arm_3r").layout).expect("the robot of ReDySim")
}

/// Distance of an end effector from a circle.
struct Circle {
    centre: [f64; 2],
    radius: f64,
}

impl Circle {
    fn value(&self, [_, x, y]: [f64; 3]) -> f64 {
        (x - self.centre[0]).hypot(y - self.centre[1]) - self.radius
    }
}

impl Events for Circle {
    fn count(&self) -> usize {
        1
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        let mut poses = [[0.0; 3]];
        now.system.model.end_effector_poses(&now.state.base_pose, now.state.joint_angles, &mut poses)?;
        values[0] = self.value(poses[0]);
        Ok(())
    }
}

/// Values that are functions of time alone.
struct Times<'a>(&'a [fn(f64) -> f64]);

impl Events for Times<'_> {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        for (value, function) in values.iter_mut().zip(self.0) {
            *value = function(now.time);
        }
        Ok(())
    }
}

fn drifting() -> RobotState {
    RobotState {
        base_pose: [0.2, 0.0, 0.0],
        joint_angles: vec![0.4, -0.9, 0.5],
        base_twist: [0.0, 0.3, 0.1],
        joint_rates: vec![0.0; 3],
    }
}

fn tumbling() -> RobotState {
    RobotState { base_twist: [0.1, 0.3, 0.1], joint_rates: vec![0.5, 0.7, -0.9], ..drifting() }
}

fn run(
    start: &RobotState,
    duration: f64,
    step: f64,
    (integrator, coordinates): (Integrator, Formulation),
    law: &mut dyn Control<f64>,
    events: &mut dyn Events,
) -> Phase {
    let (model, integration) = (model(), Integration { integrator, coordinates });
    let timing = Timing { duration, step, sample: 0.25, integration, kink: None };
    simulate(&System::alone(&*model), law, start, &timing, events, &mut || ()).expect("a phase")
}

fn end_effector(motion: &RobotState) -> [f64; 3] {
    let mut poses = [[0.0; 3]];
    model().end_effector_poses(&motion.base_pose, &motion.joint_angles, &mut poses).expect("poses");
    poses[0]
}

/// A robot at constant joint angles: its end effector moves on a straight line and meets the circle at the root of a
/// quadratic equation.
#[test]
fn a_straight_path_meets_a_circle() {
    let start = drifting();
    let [_, x, y] = end_effector(&start);
    let circle = || Circle { centre: [x + 1.0, y + 0.2], radius: 0.5 };
    // |d − v t|² = r²
    let (dd, dv, vv): (f64, f64, f64) = (1.04 - 0.25, 0.3 + 0.02, 0.1);
    let expected = (dv - (dv * dv - dd * vv).sqrt()) / vv;
    for (integrator, coordinates, _) in ALL {
        // the same from steps of any length
        for step in [0.005, 0.3] {
            let phase = run(&start, 10.0, step, (integrator, coordinates), &mut ZeroTorque, &mut circle());
            let (event, when) = phase.event.expect("the circle is met");
            assert_eq!((event, phase.duration, phase.end().time), (0, when, when));
            assert!((when - expected).abs() < tolerance::EVENT_TIME, "{integrator:?}: {when}, not {expected}");
            assert!(circle().value(end_effector(&phase.end().state)).abs() < tolerance::EVENT_TIME);
            let times: Vec<f64> = phase.samples.iter().map(|sample| sample.time).collect();
            assert!(times.is_sorted_by(|a, b| a < b), "{times:?}");
        }
    }
}

/// A tumbling robot: the time is that of a root found from phases of other lengths, without events.
#[test]
fn a_tumbling_robot_meets_a_circle() {
    let (start, best) = (tumbling(), (Integrator::Adaptive { tolerance: 1e-13 }, Formulation::Full));
    let [_, x, y] = end_effector(&run(&start, 3.0, 3.0, best, &mut ZeroTorque, &mut NoEvents).end().state);
    let circle = || Circle { centre: [x, y], radius: 0.2 };
    let value = |duration: f64| {
        circle().value(end_effector(&run(&start, duration, duration, best, &mut ZeroTorque, &mut NoEvents).end().state))
    };
    let (mut early, mut late) = (0.1, 0.2);
    while value(late) > 0.0 {
        (early, late) = (late, late + 0.1);
        assert!(late < 10.0, "the circle is never met");
    }
    for _ in 0..45 {
        let middle = f64::midpoint(early, late);
        if value(middle) > 0.0 { early = middle } else { late = middle }
    }
    for (integrator, coordinates, bound) in ALL {
        let phase = run(&start, 10.0, 0.005, (integrator, coordinates), &mut ZeroTorque, &mut circle());
        let (_, when) = phase.event.expect("the circle is met");
        assert!((when - late).abs() < bound, "{integrator:?} {coordinates:?}: {when}, not {late}: {:e}", when - late);
        assert!(circle().value(end_effector(&phase.end().state)).abs() < tolerance::EVENT_TIME);
    }
}

/// The end effector passes at 0.5 m: a circle a nanometre smaller is not met, one a nanometre larger is, for a fraction
/// of a step.
#[test]
fn grazing() {
    let start = drifting();
    let [_, x, y] = end_effector(&start);
    let (along, across) = ([0.3 / 0.1_f64.sqrt(), 0.1 / 0.1_f64.sqrt()], [-0.1 / 0.1_f64.sqrt(), 0.3 / 0.1_f64.sqrt()]);
    let centre = [x + along[0] + 0.5 * across[0], y + along[1] + 0.5 * across[1]];
    let closest = 1.0 / 0.1_f64.sqrt();
    for (integrator, coordinates, _) in ALL {
        let event_run = |radius| {
            run(&start, 6.0, 0.005, (integrator, coordinates), &mut ZeroTorque, &mut Circle { centre, radius })
        };
        assert_eq!(event_run(0.5 - 1e-9).event, None, "{integrator:?}");
        let (_, when) = event_run(0.5 + 1e-9).event.expect("it is touched");
        let early = (1e-9_f64 * (1.0 + 1e-9)).sqrt() / 0.1_f64.sqrt();
        assert!((when - (closest - early)).abs() < tolerance::GRAZING, "{integrator:?}: {when}");
    }
}

/// A value below zero at the start is armed when it rises; the first of several events ends the phase.
#[test]
fn arming_and_the_first_of_several() {
    let event_run = |functions: &[fn(f64) -> f64]| {
        run(
            &drifting(),
            1.0,
            0.01,
            (Integrator::RungeKutta4, Formulation::Full),
            &mut ZeroTorque,
            &mut Times(functions),
        )
        .event
    };
    assert_eq!(event_run(&[|_| -1.0, |_| 0.0, |t| t - 2.0, |_| 1.0]), None);
    let (event, when) = event_run(&[|t| (t - 0.1003) * (0.3507 - t)]).expect("it rises and falls");
    assert!(event == 0 && (when - 0.3507).abs() < tolerance::EVENT_TIME, "{when}");
    let (event, when) = event_run(&[|t| 0.7 - t, |t| 0.2034 + 1e-9 - t, |t| 0.2034 - t]).expect("three fall");
    assert!(event == 2 && (when - 0.2034).abs() < tolerance::EVENT_TIME, "{event} {when}");
    // in the first step, and in the last instant
    let (_, when) = event_run(&[|t| 1e-5 - t]).expect("it falls at once");
    assert!((when - 1e-5).abs() < tolerance::EVENT_TIME, "{when}");
    assert_eq!(event_run(&[|t| 1.0 - t]), Some((0, 1.0)));
}

/// A value that is below zero for a fifth of a microsecond within a step of 0.1 s is met: the search for its minimum goes
/// on to half the digits of the time.
#[test]
fn a_short_dip_within_a_step() {
    const HALF: f64 = 1e-7;
    for middle in [0.503_3, 0.547_1, 0.598_8] {
        let dip = Dip { middle, half: HALF };
        for (integrator, coordinates, _) in ALL {
            let phase = run(&drifting(), 1.0, 0.1, (integrator, coordinates), &mut ZeroTorque, &mut { dip });
            let (_, when) = phase.event.expect("the dip is met");
            assert!((when - (middle - HALF)).abs() < tolerance::EVENT_TIME, "{integrator:?}: {when}");
        }
    }
}

/// A parabola of time that is below zero for twice the half width.
#[derive(Clone, Copy)]
struct Dip {
    middle: f64,
    half: f64,
}

impl Events for Dip {
    fn count(&self) -> usize {
        1
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        values[0] = (now.time - self.middle).powi(2) - self.half * self.half;
        Ok(())
    }
}

/// Up to the event the phase equals one without events, with sampled torques too, and it ends there.
#[test]
fn a_phase_with_an_event_is_a_part_of_one_without() {
    let angles = [0.0; 3];
    for (integrator, coordinates, _) in ALL {
        let event_run = |events: &mut dyn Events, duration: f64, step: f64| {
            let setpoint = ConstantSetpoint { angles: &angles };
            let gains = [3.0; 3];
            let law =
                ProportionalDerivative { trajectory: setpoint, proportional_gain: &gains, derivative_gain: &gains };
            let mut torques = [0.0; 3];
            let mut law = SampledControl::new(law, 5, &mut torques);
            run(&tumbling(), duration, step, (integrator, coordinates), &mut law, events)
        };
        let whole = event_run(&mut NoEvents, 2.0, 0.01);
        let part = event_run(&mut Times(&[|t| 1.3 - t]), 2.0, 0.01);
        assert_eq!((whole.event, part.samples.len()), (None, 7), "0, 0.25, … 1.25, 1.3");
        for (a, b) in whole.samples.iter().zip(&part.samples[..6]) {
            assert_eq!(a, b, "{integrator:?}");
        }
        let alone = event_run(&mut NoEvents, 1.3, 0.01);
        let [found, expected] = [&part, &alone].map(|phase| phase.end().state.clone());
        let error = difference(&found.joint_rates, &expected.joint_rates);
        assert!(error < tolerance::SAME_STEPS, "{integrator:?}: {error:e}");
        assert_close("pose", &found.base_pose, &expected.base_pose, tolerance::SAME_STEPS);
        assert_close("torques", &part.end().joint_torques, &alone.end().joint_torques, tolerance::SAME_STEPS);
    }
}

/// A sample that is at the time of the event but for rounding is not kept beside that of the event; the first of a phase is.
#[test]
fn a_sample_is_not_kept_beside_an_event_at_its_time() {
    let times_of = |event: fn(f64) -> f64, by: (Integrator, Formulation)| {
        let phase = run(&tumbling(), 2.0, 0.25, by, &mut ZeroTorque, &mut Times(&[event]));
        phase.samples.iter().map(|sample| sample.time).collect::<Vec<_>>()
    };
    for (integrator, coordinates, _) in ALL {
        let by = (integrator, coordinates);
        for event in [|t| 0.5 + 1e-13 - t, |t| 0.5 + 4e-16 - t] {
            let times = times_of(event, by);
            assert!(times.len() == 3 && times[2] - 0.5 > 0.0 && times[2] - 0.5 < 3e-13, "{by:?}: {times:?}");
        }
        // another instant
        let times = times_of(|t| 0.5 + 1e-11 - t, by);
        assert!(times.len() == 4 && times[2].to_bits() == 0.5f64.to_bits(), "{by:?}: {times:?}");
        // from where the next phase may start, after an impact
        let times = times_of(|t| 1e-13 - t, by);
        assert!(times.len() == 2 && times[0].to_bits() == 0, "{by:?}: {times:?}");
    }
}
