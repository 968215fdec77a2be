//! Calls a function of the paper's robot as often as asked for: `instructions FUNCTION CALLS`.

mod batches;

use batches::STATES;
use planar_build::evaluator::{self, Evaluator, GraphModel, Order};
use planar_build::graph;
use planar_capture::batch::Status;
use planar_capture::control::ProportionalDerivative;
use planar_capture::dynamics::{ForwardDynamics, Impact};
use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
use planar_capture::integrate::RungeKutta4;
use planar_capture::state::{Forces, State, vector_length};
use planar_capture::target::Target;
use planar_capture::trajectory::ConstantSetpoint;
use planar_layout::layout::Layout;
use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;
use std::sync::Arc;

/// Any error.
type Problem = Box<dyn std::error::Error>;

const POSE: [f64; 3] = [0.4, 1.0, -2.0];
const ANGLES: [f64; JOINTS] = [0.3, -1.2, 0.7, 2.1, 1.4, -0.6];
const TWIST: [f64; 3] = [0.2, -0.3, 0.1];
const RATES: [f64; JOINTS] = [0.4, -0.2, 0.9, -0.5, 0.3, 0.8];
const TORQUES: [f64; JOINTS] = [1.0, -2.0, 0.5, 3.0, -1.5, 0.7];
/// Masses, inertias, contacts and twists of the targets.
type Targets = ([f64; 2], [f64; 2], [[f64; 2]; 2], [[f64; 3]; 2]);
const TARGETS: Targets = ([10.0, 20.0], [1.0, 2.0], [[0.3, 0.1], [-0.2, 0.2]], [[0.1, 0.2, -0.1], [0.0, 0.1, 0.3]]);

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [function, calls] = arguments.as_slice() else { return ExitCode::from(2) };
    let Ok(calls) = calls.parse::<u32>() else { return ExitCode::from(2) };
    match run(function, calls) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(function: &str, calls: u32) -> Result<(), Problem> {
    let model = black_box(Model::<f64>::default());
    let inputs = (POSE, ANGLES, TWIST, RATES, TORQUES, TARGETS);
    match function {
        "forward_dynamics" => {
            for _ in 0..calls {
                // every call could have other numbers: nothing is computed before the loop
                let (pose, angles, twist, rates, torques, _) = black_box(&inputs);
                black_box(model.forward_dynamics(pose, angles, twist, rates, torques));
            }
        }
        "reduced_dynamics" => {
            for _ in 0..calls {
                let (pose, angles, twist, rates, ..) = black_box(&inputs);
                black_box(model.reduced_dynamics(pose, angles, twist, rates));
            }
        }
        "reduced_impact" => {
            for _ in 0..calls {
                let (pose, angles, _, rates, _, (masses, inertias, contacts, twists)) = black_box(&inputs);
                black_box(model.reduced_impact(pose, angles, rates, masses, inertias, contacts, twists));
            }
        }
        "full_impact" => {
            for _ in 0..calls {
                let (pose, angles, twist, rates, _, (masses, inertias, contacts, twists)) = black_box(&inputs);
                black_box(model.full_impact(pose, angles, twist, rates, masses, inertias, contacts, twists));
            }
        }
        "runge_kutta_step" => steps(&model, calls)?,
        "graph_forward_dynamics" => {
            let (graph, mut joints) = (graph_model()?, [0.0; JOINTS]);
            let state = State { base_pose: POSE, joint_angles: &ANGLES, base_twist: TWIST, joint_rates: &RATES };
            for _ in 0..calls {
                black_box(graph.forward_dynamics(black_box(&state), &Forces::torques(&TORQUES), &mut joints)?);
            }
        }
        "graph_full_impact" => {
            let (graph, mut joints) = (graph_model()?, [0.0; JOINTS]);
            let state = State { base_pose: POSE, joint_angles: &ANGLES, base_twist: TWIST, joint_rates: &RATES };
            let (masses, inertias, contacts, twists) = TARGETS;
            let target = |arm: usize| Target {
                mass: masses[arm],
                inertia: inertias[arm],
                contact: contacts[arm],
                twist: twists[arm],
            };
            let targets = [Some(target(0)), Some(target(1))];
            for _ in 0..calls {
                black_box(graph.full_impact(black_box(&state), &targets, &mut joints)?);
            }
        }
        "graph_batch_of_64" => graph_batches(calls)?,
        _ => match function.strip_prefix("batch_of_64") {
            Some(of) => batches::call(&model, of.trim_start_matches('_'), calls)?,
            None => return Err(format!("there is no function {function}").into()),
        },
    }
    Ok(())
}

/// Steps of the core's integrator under PD control. Within a function that compares names its calls would be taken for rare.
#[inline(never)]
fn steps(model: &Model<f64>, calls: u32) -> Result<(), Problem> {
    let mut vector = [0.0; vector_length(JOINTS)];
    State { base_pose: POSE, joint_angles: &ANGLES, base_twist: TWIST, joint_rates: &RATES }.write(&mut vector)?;
    let mut workspace = [0.0; RungeKutta4::<f64>::WORKSPACE * vector_length(JOINTS)];
    let mut integrator = RungeKutta4::new(&mut workspace)?;
    let mut law = ProportionalDerivative {
        trajectory: ConstantSetpoint { angles: &[0.0; JOINTS] },
        proportional_gain: &[49.0; JOINTS],
        derivative_gain: &[14.0; JOINTS],
    };
    let mut torques = [0.0; JOINTS];
    for _ in 0..calls {
        integrator.robot_step(black_box(model), &mut law, 0.0, 1e-4, &mut vector, &mut torques)?;
    }
    black_box(vector);
    Ok(())
}

/// The robot's graph, evaluated.
fn graph_model() -> Result<GraphModel, Problem> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../codegen");
    let text = std::fs::read_to_string(folder.join("graphs/dual_arm_3r.json"))?;
    let evaluator = Arc::new(Evaluator::new(&graph::read_any(&text)?)?);
    let layout = Layout::read(&folder.join("layouts/dual_arm_3r.toml")).map_err(|report| report.to_string())?;
    evaluator.model(&layout).map_err(|_| "the layout has another structure".into())
}

/// Forward dynamics of a batch, by the graph.
fn graph_batches(calls: u32) -> Result<(), Problem> {
    let model = graph_model()?;
    let inputs = [&POSE[..], &ANGLES, &TWIST, &RATES, &TORQUES].map(batches::rows);
    let inputs = inputs.each_ref().map(Vec::as_slice);
    let (mut base, mut joints) = ([0.0; 3 * STATES], [0.0; JOINTS * STATES]);
    for _ in 0..calls {
        let mut outputs = [Some(&mut base[..]), Some(&mut joints[..]), None];
        let batch = evaluator::Batch::of(&model).in_order(Order::Elements);
        batch.call("forward_dynamics", black_box(&inputs), &mut outputs, &mut [Status::Done; STATES])?;
        black_box(&mut base);
    }
    Ok(())
}
