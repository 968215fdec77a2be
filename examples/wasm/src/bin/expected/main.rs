//! Computes on this machine what the module has to compute, and writes it to a file: for each of some states all inputs and
//! results as raw numbers, little-endian. check.mjs reads them.
//!
//! Prints the time of each function here, as JSON, in ns.

mod inputs;
mod raw;

use inputs::{FIRST_NEAR, Inputs};
use raw::Raw;
use std::hint::black_box;
use std::time::Instant;
use std::{env, error, fs};
use wasm::{ARMS, Real, Robot, RobotState, SIZE};

const STATES: u32 = 1000;
const GAINS: [Real; 2] = [49.0, 14.0];
const STEP: Real = 0.001;
/// Of which the fastest counts.
const RUNS: usize = 50;

/// Where a function has its results.
#[derive(Clone, Copy, Default)]
struct Results {
    accelerations: [Real; SIZE],
    state: RobotState,
    target_twists: [[Real; 3]; ARMS],
    impulses: [[Real; 3]; ARMS],
}

/// A function: whether it has results, and what they are.
struct Function {
    name: &'static str,
    call: fn(&Robot, &Inputs, &mut Results) -> bool,
    put: fn(&Results, &mut Raw),
}

const FUNCTIONS: [Function; 4] = [
    Function {
        name: "forward_dynamics",
        call: |robot, inputs, results| {
            wasm::forward_dynamics(robot, &inputs.state, &inputs.torques, &mut results.accelerations)
        },
        put: |results, file| file.put(&results.accelerations),
    },
    Function {
        name: "control_step",
        call: |robot, Inputs { state, desired_angles, desired_rates, .. }, results| {
            results.state = *state;
            wasm::control_step(robot, &mut results.state, desired_angles, desired_rates, GAINS[0], GAINS[1], STEP)
        },
        put: |results, file| file.put_state(&results.state),
    },
    Function {
        name: "exact_impact",
        call: |robot, inputs, Results { state, target_twists, impulses, .. }| {
            *state = inputs.state;
            wasm::exact_impact(robot, state, &inputs.captured, target_twists, impulses)
        },
        put: |results, file| {
            file.put_state(&results.state);
            file.put(results.target_twists.as_flattened());
            file.put(results.impulses.as_flattened());
        },
    },
    // the robot is opaque: how it accelerates is not
    Function {
        name: "merge",
        call: |robot, inputs, results| {
            let mut robot = *robot;
            wasm::merge(&mut robot, &inputs.state, &inputs.captured)
                && wasm::forward_dynamics(&robot, &inputs.state, &inputs.torques, &mut results.accelerations)
        },
        put: |results, file| file.put(&results.accelerations),
    },
];

fn main() -> Result<(), Box<dyn error::Error>> {
    let path = env::args().nth(1).ok_or("a file to write")?;
    let robot = Robot::default();
    let mut file = Raw::default();
    for index in 0..STATES {
        let inputs = Inputs::new(index);
        inputs.put(&mut file);
        for function in &FUNCTIONS {
            let mut results = Results::default();
            let is_done = (function.call)(&robot, &inputs, &mut results);
            file.put(&[if is_done { 1.0 } else { 0.0 }]);
            (function.put)(&results, &mut file);
        }
    }
    fs::write(path, &file.0)?;
    let times = FUNCTIONS.iter().map(|function| format!("\"{}\": {:.0}", function.name, time(&robot, function)));
    println!("{{{}}}", times.collect::<Vec<_>>().join(", "));
    Ok(())
}

/// ns of a call: the least of some runs through the ordinary states.
fn time(robot: &Robot, function: &Function) -> f64 {
    let inputs: Vec<_> = (0..FIRST_NEAR).map(Inputs::new).collect();
    let mut results = Results::default();
    let runs = (0..RUNS).map(|_| {
        let start = Instant::now();
        for inputs in &inputs {
            (function.call)(black_box(robot), black_box(inputs), black_box(&mut results));
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(FIRST_NEAR)
    });
    runs.fold(f64::INFINITY, f64::min)
}
