//! Time of evaluated graphs against compiled code of the same graph, the paper's robot: one state at a time, and
//! batches.
//!
//! All measurements take turns, so that a loaded machine slows all of them: processor time, medians of all turns; a
//! ratio is the median of those of each turn. Results are compared bit by bit before they are measured. `--rounds
//! NUMBER` sets the number of turns.

mod compiled;
mod evaluated;
mod single;
mod states;

use planar_build::evaluator::{InstructionSet, Order};
use rustix::time::{ClockId, clock_gettime};
use states::States;
use std::process::ExitCode;

/// Any error.
type Problem = Box<dyn std::error::Error>;

/// Instances of a batch.
const COUNT: usize = 1024;
/// Least time of a measurement, ns.
const LEAST: f64 = 2e6;

/// The functions that compiled batches have.
const FUNCTIONS: [&str; 4] = ["forward_dynamics", "reduced_dynamics", "reduced_impact", "full_impact"];
const SETS: [(&str, InstructionSet); 3] = [
    ("best of the processor", InstructionSet::Detected),
    ("AVX2 with FMA", InstructionSet::Avx2),
    ("as built", InstructionSet::AsBuilt),
];

/// Something to be measured: its name, and a call for a number of instances.
struct Measurement<'a> {
    name: String,
    instances: usize,
    call: Box<dyn FnMut() + 'a>,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let rounds = match arguments.as_slice() {
        [] => Ok(31),
        ["--rounds", rounds] => rounds.parse().map_err(Problem::from),
        _ => Err("expected no arguments, or --rounds NUMBER".into()),
    };
    match rounds.and_then(run) {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

fn run(rounds: usize) -> Result<(), Problem> {
    let robot = evaluated::robot()?;
    let states = States::new(COUNT);
    let elements = states.arrays(Order::Elements);
    let by_instance = states.arrays(Order::Instances);
    println!("ns per state; ratio to compiled code\n\n| | compiled | graph | ratio |\n|---|---|---|---|");
    for function in FUNCTIONS {
        let [mut code, mut graph] = single::calls(function, &robot, &states)?;
        let mut pair = [
            Measurement::new("code", single::STATES, &mut *code),
            Measurement::new("graph", single::STATES, &mut *graph),
        ];
        row(&format!("{function}, one state"), &medians(&mut pair, rounds));
    }
    for (set_name, set) in SETS {
        for function in FUNCTIONS {
            let mut code = compiled::Batches::new(COUNT);
            let mut graph = evaluated::Batches::new(&robot, function, &elements, Order::Elements, set)?;
            let mut other = evaluated::Batches::new(&robot, function, &by_instance, Order::Instances, set)?;
            let mut each = evaluated::Batches::of_each(&robot, function, &elements, set)?;
            code.call(function, set, &elements)?;
            for graph in [&mut graph, &mut each] {
                graph.call()?;
                graph.compare(&code.results(function))?;
            }
            let failed = |result: Result<(), Problem>| result.unwrap_or_else(|problem| panic!("{problem}"));
            let mut all = [
                Measurement::new("code", COUNT, || failed(code.call(function, set, &elements))),
                Measurement::new("graph", COUNT, || failed(graph.call())),
                Measurement::new("graph, instance by instance", COUNT, || failed(other.call())),
                Measurement::new("graph, a robot for each", COUNT, || failed(each.call())),
            ];
            row(&format!("{function}, {COUNT} states, {set_name}"), &medians(&mut all, rounds));
        }
    }
    Ok(())
}

impl<'a> Measurement<'a> {
    fn new(name: &str, instances: usize, call: impl FnMut() + 'a) -> Self {
        Self { name: name.to_owned(), instances, call: Box::new(call) }
    }

    /// ns for each instance.
    fn time(&mut self) -> f64 {
        let start = now();
        let mut calls = 0.0;
        while now() - start < LEAST {
            for _ in 0..4 {
                (self.call)();
            }
            calls += 4.0;
        }
        #[allow(clippy::cast_precision_loss, reason = "few instances")]
        let instances = self.instances as f64;
        (now() - start) / (calls * instances)
    }
}

/// Processor time of this thread, ns.
#[allow(clippy::cast_precision_loss, reason = "minutes")]
fn now() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 * 1e9 + time.tv_nsec as f64
}

/// Names, median times, and median ratios to the first of each, which take turns.
fn medians(measurements: &mut [Measurement<'_>], rounds: usize) -> Vec<(String, f64, f64)> {
    let mut times = vec![Vec::with_capacity(rounds); measurements.len()];
    for _ in 0..rounds.max(1) {
        for (measurement, times) in measurements.iter_mut().zip(&mut times) {
            times.push(measurement.time());
        }
    }
    let first = times[0].clone();
    let of = |(measurement, times): (&Measurement<'_>, &Vec<f64>)| {
        let ratios = times.iter().zip(&first).map(|(time, first)| time / first);
        (measurement.name.clone(), median(times.clone()), median(ratios.collect()))
    };
    measurements.iter().zip(&times).map(of).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Prints the rows of a table: the first time is that of compiled code.
fn row(name: &str, times: &[(String, f64, f64)]) {
    let [(_, code, _), graphs @ ..] = times else { return };
    for (graph, time, ratio) in graphs {
        let graph = graph.strip_prefix("graph").unwrap_or(graph);
        println!("| {name}{graph} | {code:.1} | {time:.1} | {ratio:.2} |");
    }
}
