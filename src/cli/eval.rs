//! `planar-capture eval LAYOUT.toml STATES.json`.

use super::dynamics::Dynamics;
use super::{Problem, layout};
use planar_capture::dynamics::Model;
use planar_capture::eval::{States, result_to_json};
use planar_capture::evaluation::evaluate;
use std::fs::File;
use std::io::{self, BufRead, BufReader, ErrorKind, Write};
use std::process::ExitCode;

/// Every quantity of a robot at given states, as a JSON array on the standard output.
///
/// Each result is written as soon as its state is read. A state that is wrong ends it with exit code 2; the array is
/// then closed after the results of the states before it.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// The states, a JSON array; `-` for the standard input.
    states: String,
    /// Which implementation of the dynamics computes it.
    #[arg(long, value_enum, default_value_t = Dynamics::Generated)]
    dynamics: Dynamics,
}

impl Arguments {
    /// Where the states come from, as shown to the user.
    fn shown(&self) -> String {
        if self.states == "-" { "standard input".to_owned() } else { self.states.clone() }
    }
}

/// Reads, computes, writes.
pub fn run(arguments: &Arguments) -> Result<ExitCode, Problem> {
    let layout = layout::read(&arguments.layout)?;
    let file = arguments.layout.clone();
    let model =
        arguments.dynamics.model(&layout).map_err(|source| Problem::Model { file, source: Box::new(source) })?;
    let unreadable = |source: io::Error| Problem::States { file: arguments.shown(), source: source.into() };
    let input: Box<dyn BufRead> = if arguments.states == "-" {
        Box::new(BufReader::new(io::stdin()))
    } else {
        Box::new(BufReader::with_capacity(1 << 16, File::open(&arguments.states).map_err(unreadable)?))
    };
    match all(&*model, input, arguments, &mut io::stdout().lock()) {
        // whoever reads has seen enough
        Err(Problem::Print(error)) if error.kind() == ErrorKind::BrokenPipe => Ok(ExitCode::SUCCESS),
        outcome => outcome.map(|()| ExitCode::SUCCESS),
    }
}

/// Writes an array that is closed in any case.
fn all(
    model: &dyn Model<f64>,
    input: Box<dyn BufRead>,
    arguments: &Arguments,
    out: &mut impl Write,
) -> Result<(), Problem> {
    out.write_all(b"[")?;
    let outcome = each(model, input, arguments, out);
    if !matches!(outcome, Err(Problem::Print(_))) {
        out.write_all(b"\n]\n")?;
        out.flush()?;
    }
    outcome
}

fn each(
    model: &dyn Model<f64>,
    input: Box<dyn BufRead>,
    arguments: &Arguments,
    out: &mut impl Write,
) -> Result<(), Problem> {
    let mut states = States::new(input, model);
    let mut line = Vec::new();
    let mut index = 0;
    while let Some(state) = states.next_state().map_err(|source| Problem::States { file: arguments.shown(), source })? {
        let result =
            evaluate(model, &state).map_err(|source| Problem::Evaluation { file: arguments.shown(), index, source })?;
        line.clear();
        line.extend_from_slice(if index == 0 { b"\n" } else { b",\n" });
        serde_json::to_writer(&mut line, &result_to_json(&result, &state.targets)).map_err(io::Error::from)?;
        out.write_all(&line)?;
        index += 1;
    }
    Ok(())
}
