//! All that is measured.

use crate::Problem;
use crate::batch::Arrays;
use crate::casadi::{self, Results};
use crate::clock::Clock;
use crate::derivatives::{self, derivatives};
use crate::limit;
use crate::runge_kutta::{self, GAINS, Motion, Vector, parts, torques};
use crate::states::{State, states};
use crate::studies;
use planar_build::prove::generic::Generic;
use planar_capture::control::{Control, ProportionalDerivative};
use planar_capture::dynamics::{AnyModel, ForwardDynamics as _, Impact as _, ReducedDynamics as _};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::{
    ForwardDynamics, FullImpact, Model as Robot, ReducedDynamics, ReducedImpact,
};
use planar_capture::integrate::RungeKutta4;
use planar_capture::owned::RobotState;
use planar_capture::scalar::Scalar;
use planar_capture::simulate::conservation::{AccumulatedInput, ConservationAudit};
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Timing, simulate};
use planar_capture::state::{Forces, State as View, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::ConstantSetpoint;
use planar_layout::layout::Layout;
use std::hint::black_box;
use std::path::Path;
use wide::{f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

pub use crate::limit::operations;

/// States that stay in the first-level cache, and that do not.
const FEW: usize = 64;
const MANY: usize = 16_384;
/// Largest difference from CasADi's results, relative to 1 or the value.
const AGREEMENT: f64 = 1e-11;

/// Joint angles at the start of a motion, rad.
pub const ANGLES: [f64; 6] = [0.3, -0.4, 0.5, -0.3, 0.4, -0.5];
/// Step of a motion, s.
pub const STEP: f64 = 1e-3;
/// Number of steps until the robot is at rest.
const STEPS: u32 = 20_000;
/// Numbers of a vector of the library's.
const LENGTH: usize = vector_length(6);

/// The paper's robot.
///
/// # Errors
/// Where its layout cannot be read.
pub fn layout() -> Result<Layout, Problem> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../codegen/layouts/dual_arm_3r.toml");
    Layout::read(&path).map_err(|report| report.to_string().into())
}

/// Compares with CasADi, and times all.
///
/// # Errors
/// Where generated code and CasADi's differ.
pub fn all(clock: &mut impl Clock) -> Result<(), Problem> {
    // whose numbers the compiler does not know
    let (generic, model) = (Generic::new(&layout()?), black_box(Robot::<f64>::default()));
    let (few, many) = (states(FEW), states(MANY));
    compare(&model, &few)?;

    let mut results = Results::default();
    clock.each("C, forward dynamics", 1, &few, |s| casadi::forward_dynamics(s, &mut results));
    clock.each("C, derivatives", 1, &few, |s| casadi::derivatives(s, &mut results));
    clock.each("C, reduced dynamics", 1, &few, |s| casadi::reduced_dynamics(s, &mut results));
    clock.each("C, reduced impact", 1, &few, |s| casadi::reduced_impact(s, &mut results));
    clock.each("C, full impact", 1, &few, |s| casadi::full_impact(s, &mut results));
    clock.each("C, forward dynamics, many states", 1, &many, |s| casadi::forward_dynamics(s, &mut results));
    clock.each("C, reduced dynamics, many states", 1, &many, |s| casadi::reduced_dynamics(s, &mut results));
    clock.each("C, reduced impact, many states", 1, &many, |s| casadi::reduced_impact(s, &mut results));
    clock.each("C, full impact, many states", 1, &many, |s| casadi::full_impact(s, &mut results));
    black_box(&results);
    steps(clock, "C, step", &ByC);

    let forward = |s: &State| consume(forward_dynamics(&model, s));
    clock.each("f64, forward dynamics", 1, &few, forward);
    clock.each("f64, forward dynamics, many states", 1, &many, forward);
    let with_derivatives = black_box(derivatives::Model::default());
    clock.each("f64, derivatives", 1, &few, |s| consume(derivatives(&with_derivatives, s)));
    clock.each("f64, reduced dynamics", 1, &few, |s| consume(reduced_dynamics(&model, s)));
    clock.each("f64, reduced impact", 1, &few, |s| consume(reduced_impact(&model, s)));
    clock.each("f64, full impact", 1, &few, |s| consume(full_impact(&model, s)));
    steps(clock, "f64, step", &ByModel(&model));
    steps(clock, "f64, called step", &ByCalls(&model));
    let (mut law, mut torques) = (LAW, [0.0; 6]);
    library_steps(clock, "library, step", [0.0; LENGTH], |integrator, x| {
        integrator.robot_step(&model, &mut law, 0.0, STEP, x, &mut torques)
    });
    let (any, mut law): (&AnyModel<f64>, _) = (black_box(&model), LAW);
    let law: &mut dyn Control<f64> = black_box(&mut law);
    let [x, mut torques] = black_box([LENGTH, 6]).map(|length| vec![0.0; length]);
    library_steps(clock, "library, step of any robot", x, |integrator, x| {
        integrator.robot_step(any, law, 0.0, STEP, x, &mut torques)
    });
    simulated_steps(clock, &model);
    audited_states(clock, &model, &few)?;
    studies::all(clock)?;

    forward_dynamics_in_lanes(clock, "f32", &few, |[value]: [f64; 1]| single(value));
    forward_dynamics_in_lanes(clock, "f32x4", &few, |values| f32x4::from(values.map(single)));
    forward_dynamics_in_lanes(clock, "f32x8", &few, |values| f32x8::from(values.map(single)));
    forward_dynamics_in_lanes(clock, "f32x16", &few, |values| f32x16::from(values.map(single)));
    forward_dynamics_in_lanes(clock, "f64x2", &few, f64x2::from);
    forward_dynamics_in_lanes(clock, "f64x4", &few, f64x4::from);
    forward_dynamics_in_lanes(clock, "f64x8", &few, f64x8::from);
    others_in_lanes(clock, "f64x8", &few, f64x8::from);

    batches(clock, "", &model, &few)?;
    batches(clock, ", many states", &model, &many)?;

    clock.each("generic, forward dynamics", 1, &few, |s| consume(of_generic(&generic, s)));
    clock.each("generic, reduced dynamics", 1, &few, |s| consume(reduced_of_generic(&generic, s)));
    clock.each("generic, full impact", 1, &few, |s| consume(impact_of_generic(&generic, s)));
    limit::operation(clock);
    Ok(())
}

/// Keeps the compiler from leaving out what has no use.
pub fn consume<T>(result: T) {
    let _ = black_box(result);
}

/// Runge–Kutta steps of a motion under control until the robot is at rest, by hand.
fn steps(clock: &mut impl Clock, name: &str, motion: &impl Motion) {
    let mut start = [0.0; 18];
    start[3..9].copy_from_slice(&ANGLES);
    clock.each(name, STEPS, &[start], |start| {
        let mut x = *start;
        (0..STEPS).for_each(|_| runge_kutta::step(motion, &mut x, STEP));
        consume(x);
    });
}

/// A law that holds the joints at 0.
const LAW: ProportionalDerivative<'static, f64, ConstantSetpoint<'static, f64>> = ProportionalDerivative {
    trajectory: ConstantSetpoint { angles: &[0.0; 6] },
    proportional_gain: &[GAINS[0]; 6],
    derivative_gain: &[GAINS[1]; 6],
};

/// As [`steps`], by integrator, law and equation of the library, with a vector of the caller's: of known length where it is an array.
fn library_steps<X: AsMut<[f64]> + Clone>(
    clock: &mut impl Clock,
    name: &str,
    mut start: X,
    mut step: impl FnMut(&mut RungeKutta4<'_, f64>, &mut [f64]) -> Result<(), Error>,
) {
    let mut workspace = [0.0; 3 * LENGTH];
    let mut integrator = RungeKutta4::new(&mut workspace).expect("three vectors");
    start.as_mut()[3..9].copy_from_slice(&ANGLES);
    clock.each(name, STEPS, &[start], |start| {
        let mut x = start.clone();
        (0..STEPS).for_each(|_| step(&mut integrator, x.as_mut()).expect("a regular state"));
        consume(x);
    });
}

/// As [`library_steps`], by a simulation that audits every step.
fn simulated_steps(clock: &mut impl Clock, model: &Robot<f64>) {
    let (joint_angles, joint_rates) = (ANGLES.to_vec(), vec![0.0; 6]);
    let start = RobotState { joint_angles, joint_rates, base_pose: [0.0; 3], base_twist: [0.0; 3] };
    let duration = STEP * f64::from(STEPS);
    let timing = Timing { duration, step: STEP, sample: duration, ..Timing::default() };
    clock.each("simulation, step", STEPS, &[()], |()| {
        consume(simulate(&System::alone(model), &mut { LAW }, &start, &timing, &mut NoEvents, &mut || ()));
    });
}

/// The audit that a simulation makes at every step.
fn audited_states(clock: &mut impl Clock, model: &Robot<f64>, states: &[State]) -> Result<(), Error> {
    let mut vectors = vec![[0.0; LENGTH]; states.len()];
    states.iter().zip(&mut vectors).try_for_each(|(state, vector)| view(state).write(vector))?;
    let mut audit = ConservationAudit::new(model, &view(&states[0]), &[])?;
    let input = AccumulatedInput::default();
    clock.each("audit, step", 1, &vectors, |vector| audit.record_vector(vector, &input).expect("a finite state"));
    consume(audit.drift());
    Ok(())
}

#[allow(clippy::cast_possible_truncation, reason = "rounding to the lane")]
fn single(value: f64) -> f32 {
    value as f32
}

/// The model and the states of a scalar that is as many numbers, or one.
fn in_lanes<T: Scalar, const N: usize>(states: &[State], lanes: impl Fn([f64; N]) -> T) -> (Robot<T>, Vec<State<T>>) {
    (black_box(Robot::default()), states.as_chunks().0.iter().map(|states| State::in_lanes(states, &lanes)).collect())
}

/// Forward dynamics of as many states at once as there are lanes.
fn forward_dynamics_in_lanes<T: Scalar, const N: usize>(
    clock: &mut impl Clock,
    scalar: &str,
    states: &[State],
    lanes: impl Fn([f64; N]) -> T,
) {
    let (model, states) = in_lanes(states, lanes);
    clock.each(&format!("{scalar}, forward dynamics"), count(N), &states, |s| consume(forward_dynamics(&model, s)));
}

/// The other functions.
fn others_in_lanes<T: Scalar, const N: usize>(
    clock: &mut impl Clock,
    scalar: &str,
    states: &[State],
    lanes: impl Fn([f64; N]) -> T,
) {
    let (model, states) = in_lanes(states, lanes);
    clock.each(&format!("{scalar}, reduced dynamics"), count(N), &states, |s| consume(reduced_dynamics(&model, s)));
    clock.each(&format!("{scalar}, reduced impact"), count(N), &states, |s| consume(reduced_impact(&model, s)));
    clock.each(&format!("{scalar}, full impact"), count(N), &states, |s| consume(full_impact(&model, s)));
}

/// Structures of arrays.
fn batches(clock: &mut impl Clock, suffix: &str, model: &Robot<f64>, states: &[State]) -> Result<(), Problem> {
    let mut arrays = Arrays::new(states);
    arrays.compare(model, states, AGREEMENT)?;
    let mut time = |name: &str, function: fn(&mut Arrays, &Robot<f64>) -> Result<(), Error>| {
        let name = format!("batch, {name}{suffix}");
        clock.each(&name, count(states.len()), &[()], |()| consume(function(black_box(&mut arrays), model)));
    };
    time("forward dynamics", Arrays::forward_dynamics);
    time("reduced dynamics", Arrays::reduced_dynamics);
    time("reduced impact", Arrays::reduced_impact);
    time("full impact", Arrays::full_impact);
    time("step", Arrays::step);
    Ok(())
}

fn count(states: usize) -> u32 {
    u32::try_from(states).expect("thousands")
}

/// By CasADi's C code, which is called.
struct ByC;

impl Motion for ByC {
    #[inline]
    fn accelerations(&self, x: &Vector) -> [f64; 9] {
        casadi::accelerations(x, &torques(x))
    }
}

/// By generated code, inlined.
struct ByModel<'a>(&'a Robot<f64>);

impl Motion for ByModel<'_> {
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "what is called passes vectors through memory")]
    fn accelerations(&self, x: &Vector) -> [f64; 9] {
        let (pose, angles, twist, rates) = parts(x);
        let found = self.0.forward_dynamics(&pose, &angles, &twist, &rates, &torques(x));
        joined(found.base_acceleration, found.joint_accelerations)
    }
}

/// By generated code in a function that is called.
struct ByCalls<'a>(&'a Robot<f64>);

impl Motion for ByCalls<'_> {
    #[inline(never)]
    fn accelerations(&self, x: &Vector) -> [f64; 9] {
        ByModel(self.0).accelerations(x)
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "what is called passes vectors through memory")]
fn joined(base: [f64; 3], joints: [f64; 6]) -> [f64; 9] {
    std::array::from_fn(|i| if i < 3 { base[i] } else { joints[i - 3] })
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is written")]
fn forward_dynamics<T: Scalar>(model: &Robot<T>, s: &State<T>) -> ForwardDynamics<T> {
    model.forward_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is written")]
fn reduced_dynamics<T: Scalar>(model: &Robot<T>, s: &State<T>) -> ReducedDynamics<T> {
    model.reduced_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is written")]
fn reduced_impact<T: Scalar>(model: &Robot<T>, s: &State<T>) -> ReducedImpact<T> {
    model.reduced_impact(&s.base_pose, &s.joint_angles, &s.joint_rates, &s.masses, &s.inertias, &s.contacts, &s.twists)
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "as where it is written")]
fn full_impact<T: Scalar>(model: &Robot<T>, s: &State<T>) -> FullImpact<T> {
    let (pose, twist) = (&s.base_pose, &s.base_twist);
    model.full_impact(pose, &s.joint_angles, twist, &s.joint_rates, &s.masses, &s.inertias, &s.contacts, &s.twists)
}

fn view(s: &State) -> View<'_, f64> {
    View {
        base_pose: s.base_pose,
        joint_angles: &s.joint_angles,
        base_twist: s.base_twist,
        joint_rates: &s.joint_rates,
    }
}

fn of_generic(generic: &Generic, s: &State) -> Result<[f64; 9], Error> {
    let mut joints = [0.0; 6];
    let base = generic.forward_dynamics(&view(s), &Forces::torques(&s.torques), &mut joints)?;
    Ok(joined(base, joints))
}

/// Generalized inertia and Jacobian.
fn reduced_of_generic(generic: &Generic, s: &State) -> Result<[[f64; 36]; 2], Error> {
    let [mut inertia, mut jacobian] = [[0.0; 36]; 2];
    generic.reduced_dynamics(&view(s), &mut inertia, &mut [0.0; 6], &mut jacobian)?;
    Ok([inertia, jacobian])
}

fn impact_of_generic(generic: &Generic, s: &State) -> Result<[f64; 9], Error> {
    let targets = [0, 1].map(|i| {
        Some(Target { mass: s.masses[i], inertia: s.inertias[i], contact: s.contacts[i], twist: s.twists[i] })
    });
    let mut joints = [0.0; 6];
    let base = generic.full_impact(&view(s), &targets, &mut joints)?;
    Ok(joined(base, joints))
}

/// Whether generated code and CasADi's agree.
fn compare(model: &Robot<f64>, states: &[State]) -> Result<(), Problem> {
    let mut results = Results::default();
    for s in states {
        let check = |what: &str, found: &[f64], expected: &[f64]| {
            let size = expected.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
            let differs = |(a, b): (&f64, &f64)| ((a - b) / size).abs() > AGREEMENT;
            let first = found.iter().zip(expected).find(|(a, b)| differs((a, b)));
            first.map_or(Ok(()), |(a, b)| Err(Problem::from(format!("{what}: {a}, CasADi {b}"))))
        };
        casadi::forward_dynamics(s, &mut results);
        let found = forward_dynamics(model, s);
        check("base acceleration", &found.base_acceleration, results.of(0, 3))?;
        check("joint accelerations", &found.joint_accelerations, results.of(1, 6))?;
        casadi::derivatives(s, &mut results);
        let found = derivatives(&derivatives::Model::default(), s);
        check("base acceleration with derivatives", &found.base_acceleration, results.of(0, 3))?;
        check("joint accelerations with derivatives", &found.joint_accelerations, results.of(1, 6))?;
        check("derivatives by position", found.by_position.as_flattened(), results.of(2, 81))?;
        check("derivatives by velocity", found.by_velocity.as_flattened(), results.of(3, 81))?;
        check("inverse mass matrix", found.inverse_mass_matrix.as_flattened(), results.of(4, 81))?;
        casadi::reduced_dynamics(s, &mut results);
        let found = reduced_dynamics(model, s);
        check("generalized inertia", found.generalized_inertia.as_flattened(), results.of(0, 36))?;
        check("generalized bias", &found.generalized_bias, results.of(1, 6))?;
        casadi::reduced_impact(s, &mut results);
        check("joint rates after", &reduced_impact(model, s).joint_rates_after, results.of(2, 6))?;
        casadi::full_impact(s, &mut results);
        check("base twist after", &full_impact(model, s).base_twist_after, results.of(2, 3))?;
    }
    Ok(())
}
