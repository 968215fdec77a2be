//! What one build measures: nanoseconds of processor time per evaluation.

use crate::Problem;
use crate::batch::Arrays;
use crate::casadi::{self, Results};
use crate::derivatives::{self, derivatives};
use crate::limit;
use crate::runge_kutta::{self, GAINS, Motion, Vector, parts, torques};
use crate::states::{State, states};
use planar_build::prove::generic::Generic;
use planar_capture::control::ProportionalDerivative;
use planar_capture::dynamics::{ForwardDynamics, Impact, ReducedDynamics};
use planar_capture::error::Error;
use planar_capture::generated::dual_arm_3r::{FullImpact, Model, ReducedImpact};
use planar_capture::integrate::RungeKutta4;
use planar_capture::owned::RobotState;
use planar_capture::simulate::conservation::{AccumulatedInput, ConservationAudit};
use planar_capture::simulate::event::NoEvents;
use planar_capture::simulate::system::System;
use planar_capture::simulate::{Timing, simulate};
use planar_capture::state::{Forces, State as View, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::ConstantSetpoint;
use planar_layout::layout::Layout;
use rustix::time::{ClockId, clock_gettime};
use serde_json::{Map, Value};
use std::hint::black_box;
use std::path::Path;
use wide::{f32x8, f32x16, f64x4, f64x8};

/// States that stay in the first-level cache, and that do not.
const FEW: usize = 64;
const MANY: usize = 16_384;
/// Least time of a measurement, s.
const LEAST: f64 = 0.02;
/// Largest difference from CasADi's results, relative to 1 or the value.
const AGREEMENT: f64 = 1e-11;

/// Joint angles at the start of a motion, rad; its step, s; and the number of steps until the robot is at rest.
pub const ANGLES: [f64; 6] = [0.3, -0.4, 0.5, -0.3, 0.4, -0.5];
pub const STEP: f64 = 1e-3;
const STEPS: u32 = 20_000;

/// Forward dynamics of as many states at once as there are lanes, per state.
macro_rules! per_lane {
    ($lanes:ty, $float:ty, $count:literal, $states:expr, $from:expr) => {{
        let lanes: fn([$float; $count]) -> $lanes = $from;
        let model = black_box(Model::<$lanes>::default());
        #[allow(clippy::cast_possible_truncation, clippy::cast_lossless, reason = "rounding to the lane")]
        let vectors: Vec<_> = $states
            .chunks_exact($count)
            .map(|states| {
                let lane = |of: &dyn Fn(&State) -> f64| -> $lanes {
                    lanes(std::array::from_fn::<$float, $count, _>(|k| of(&states[k]) as $float))
                };
                (
                    std::array::from_fn(|i| lane(&|s| s.base_pose[i])),
                    std::array::from_fn(|i| lane(&|s| s.joint_angles[i])),
                    std::array::from_fn(|i| lane(&|s| s.base_twist[i])),
                    std::array::from_fn(|i| lane(&|s| s.joint_rates[i])),
                    std::array::from_fn(|i| lane(&|s| s.torques[i])),
                )
            })
            .collect();
        each(&vectors, |(pose, angles, twist, rates, torques)| {
            black_box(model.forward_dynamics(pose, angles, twist, rates, torques));
        }) / f64::from($count)
    }};
}

/// The paper's robot.
pub fn layout() -> Result<Layout, Problem> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../codegen/layouts/dual_arm_3r.toml");
    Layout::read(&path).map_err(|report| report.to_string().into())
}

/// Compares with CasADi, measures, and prints names and times as JSON.
pub fn print() -> Result<(), Problem> {
    // whose numbers the compiler does not know
    let (generic, model) = (Generic::new(&layout()?), black_box(Model::<f64>::default()));
    let (few, many) = (states(FEW), states(MANY));
    compare(&model, &few)?;
    let mut times = Map::new();
    let mut record = |name: &str, time: f64| drop(times.insert(name.to_owned(), Value::from(time)));

    let mut results = Results::default();
    record("C, forward dynamics", each(&few, |s| casadi::forward_dynamics(s, &mut results)));
    record("C, derivatives", each(&few, |s| casadi::derivatives(s, &mut results)));
    record("C, reduced dynamics", each(&few, |s| casadi::reduced_dynamics(s, &mut results)));
    record("C, reduced impact", each(&few, |s| casadi::reduced_impact(s, &mut results)));
    record("C, full impact", each(&few, |s| casadi::full_impact(s, &mut results)));
    record("C, forward dynamics, many states", each(&many, |s| casadi::forward_dynamics(s, &mut results)));
    record("C, reduced dynamics, many states", each(&many, |s| casadi::reduced_dynamics(s, &mut results)));
    record("C, reduced impact, many states", each(&many, |s| casadi::reduced_impact(s, &mut results)));
    record("C, full impact, many states", each(&many, |s| casadi::full_impact(s, &mut results)));
    record("C, step", steps(&ByC));
    black_box(&results);

    let forward = |s: &State| {
        black_box(model.forward_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques));
    };
    record("f64, forward dynamics", each(&few, forward));
    record("f64, forward dynamics, many states", each(&many, forward));
    let with_derivatives = black_box(derivatives::Model::default());
    record(
        "f64, derivatives",
        each(&few, |s| {
            black_box(derivatives(&with_derivatives, s));
        }),
    );
    record(
        "f64, reduced dynamics",
        each(&few, |s| {
            black_box(model.reduced_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates));
        }),
    );
    record("f64, reduced impact", each(&few, |s| consume(reduced_impact(&model, s))));
    record("f64, full impact", each(&few, |s| consume(full_impact(&model, s))));
    record("f64, step", steps(&ByModel(&model)));
    record("f64, called step", steps(&ByCalls(&model)));
    record("library, step", library_steps(&model));
    record("simulation, step", simulated_steps(&model));
    record("audit, step", audited_states(&model, &few)?);

    record("f32, forward dynamics", per_lane!(f32, f32, 1, few, |[value]| value));
    record("f64x4, forward dynamics", per_lane!(f64x4, f64, 4, few, f64x4::from));
    record("f64x8, forward dynamics", per_lane!(f64x8, f64, 8, few, f64x8::from));
    record("f32x8, forward dynamics", per_lane!(f32x8, f32, 8, few, f32x8::from));
    record("f32x16, forward dynamics", per_lane!(f32x16, f32, 16, few, f32x16::from));

    for (states, suffix) in [(&few, ""), (&many, ", many states")] {
        let mut arrays = Arrays::new(states);
        arrays.compare(&model, states, AGREEMENT)?;
        let mut of = |function: fn(&mut Arrays, &Model<f64>) -> Result<(), Error>| {
            #[allow(clippy::cast_precision_loss, reason = "thousands")]
            let count = states.len() as f64;
            each(&[()], |()| consume(function(black_box(&mut arrays), &model))) / count
        };
        record(&format!("batch, forward dynamics{suffix}"), of(Arrays::forward_dynamics));
        record(&format!("batch, reduced dynamics{suffix}"), of(Arrays::reduced_dynamics));
        record(&format!("batch, reduced impact{suffix}"), of(Arrays::reduced_impact));
        record(&format!("batch, full impact{suffix}"), of(Arrays::full_impact));
        record(&format!("batch, step{suffix}"), of(Arrays::step));
    }

    record("generic, forward dynamics", each(&few, |s| consume(of_generic(&generic, s))));
    record("generic, reduced dynamics", each(&few, |s| consume(reduced_of_generic(&generic, s))));
    record("generic, full impact", each(&few, |s| consume(impact_of_generic(&generic, s))));
    record("operation at the peak", limit::nanoseconds_per_operation());
    let names = ["forward dynamics", "reduced dynamics", "reduced impact", "full impact"];
    for (name, operations) in names.iter().zip(limit::operations(&few[0])) {
        record(&format!("operations, {name}"), f64::from(operations));
    }
    println!("{}", Value::Object(times));
    Ok(())
}

/// Keeps the compiler from leaving out what has no use.
pub fn consume<T>(result: T) {
    let _ = black_box(result);
}

/// Nanoseconds of this thread's processor time per call, over all states again and again.
pub fn each<S>(states: &[S], mut evaluate: impl FnMut(&S)) -> f64 {
    let mut pass = || states.iter().for_each(|state| evaluate(black_box(state)));
    pass();
    let mut passes = 1_u32;
    loop {
        let start = seconds();
        (0..passes).for_each(|_| pass());
        let time = seconds() - start;
        if time >= LEAST {
            #[allow(clippy::cast_precision_loss, reason = "thousands")]
            return time * 1e9 / (f64::from(passes) * states.len() as f64);
        }
        passes *= 2;
    }
}

/// Nanoseconds per Runge–Kutta step of a motion under control.
fn steps(motion: &impl Motion) -> f64 {
    let mut start = [0.0; 18];
    start[3..9].copy_from_slice(&ANGLES);
    let mut x = start;
    let mut count = 0;
    let time = each(&[()], |()| {
        if count % STEPS == 0 {
            x = start;
        }
        count += 1;
        runge_kutta::step(motion, &mut x, STEP);
    });
    black_box(x);
    time
}

/// A law that holds the joints at 0.
const LAW: ProportionalDerivative<'static, f64, ConstantSetpoint<'static, f64>> = ProportionalDerivative {
    trajectory: ConstantSetpoint { angles: &[0.0; 6] },
    proportional_gain: &[GAINS[0]; 6],
    derivative_gain: &[GAINS[1]; 6],
};

/// As [`steps`], by integrator, law and equation of the library.
fn library_steps(model: &Model<f64>) -> f64 {
    let mut start = [0.0; vector_length(6)];
    start[3..9].copy_from_slice(&ANGLES);
    let mut x = start;
    let (mut workspace, mut torques, mut law) = ([0.0; 3 * vector_length(6)], [0.0; 6], LAW);
    let mut integrator = RungeKutta4::new(&mut workspace).expect("three vectors");
    let mut count = 0;
    let time = each(&[()], |()| {
        if count % STEPS == 0 {
            x = start;
        }
        count += 1;
        integrator.robot_step(model, &mut law, 0.0, STEP, &mut x, &mut torques).expect("a regular state");
    });
    black_box(x);
    time
}

/// As [`library_steps`], by a simulation that audits every step.
fn simulated_steps(model: &Model<f64>) -> f64 {
    let (start, mut law) = (
        RobotState {
            joint_angles: ANGLES.to_vec(),
            joint_rates: vec![0.0; 6],
            base_pose: [0.0; 3],
            base_twist: [0.0; 3],
        },
        LAW,
    );
    let duration = STEP * f64::from(STEPS);
    let timing = Timing { duration, step: STEP, sample: duration, ..Timing::default() };
    let mut run = |()| simulate(&System::alone(model), &mut law, &start, &timing, &mut NoEvents, &mut || ());
    each(&[()], |()| consume(run(()))) / f64::from(STEPS)
}

/// Nanoseconds per state of the audit that a simulation makes at every step.
fn audited_states(model: &Model<f64>, states: &[State]) -> Result<f64, Error> {
    let mut vectors = vec![[0.0; vector_length(6)]; states.len()];
    states.iter().zip(&mut vectors).try_for_each(|(state, vector)| view(state).write(vector))?;
    let mut audit = ConservationAudit::new(model, &view(&states[0]), &[])?;
    let input = AccumulatedInput::default();
    let time = each(&vectors, |vector| audit.record_vector(vector, &input).expect("a finite state"));
    consume(audit.drift());
    Ok(time)
}

#[allow(clippy::cast_precision_loss, reason = "nanoseconds of minutes")]
fn seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
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
struct ByModel<'a>(&'a Model<f64>);

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
struct ByCalls<'a>(&'a Model<f64>);

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

fn reduced_impact(model: &Model<f64>, s: &State) -> ReducedImpact<f64> {
    model.reduced_impact(&s.base_pose, &s.joint_angles, &s.joint_rates, &s.masses, &s.inertias, &s.contacts, &s.twists)
}

fn full_impact(model: &Model<f64>, s: &State) -> FullImpact<f64> {
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
fn compare(model: &Model<f64>, states: &[State]) -> Result<(), Problem> {
    let mut results = Results::default();
    for s in states {
        let check = |what: &str, found: &[f64], expected: &[f64]| {
            let size = expected.iter().fold(1.0, |size: f64, value| size.max(value.abs()));
            let differs = |(a, b): (&f64, &f64)| ((a - b) / size).abs() > AGREEMENT;
            let first = found.iter().zip(expected).find(|(a, b)| differs((a, b)));
            first.map_or(Ok(()), |(a, b)| Err(Problem::from(format!("{what}: {a}, CasADi {b}"))))
        };
        casadi::forward_dynamics(s, &mut results);
        let found = model.forward_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates, &s.torques);
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
        let found = model.reduced_dynamics(&s.base_pose, &s.joint_angles, &s.base_twist, &s.joint_rates);
        check("generalized inertia", found.generalized_inertia.as_flattened(), results.of(0, 36))?;
        check("generalized bias", &found.generalized_bias, results.of(1, 6))?;
        casadi::reduced_impact(s, &mut results);
        check("joint rates after", &reduced_impact(model, s).joint_rates_after, results.of(2, 6))?;
        casadi::full_impact(s, &mut results);
        check("base twist after", &full_impact(model, s).base_twist_after, results.of(2, 3))?;
    }
    Ok(())
}
