//! Mutants of the shipped files and raw bytes through every reader of this project, in process.
//!
//! An input follows from seed, target and index alone, so that `--target NAME --seed S --start INDEX --inputs 1` runs a
//! failing one again. A panic, a broken promise of a target, a time above a bound, and memory that grows end the run
//! with exit code 1; a failing input is made small first, and printed.

mod dictionary;
mod input;
mod limits;
mod mutation;
mod targets;
mod tokens;
mod trial;

use clap::Parser;
use limits::Limits;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};
use targets::Target;

/// Runs inputs through every reader.
#[derive(Debug, Parser)]
struct Arguments {
    /// Number of inputs of all targets together [default: as many as the time allows].
    #[arg(long)]
    inputs: Option<u64>,
    /// Time for all targets together, s [default: 60, or none with --inputs].
    #[arg(long)]
    seconds: Option<f64>,
    /// What all inputs follow from.
    #[arg(long, default_value_t = 2017)]
    seed: u64,
    /// Index of the first input.
    #[arg(long, default_value_t = 0)]
    start: u64,
    /// One target alone: layout, scenario, states, urdf or graph.
    #[arg(long)]
    target: Option<String>,
    /// Print the inputs instead of reading them.
    #[arg(long)]
    print: bool,
    /// Number of threads [default: one per processor].
    #[arg(long)]
    threads: Option<usize>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let all = targets::all();
    let is_wanted = |target: &&Target| arguments.target.as_ref().is_none_or(|name| name == target.name);
    let wanted: Vec<&Target> = all.iter().filter(is_wanted).collect();
    if wanted.is_empty() {
        eprintln!("error: no such target, expected layout, scenario, states, urdf or graph");
        return ExitCode::from(2);
    }
    trial::silence_panics();
    let seconds = arguments.seconds.or(arguments.inputs.is_none().then_some(60.0));
    let each = seconds.map(|seconds| Duration::from_secs_f64(seconds) / u32::try_from(wanted.len()).unwrap_or(1));
    let shares: u64 = wanted.iter().map(|target| target.share).sum();
    let (mut run, started) = (0, Instant::now());
    for target in wanted {
        if arguments.print {
            let end = arguments.start.saturating_add(arguments.inputs.unwrap_or(1));
            (arguments.start..end).for_each(|index| println!("{}", trial::text(target, arguments.seed, index)));
            continue;
        }
        let inputs = arguments.inputs.map(|inputs| (inputs * target.share).div_ceil(shares));
        match fuzz(target, &arguments, inputs, each) {
            Ok(inputs) => run += inputs,
            Err(failure) => {
                eprintln!("fuzz: {failure}");
                return ExitCode::from(1);
            }
        }
    }
    if arguments.print {
        return ExitCode::SUCCESS;
    }
    let rate = limits::rate(run, started.elapsed());
    println!("fuzz: {run} inputs, {rate} inputs/s, seed {}, nothing found", arguments.seed);
    ExitCode::SUCCESS
}

/// Runs the inputs of a target; their number, or the first failure.
fn fuzz(target: &Target, arguments: &Arguments, inputs: Option<u64>, time: Option<Duration>) -> Result<u64, String> {
    let threads = arguments.threads.or_else(|| std::thread::available_parallelism().ok().map(usize::from)).unwrap_or(1);
    let end = inputs.map_or(u64::MAX, |inputs| arguments.start.saturating_add(inputs));
    let (next, accepted, done) = (AtomicU64::new(arguments.start), AtomicU64::new(0), AtomicBool::new(false));
    let limits = Limits::new(threads);
    let started = Instant::now();
    let is_late = || time.is_some_and(|time| started.elapsed() > time);
    let work = |thread: usize| {
        while !done.load(Ordering::Relaxed) && !is_late() {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= end {
                break;
            }
            limits.begin(thread, index);
            let outcome = trial::run(target, arguments.seed, index);
            limits.end(thread);
            let outcome = outcome.and_then(|valid| limits.memory(index).map(|()| valid));
            match outcome {
                Ok(valid) => drop(accepted.fetch_add(u64::from(valid), Ordering::Relaxed)),
                Err(failure) => {
                    done.store(true, Ordering::Relaxed);
                    let (name, seed) = (target.name, arguments.seed);
                    let again = format!("--target {name} --seed {seed} --start {index} --inputs 1 --threads 1");
                    return Err(format!("{failure}\nto run it again: {again}"));
                }
            }
        }
        Ok(())
    };
    let finished = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| limits.watch(target.name, &finished));
        let workers: Vec<_> = (0..threads).map(|thread| scope.spawn(move || work(thread))).collect();
        let outcomes: Vec<_> = workers.into_iter().map(|worker| worker.join().expect("panics are caught")).collect();
        finished.store(true, Ordering::Relaxed);
        outcomes.into_iter().collect::<Result<(), String>>()
    })?;
    let run = next.load(Ordering::Relaxed).min(end) - arguments.start;
    limits.growth(run)?;
    let rate = limits::rate(run, started.elapsed());
    let (valid, (slowest, index)) = (accepted.load(Ordering::Relaxed), limits.slowest());
    println!("{}: {run} inputs, {valid} of them valid, {rate} inputs/s, at most {slowest} ms ({index})", target.name);
    Ok(run)
}
