//! Time of one evaluation of the paper's robot: generated code against CasADi's C and the generic implementation.
//!
//! The program builds itself for several sets of compiler flags, lets the builds measure in turns, and writes medians and
//! ratios to `docs/performance.md` and `target/performance.json`. With `measure ROUNDS` it is one of these builds.

#[cfg(feature = "measure")]
mod batch;
mod builds;
#[cfg(feature = "measure")]
mod casadi;
#[cfg(feature = "measure")]
mod derivatives;
#[cfg(feature = "measure")]
mod measure;
mod report;
#[cfg(feature = "measure")]
mod runge_kutta;
#[cfg(feature = "measure")]
mod states;

use std::process::ExitCode;

/// Any error.
type Problem = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments.as_slice() {
        #[cfg(feature = "measure")]
        ["measure"] => measure::print(),
        [] => builds::run(9).and_then(|measured| report::write(&measured)),
        ["--rounds", rounds] => {
            rounds.parse().map_err(Problem::from).and_then(builds::run).and_then(|measured| report::write(&measured))
        }
        _ => Err("expected no arguments, or --rounds NUMBER".into()),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}
