//! Phases in sequence, what is at a limit, samples through a file, and identities of bodies.
#![allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    clippy::float_cmp,
    reason = "small whole numbers, and numbers that are copied"
)]

use super::bodies::{BodySums, bodies, inertia_about};
use super::body_tree::{BodyTree, LANES};
use super::conservation::{AccumulatedInput, ConservationAudit};
use super::event::{EndTime, EventState, Events, NoEvents};
use super::limits::{JointLimits, LimitViolation, LimitViolations};
use super::sample_file::SampleWriter;
use super::sample_list::{MOST_IN_MEMORY, SampleList};
use super::stepper::{Formulation, Integration, Integrator};
use super::system::{Body, System};
use super::{Phase, PhaseError, Sample, Saturation, Timing, simulate};
use crate::contact::{ContactPartner, LoopConstraint};
use crate::control::{ProportionalDerivative, SampledControl, TorqueLimiter, ZeroTorque};
use crate::dynamics::Momentum;
use crate::error::Error;
use crate::owned::{CloneModel, RobotState};
use crate::registry;
use crate::simulate::path::{PathInterval, PathPart};
use crate::state::ActuatorWork;
use crate::trajectory::ConstantSetpoint;
use planar_proof::{assert_close, layout};

fn robot() -> (Box<dyn CloneModel>, RobotState) {
    let state = RobotState {
        base_pose: [0.2, -0.4, 0.7],
        joint_angles: vec![0.4, -0.9],
        base_twist: [0.3, 0.2, -0.1],
        joint_rates: vec![-0.2, 0.5],
    };
    (registry::generic(&layout("single_arm_2r")), state)
}

fn phase(duration: f64) -> Phase {
    let (model, state) = robot();
    let timing = Timing { duration, step: 0.25, sample: 0.25, ..Timing::default() };
    simulate(&System::alone(&*model), &mut ZeroTorque, &state, &timing, &mut NoEvents, &mut || ()).expect("a phase")
}

/// Times, saturation and errors of two phases as one.
#[test]
fn a_phase_and_the_next() {
    let first = Phase {
        saturation: Saturation { joints: vec![0.5, 1.0], base: 0.25 },
        path_error: 1e-9,
        singularity_margin: Some(0.5),
        ..phase(2.0)
    };
    let work = ActuatorWork { joint_work: 1.0, base_work: 2.0, base_impulse: 3.0 };
    let next = Phase {
        saturation: Saturation { joints: vec![0.25, 3.0], base: 1.5 },
        path_error: 2e-9,
        singularity_margin: Some(0.25),
        event: Some((1, 0.75)),
        ..phase(1.0)
    };
    let with_work = |phase: &Phase, work| {
        let mut phase = phase.clone();
        phase.samples.last_mut().expect("samples").work = work;
        phase
    };
    let more = ActuatorWork { joint_work: 0.25, base_work: -0.5, base_impulse: 0.75 };
    let sum = ActuatorWork { joint_work: 1.25, base_work: 1.5, base_impulse: 3.75 };
    let both = with_work(&first, work).then(with_work(&next, more));
    assert_eq!(both.saturation, Saturation { joints: vec![0.75, 4.0], base: 1.75 });
    assert_eq!((both.duration, both.event, both.singularity_margin), (3.0, Some((1, 2.75)), Some(0.25)));
    assert_eq!(both.path_error.to_bits(), f64::to_bits(2e-9), "that of the later one has that of the earlier one");
    let times: Vec<f64> = both.samples.iter().map(|sample| sample.time).collect();
    let expected = first.samples.iter().map(|s| s.time).chain(next.samples.iter().map(|s| 2.0 + s.time));
    assert_eq!(times, expected.collect::<Vec<_>>());
    assert_eq!((both.end().work, &both.end().state), (sum, &next.end().state));
    assert_eq!(next.then(first).event, None);
}

/// The larger error of two phases, and the smaller margin, are those of both, whichever phase has it.
#[test]
fn the_worse_of_two_phases_is_kept() {
    let good = Phase { singularity_margin: Some(0.5), ..phase(1.0) };
    let numbers: [fn(&mut Phase) -> &mut f64; 6] = [
        |phase| &mut phase.drift.momentum_drift,
        |phase| &mut phase.drift.energy_error,
        |phase| &mut phase.drift.center_of_mass_drift,
        |phase| &mut phase.path_error,
        |phase| &mut phase.constraint_errors[0],
        |phase| &mut phase.constraint_errors[1],
    ];
    for (i, number) in numbers.into_iter().enumerate() {
        let mut bad = good.clone();
        *number(&mut bad) = 0.25;
        for mut both in [good.clone().then(bad.clone()), bad.clone().then(good.clone())] {
            assert_eq!(*number(&mut both), 0.25, "{i}");
        }
    }
    let bad = Phase { singularity_margin: Some(0.25), ..good.clone() };
    for both in [good.clone().then(bad.clone()), bad.then(good)] {
        assert_eq!(both.singularity_margin, Some(0.25));
    }
}

/// What the positions of a fast motion are rounded by counts as an error of its path.
#[test]
fn rounding_is_a_path_error() {
    let (model, mut state) = robot();
    (state.base_twist, state.joint_rates) = ([0.0, 3e6, -4e6], vec![0.0; 2]);
    let timing = Timing { duration: 2.0, step: 0.02, sample: 1.0, ..Timing::default() };
    let found = simulate(&System::alone(&*model), &mut ZeroTorque, &state, &timing, &mut NoEvents, &mut || ());
    // 1e7 m away, and not once more with every step
    let rounding = f64::EPSILON * 1e7;
    let error = found.expect("a phase").path_error;
    assert!((0.99 * rounding..1.01 * rounding).contains(&error), "{error} {rounding}");
}

/// At a limit is within it; of two equal violations the earlier is kept.
#[test]
fn at_a_limit() {
    let limits = JointLimits { angles: Some([-1.0, 2.0]), rate: Some(0.5), ..JointLimits::default() };
    for angle in [-1.0, 0.0, 2.0] {
        assert_eq!(limits.angle_beyond(angle), None);
    }
    assert_eq!([-1.01, 2.01].map(|angle| limits.angle_beyond(angle)), [Some(-1.0), Some(2.0)]);
    assert_eq!([-0.5, 0.5, -0.51].map(|rate| limits.rate_beyond(rate)), [None, None, Some(-0.5)]);
    let at = |time| LimitViolations {
        joint_angle: Some(LimitViolation { joint: "it".to_owned(), time, value: 2.5, limit: 2.0 }),
        joint_rate: None,
    };
    assert_eq!(at(0.25).then(at(0.5), 1.0), at(0.25));
}

/// Of a phase and the next the larger violation is kept, at its time since the start of the first.
#[test]
fn violations_of_a_phase_and_the_next() {
    let beyond =
        |time: f64, value: f64, limit: f64| Some(LimitViolation { joint: "it".to_owned(), time, value, limit });
    let with = |duration: f64, joint_angle, joint_rate| Phase {
        limit_violations: Some(LimitViolations { joint_angle, joint_rate }),
        ..phase(duration)
    };
    let larger = || with(1.0, beyond(0.75, 2.5, 2.0), beyond(0.25, -0.75, -0.5));
    for first in [with(2.0, beyond(0.5, 2.25, 2.0), None), with(2.0, None, beyond(0.5, 0.625, 0.5))] {
        let both = first.then(larger()).limit_violations.expect("limits");
        assert_eq!(both.joint_angle, beyond(2.75, 2.5, 2.0));
        assert_eq!(both.joint_rate, beyond(2.25, -0.75, -0.5));
    }
    let both = larger().then(with(2.0, beyond(0.5, 2.25, 2.0), None)).limit_violations;
    assert_eq!(both, larger().limit_violations);
}

/// What a phase that stopped says to do about it.
#[test]
fn hints_of_errors() {
    let stopped = |source| {
        let error = PhaseError { time: 0.5, source };
        (error.is_misuse(), error.to_string())
    };
    let (misuse, text) = stopped(Error::UnsupportedBodies { count: 2 });
    assert!(misuse && text.ends_with(", expected `coordinates = \"full\"`"), "{text}");
    let (misuse, text) = stopped(Error::Tolerance { tolerance: 1e-9, step: 1e-12 });
    assert!(!misuse && text.ends_with(" (a larger one may help)"), "{text}");
    let (misuse, text) = stopped(Error::Steps { step: 1e-9, needed: 1e10, most: 1e7 });
    assert!(
        !misuse && text.ends_with(" (smaller gains of a control, a shorter step, or a fixed integrator, may help)"),
        "{text}"
    );
    let (misuse, text) = stopped(Error::ContinuousMemory);
    assert!(misuse && text.ends_with("it needs a sample time"), "{text}");
    let (misuse, text) = stopped(Error::StateVector { found: 2 });
    assert!(!misuse && text.ends_with(" (a shorter step, or smaller gains of a control, may help)"), "{text}");
}

/// Reduced coordinates are refused with bodies beside the robot, constrained or not, and with constraints alone.
#[test]
fn reduced_coordinates_are_of_a_robot_alone() {
    let (model, state) = robot();
    let body = Body { mass: 1.0, inertia: 1.0, pose: [0.0; 3], twist: [0.0; 3] };
    let pin = LoopConstraint { arm: 0, partner: ContactPartner::Body(0), offset: [0.0; 2], yaw: None };
    let integration = Integration { integrator: Integrator::RungeKutta4, coordinates: Formulation::Reduced };
    let timing = Timing { duration: 1.0, step: 0.5, sample: 0.5, integration, kink: None };
    for (bodies, constraints) in [(&[body][..], &[][..]), (&[body], &[pin])] {
        let system = System { bodies, constraints, ..System::alone(&*model) };
        let found = simulate(&system, &mut ZeroTorque, &state, &timing, &mut NoEvents, &mut || ());
        let count = bodies.len() + constraints.len();
        assert_eq!(found.map(|_| ()).map_err(|e| e.source), Err(Error::UnsupportedBodies { count }));
    }
}

/// Actuators that are always at their limits are so until the event that ends the phase.
#[test]
fn saturation_up_to_an_event() {
    let (model, state) = robot();
    // by torques of either sign, held ones too
    for angles in [[9.0, -9.0], [-9.0, 9.0]] {
        let law = ProportionalDerivative {
            trajectory: ConstantSetpoint { angles: &angles },
            proportional_gain: &[10.0; 2],
            derivative_gain: &[0.0; 2],
        };
        let mut limited = TorqueLimiter { law, torque_limits: &[1e-3; 2], saturated: &mut [false; 2] };
        let timing = Timing { duration: 2.0, step: 0.25, sample: 0.25, ..Timing::default() };
        let system = System::alone(&*model);
        let ended = simulate(&system, &mut limited, &state, &timing, &mut EndTime(0.9), &mut || ()).expect("a phase");
        assert_close("saturated", &ended.saturation.joints, &[0.9; 2], 1e-12);
        let mut held = [0.0; 2];
        let mut sampled = SampledControl::new(&mut limited, 1, &mut held);
        let ended = simulate(&system, &mut sampled, &state, &timing, &mut EndTime(0.9), &mut || ()).expect("a phase");
        assert_close("saturated, held", &ended.saturation.joints, &[0.9; 2], 1e-12);
    }
}

/// Joints that are at their limits for a part of the time are so for as long whatever is sampled.
#[test]
fn saturation_between_samples() {
    let (model, state) = robot();
    let saturated = |sample: f64| {
        let law = ProportionalDerivative {
            trajectory: ConstantSetpoint { angles: &[0.4, -0.9] },
            proportional_gain: &[0.5; 2],
            derivative_gain: &[0.1; 2],
        };
        let mut limited = TorqueLimiter { law, torque_limits: &[0.05; 2], saturated: &mut [false; 2] };
        let timing = Timing { duration: 4.0, step: 0.0625, sample, ..Timing::default() };
        let system = System::alone(&*model);
        simulate(&system, &mut limited, &state, &timing, &mut NoEvents, &mut || ()).expect("a phase").saturation.joints
    };
    let every = saturated(0.0625);
    assert!(every.iter().any(|time| *time > 0.0 && *time < 4.0), "{every:?}");
    assert_eq!(saturated(2.0), every);
}

struct Three;

impl Events for Three {
    fn count(&self) -> usize {
        3
    }

    fn values(&mut self, _: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        values.fill(1.0);
        Ok(())
    }
}

/// Events without bounds have no crossings by bounds; the end of a phase is an event at its time.
#[test]
fn events_without_bounds() {
    let (model, state) = robot();
    let system = System::alone(&*model);
    let x = system.vector(&state.view()).expect("a vector");
    let step = PathInterval::between([0.0, 1.0], &x, &x).expect("a step");
    assert_eq!(Three.crossings(&step), Ok(vec![None; 3]));
    assert!(!Three.are_bounded() && NoEvents.count() == 0);
    let timing = Timing { duration: 2.0, step: 0.25, sample: 0.25, ..Timing::default() };
    let ended = simulate(&system, &mut ZeroTorque, &state, &timing, &mut EndTime(0.9), &mut || ()).expect("a phase");
    let (event, when) = ended.event.expect("the end");
    assert!(event == 0 && (when - 0.9).abs() < 1e-13 && ended.samples.len() == 5, "{when}");
}

/// A change of momentum and energy that the input explains is no drift; the same input with a sign changed is.
#[test]
fn an_external_impulse_is_no_drift() {
    let (model, before) = robot();
    let after = RobotState { base_twist: [-0.1, 0.5, 0.4], joint_rates: vec![0.3, 0.1], ..before.clone() };
    let [start, end] = [&before, &after].map(|state| model.momentum(&state.view()).expect("momentum"));
    let change = [0, 1].map(|i| end.linear_momentum[i] - start.linear_momentum[i]);
    let impulse = [end.angular_momentum - start.angular_momentum, change[0], change[1]];
    let work = end.kinetic_energy - start.kinetic_energy;
    let drift = |input: AccumulatedInput| {
        let mut audit = ConservationAudit::new(&*model, &before.view(), &[]).expect("a state");
        audit.record(&after.view(), &[], &input).expect("a state");
        audit.drift()
    };
    let exact = drift(AccumulatedInput { time: 0.0, work, impulse });
    assert!(exact.momentum_drift < 1e-15 && exact.energy_error < 1e-15, "{exact:?}");
    for place in 0..3 {
        let mut wrong = impulse;
        wrong[place] = -wrong[place];
        assert!(drift(AccumulatedInput { time: 0.0, work, impulse: wrong }).momentum_drift > 1e-3, "{place}");
    }
    assert!(drift(AccumulatedInput { time: 0.0, work: -work, impulse }).energy_error > 1e-3);
}

/// Bodies that turn together about a point have half the inertia about it as energy, per square of the rate.
#[test]
fn inertia_is_twice_the_energy_of_a_rotation() {
    let (model, state) = robot();
    let still = Body { mass: 3.0, inertia: 0.2, pose: [0.1, 2.0, -1.5], twist: [0.0; 3] };
    let all = bodies(&*model, &state.view(), &[still]).expect("bodies");
    for about in [[0.0; 2], [0.7, -2.0]] {
        let turned = |body: &Body| {
            let [_, x, y] = body.pose;
            Body { twist: [1.0, about[1] - y, x - about[0]], ..*body }.momentum().1
        };
        let energy: f64 = all.iter().map(turned).sum();
        assert_close("inertia", &[inertia_about(&all, about)], &[2.0 * energy], 1e-12 * energy);
    }
}

/// Several instants at once have the sums of each, where angles are far from 0, too: those of bodies where generated code has them.
#[test]
fn sums_of_several_instants() {
    let model = registry::generic(&layout("dual_arm_3r"));
    let beside = |i: f64| Body { mass: 4.0, inertia: 0.3, pose: [i, 1.5 - i, 2.0], twist: [0.2, 0.1 * i, -0.4] };
    for far in [0.0, 1e9] {
        let states = std::array::from_fn::<_, LANES, _>(|lane| {
            let i = lane as f64;
            let joint_angles = vec![0.3 * i, -1.2, 0.7 - 0.1 * i, far, 0.4, -0.2 * i];
            let joint_rates = vec![0.5, -0.3 * i, 0.2, 0.1 * i, -0.6, 0.4];
            RobotState { base_pose: [0.1 * i, 2.0, -1.0], joint_angles, base_twist: [0.1, 0.2 * i, -0.3], joint_rates }
        });
        let numbers = |lane: usize| {
            let (state, body) = (&states[lane], beside(lane as f64));
            [
                [&state.base_pose[..], &state.joint_angles, &body.pose].concat(),
                [&state.base_twist[..], &state.joint_rates, &body.twist].concat(),
            ]
        };
        let row = |half: usize, i: usize| std::array::from_fn(|lane| numbers(lane)[half][i]);
        let [positions, rates]: [Vec<_>; 2] = [0, 1].map(|half| (0..12).map(|i| row(half, i)).collect());
        let mut tree = BodyTree::new(&*model, &[beside(0.0)]).expect("a robot");
        let sums = tree.sums(&positions, &rates);
        for (lane, state) in states.iter().enumerate() {
            let all = bodies(&*model, &state.view(), &[beside(lane as f64)]).expect("bodies");
            let (one, found) = (BodySums::new(all.iter().copied()), sums.at(lane));
            let numbers = |sums: &BodySums| {
                let Momentum { linear_momentum: [px, py], angular_momentum, kinetic_energy } = sums.momentum();
                let ([x, y], [angular, linear]) = (sums.center_of_mass(), sums.momentum_sizes);
                [sums.mass, px, py, angular_momentum, kinetic_energy, x, y, angular, linear]
            };
            assert_close("sums", &numbers(&found), &numbers(&one), 1e-10);
            let [x, y] = one.center_of_mass();
            let extent = all.iter().map(|body| (body.pose[1] - x).hypot(body.pose[2] - y)).fold(0.0, f64::max);
            assert_close("extent", &[sums.extent[lane]], &[extent], 1e-12);
        }
    }
}

/// A moved phase is that of moved bodies: their positions, and their angular momentum about the origin.
#[test]
fn samples_about_another_origin() {
    let (model, _) = robot();
    let mut moved = phase(1.0);
    moved.translate([10.0, -20.0]);
    for (sample, before) in moved.samples.iter().zip(phase(1.0).samples) {
        let [yaw, x, y] = before.state.base_pose;
        assert_eq!(sample.state.base_pose, [yaw, x + 10.0, y - 20.0]);
        let bodies = bodies(&*model, &sample.state.view(), &[]).expect("bodies");
        let right = BodySums::new(bodies.into_iter()).momentum();
        assert!(right.linear_momentum.iter().all(|momentum| momentum.abs() > 1.0));
        assert_close("l", &[sample.momentum.angular_momentum], &[right.angular_momentum], 1e-10);
        assert_close("p", &sample.momentum.linear_momentum, &right.linear_momentum, 1e-12);
    }
}

fn numbered(i: u32) -> Sample {
    let x = f64::from(i);
    let body = Body { mass: 1.0 + x, inertia: 2.0, pose: [x, 3.0, 4.0], twist: [5.0, -x, 6.0] };
    let base_torque = [None, Some(0.0), Some(0.5 + x), Some(-x)][i as usize % 4];
    let mut sample = phase(0.25).samples[0].clone();
    (sample.time, sample.base_torque, sample.bodies) = (x, base_torque, vec![body]);
    sample.joint_torques = vec![x, -x];
    sample
}

/// Samples and targets come back from a file bit by bit, also those of more than its buffer.
#[test]
fn samples_through_a_file() {
    let samples: Vec<_> = (0..8).map(numbered).collect();
    let target = |i: usize| vec![Body { pose: [i as f64, 1.0, 2.0], ..samples[0].bodies[0] }];
    let mut writer = SampleWriter::new(&samples[0], &target(0));
    let count = 5000;
    (0..count).for_each(|i| writer.push(&samples[i % 8], &target(i)));
    let file = writer.finish();
    assert_eq!(file.len(), count);
    for (i, read) in file.samples().enumerate() {
        assert_eq!(read.expect("a sample"), (samples[i % 8].clone(), target(i)));
    }
    assert_eq!(file.samples().count(), count);
}

/// Of a long phase every second, fourth … sample is in memory, with the last, and all are in the file.
#[test]
fn samples_in_memory_are_evenly_spaced() {
    let like = numbered(0);
    for count in [MOST_IN_MEMORY, MOST_IN_MEMORY + 1, 3 * MOST_IN_MEMORY + 2] {
        let mut list = SampleList::default();
        (0..count).for_each(|i| list.push(Sample { time: i as f64, ..like.clone() }));
        let (in_memory, file) = list.end();
        let spacing = (count - 1).div_ceil(MOST_IN_MEMORY).next_power_of_two();
        let spacing = if count == MOST_IN_MEMORY { 1 } else { spacing.max(2) };
        let mut expected: Vec<usize> = (0..count).step_by(spacing).collect();
        expected.extend((expected.last() != Some(&(count - 1))).then_some(count - 1));
        assert!(in_memory.iter().map(|sample| sample.time as usize).eq(expected), "{count}: {}", in_memory.len());
        assert_eq!(file.map(|file| file.len()), (spacing > 1).then_some(count));
    }
}

/// The latest sample is discarded where it is at a time or later, in memory and in the file; the first never is.
#[test]
fn the_latest_sample_can_be_discarded() {
    let like = numbered(0);
    for count in [2, MOST_IN_MEMORY + 1, MOST_IN_MEMORY + 2] {
        let last = (count - 1) as f64;
        for (from, expected) in [(last, count - 1), (last + 0.5, count)] {
            let mut samples = SampleList::default();
            (0..count).for_each(|i| samples.push(Sample { time: i as f64, ..like.clone() }));
            samples.discard_from(from);
            let (in_memory, file) = samples.end();
            let end = (expected - 1) as f64;
            assert_eq!(in_memory.last().map(|sample| sample.time), Some(end), "{count} {from}");
            assert_eq!(file.map_or(in_memory.len(), |file| file.len()), expected, "{count} {from}");
        }
    }
    let mut list = SampleList::default();
    list.push(like);
    list.discard_from(0.0);
    assert_eq!(list.end().0.len(), 1);
}

/// The path within long adaptive steps is the motion, from knot to knot: that of the same tolerance at many samples.
#[test]
fn the_path_within_long_steps_is_the_motion() {
    let (model, state) = robot();
    let run = |step: f64, until: f64| {
        let integration =
            Integration { integrator: Integrator::Adaptive { tolerance: 1e-12 }, ..Integration::default() };
        let timing = Timing { duration: 8.0, step, sample: step, integration, kink: None };
        simulate(&System::alone(&*model), &mut ZeroTorque, &state, &timing, &mut EndTime(until), &mut || ())
            .expect("a phase")
    };
    let samples = run(0.03125, 9.0).samples;
    for (step, until) in [(8.0, 9.0), (2.0, 9.0), (8.0, 5.3), (2.0, 5.3)] {
        let mut last = 0.0;
        let visited = run(step, until).path.try_for_each(|interval| {
            let [from, to] = interval.span;
            assert!(from == last && to > from, "{step}: {from} to {to} after {last}");
            last = to;
            for sample in samples.iter().filter(|sample| (from..=to).contains(&sample.time)) {
                let (mut positions, mut rates) = ([0.0; 5], [0.0; 5]);
                interval.at(sample.time, &mut positions, &mut rates);
                let expected = [&sample.state.base_pose[..], &sample.state.joint_angles].concat();
                assert_close("path", &positions, &expected, 3e-8);
            }
            std::io::Result::Ok(())
        });
        visited.expect("a path");
        assert!((last - until.min(8.0)).abs() < 1e-12, "{last}");
    }
}

/// Pushes the joint for 0.3 s, and then brakes it; its margin is the smaller the faster that turns.
struct Pushed {
    margin: Option<f64>,
    least: f64,
}

impl crate::control::Control<f64> for Pushed {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &crate::dynamics::AnyModel<f64>,
        state: &crate::state::State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.fill(0.0);
        torques[1] = if time < 0.3 { 2.0 } else { -2.0 };
        let margin = 1.0 / (1.0 + state.joint_rates[1].abs());
        (self.margin, self.least) = (Some(margin), self.least.min(margin));
        Ok(())
    }

    fn singularity_margin(&self) -> Option<f64> {
        self.margin
    }
}

/// Adaptive steps across the jump of the torque are tried, with rates that the motion never has.
#[test]
fn margins_are_of_the_motion_alone() {
    let (model, mut state) = robot();
    state.joint_rates = vec![0.0; 2];
    let integration = Integration { integrator: Integrator::Adaptive { tolerance: 1e-9 }, ..Integration::default() };
    let timing = Timing { duration: 0.5, step: 0.5, sample: 0.5, integration, kink: None };
    let system = System::alone(&*model);
    let mut law = Pushed { margin: None, least: 1.0 };
    let found = simulate(&system, &mut law, &state, &timing, &mut NoEvents, &mut || ()).expect("a phase");
    let fine = Timing { duration: 0.5, step: 1e-3, sample: 1e-3, integration, kink: None };
    let fine = simulate(&system, &mut Pushed { margin: None, least: 1.0 }, &state, &fine, &mut NoEvents, &mut || ());
    let fine = fine.expect("a phase");
    let largest = fine.samples.iter().map(|sample| sample.state.joint_rates[1].abs()).fold(0.0, f64::max);
    let (margin, expected) = (found.singularity_margin.expect("a margin"), 1.0 / (1.0 + largest));
    assert!((margin - expected).abs() < 1e-3 * expected, "{margin} {expected}");
    assert!(law.least < 0.9 * margin, "{} {margin}: not tried", law.least);
}

/// Torques of nothing, and when they were asked for.
struct Asked(Vec<f64>);

impl crate::control::Control<f64> for Asked {
    fn joint_torques(
        &mut self,
        time: f64,
        _: &crate::dynamics::AnyModel<f64>,
        _: &crate::state::State<'_, f64>,
        torques: &mut [f64],
    ) -> Result<(), Error> {
        torques.fill(0.0);
        self.0.push(time);
        Ok(())
    }
}

/// A phase that is no whole number of steps ends with a shorter one: samples of a law keep their interval.
#[test]
fn a_law_is_sampled_at_one_interval() {
    let (model, state) = robot();
    let system = System::alone(&*model);
    for (integrator, duration, expected) in [
        (Integrator::RungeKutta4, 1.0, &[0.0, 0.3, 0.6, 0.9][..]),
        (Integrator::Adaptive { tolerance: 1e-9 }, 1.0, &[0.0, 0.3, 0.6, 0.9]),
        (Integrator::GaussLegendre, 0.6, &[0.0, 0.3]),
        (Integrator::GaussLegendre, 0.1, &[0.0]),
    ] {
        let (mut law, mut held) = (Asked(Vec::new()), [0.0; 2]);
        let integration = Integration { integrator, ..Integration::default() };
        let timing = Timing { duration, step: 0.15, sample: 0.15, integration, kink: None };
        let mut sampled = SampledControl::new(&mut law, 2, &mut held);
        let phase = simulate(&system, &mut sampled, &state, &timing, &mut NoEvents, &mut || ()).expect("a phase");
        assert_eq!(phase.samples.len(), timing.steps() as usize + 1);
        law.0.sort_by(f64::total_cmp);
        law.0.dedup();
        assert_close("times", &law.0, expected, 1e-12);
    }
}

/// Samples are at the multiples of the interval that are nearest to whole steps: 0.3 s are three steps of 0.1 s, although their
/// quotient is less than 3.
#[test]
fn samples_are_the_nearest_number_of_steps_apart() {
    let (model, state) = robot();
    let system = System::alone(&*model);
    for (sample, expected) in [
        (0.3, &[0.0, 0.3, 0.6, 0.9, 1.0][..]),
        (0.26, &[0.0, 0.3, 0.6, 0.9, 1.0]),
        (0.54, &[0.0, 0.5, 1.0]),
        (9.0, &[0.0, 1.0]),
    ] {
        let timing = Timing { duration: 1.0, step: 0.1, sample, ..Timing::default() };
        let phase = simulate(&system, &mut ZeroTorque, &state, &timing, &mut NoEvents, &mut || ()).expect("a phase");
        let times: Vec<f64> = phase.samples.iter().map(|sample| sample.time).collect();
        assert_close(&format!("every {sample} s"), &times, expected, 1e-12);
    }
}

/// A step is divided at a kink within it, and not where that is at one of its ends but for rounding.
#[test]
fn a_kink_divides_the_step_that_it_is_within() {
    let (model, state) = robot();
    let at_rest = RobotState { base_twist: [0.0; 3], joint_rates: vec![0.0; 2], ..state };
    for step in [1e-3, 0.5, 16.0] {
        for (before, part, is_divided) in [
            (0.0, 5e-7, false),
            (0.0, 2e-6, true),
            (0.0, 0.5, true),
            (2.0, 5e-7, false),
            (2.0, 2e-6, true),
            (3.0, 1.0 - 2e-6, true),
            (3.0, 1.0 - 5e-7, false),
        ] {
            let (mut law, kink) = (Asked(Vec::new()), (before + part) * step);
            let timing = Timing { duration: 4.0 * step, step, sample: step, kink: Some(kink), ..Timing::default() };
            simulate(&System::alone(&*model), &mut law, &at_rest, &timing, &mut NoEvents, &mut || ()).expect("a phase");
            assert_eq!(law.0.contains(&kink), is_divided, "{step} {before} {part}");
        }
    }
}
