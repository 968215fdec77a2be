//! Time of one evaluation of the paper's robot: generated code against CasADi's C, the generic implementation and, with
//! `--reference PYTHON`, Pinocchio and MuJoCo.
//!
//! The program builds itself for several sets of compiler flags, lets the builds and the engines measure in turns, and writes
//! medians and ratios to `docs/performance.md` and `target/performance.json`. With `measure` it is one of these builds; with
//! `input FILE` one writes what the engines compute with.

#[cfg(feature = "measure")]
mod batch;
mod builds;
#[cfg(feature = "measure")]
mod casadi;
#[cfg(feature = "measure")]
mod derivatives;
mod engines;
#[cfg(feature = "measure")]
mod input;
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
        #[cfg(feature = "measure")]
        ["input", file] => measure::layout().and_then(|layout| input::write(&layout, file.as_ref())),
        arguments => options(arguments)
            .and_then(|(rounds, python)| builds::run(rounds, python))
            .and_then(|measured| report::write(&measured)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(problem) => {
            eprintln!("error: {problem}");
            ExitCode::FAILURE
        }
    }
}

/// Rounds, and the interpreter whose packages have the other engines.
fn options<'a>(mut arguments: &[&'a str]) -> Result<(usize, Option<&'a str>), Problem> {
    let (mut rounds, mut python) = (9, None);
    while let [option, value, rest @ ..] = arguments {
        match *option {
            "--rounds" => rounds = value.parse()?,
            "--reference" => python = Some(*value),
            _ => break,
        }
        arguments = rest;
    }
    if arguments.is_empty() {
        Ok((rounds, python))
    } else {
        Err("expected --rounds NUMBER, --reference PYTHON or nothing".into())
    }
}
