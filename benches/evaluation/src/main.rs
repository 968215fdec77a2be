//! Time of one evaluation of the paper's robot: generated code against CasADi's C, the generic implementation and, with
//! `--reference PYTHON`, Pinocchio and MuJoCo. With `--package PYTHON` that interpreter's package `planar_capture` is measured, too.
//!
//! The program builds itself for several sets of compiler flags, lets the builds and the engines measure in turns, and writes
//! medians and ratios to `docs/performance.md` and `target/performance.json`. With `measure` it is one of these builds; with
//! `input FILE` one writes what the engines compute with.

mod builds;
mod engines;
mod report;

use evaluation::Problem;
#[cfg(feature = "measure")]
use evaluation::{clock::ThreadTime, input, measure};
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match arguments.as_slice() {
        #[cfg(feature = "measure")]
        ["measure"] => print(),
        #[cfg(feature = "measure")]
        ["input", file] => input::write(file.as_ref()),
        arguments => options(arguments)
            .and_then(|(rounds, interpreters)| builds::run(rounds, interpreters))
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

/// Measures, and prints names and times as JSON.
#[cfg(feature = "measure")]
fn print() -> Result<(), Problem> {
    let mut times = ThreadTime::default();
    measure::all(&mut times)?;
    let operations = measure::operations().map(|(name, count)| (format!("operations, {name}"), count.into()));
    let times = times.0.into_iter().map(|(name, time)| (name, time.into()));
    let all: serde_json::Map<_, _> = times.chain(operations).collect();
    println!("{}", serde_json::Value::Object(all));
    Ok(())
}

/// Interpreters of Python.
#[derive(Clone, Copy, Default)]
struct Interpreters<'a> {
    /// Whose packages have the other engines.
    reference: Option<&'a str>,
    /// That has the package `planar_capture`.
    package: Option<&'a str>,
}

fn options<'a>(mut arguments: &[&'a str]) -> Result<(usize, Interpreters<'a>), Problem> {
    let (mut rounds, mut interpreters) = (9, Interpreters::default());
    while let [option, value, rest @ ..] = arguments {
        match *option {
            "--rounds" => rounds = value.parse()?,
            "--reference" => interpreters.reference = Some(*value),
            "--package" => interpreters.package = Some(*value),
            _ => break,
        }
        arguments = rest;
    }
    if arguments.is_empty() {
        Ok((rounds, interpreters))
    } else {
        Err("expected --rounds NUMBER, --reference PYTHON, --package PYTHON or nothing".into())
    }
}
