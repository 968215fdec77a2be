//! `planar-capture eval LAYOUT.toml STATES.json`: all quantities at given states, as JSON.

use super::dynamics::Dynamics;
use super::{CommandError, file_error, layout};
use crate::dynamics::AnyModel;
use crate::eval::{StateError, States, result_to_json};
use crate::evaluation::evaluate;
use crate::layout::Layout;
use crate::registry::Robots;
use crate::rigid_capture::resolve_capture;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture eval dual_arm_3r states.json > results.json
  planar-capture eval mine.toml - < states.json | jq '.[].kinetic_energy'";

/// Compute every quantity of a robot at given states, as JSON.
///
/// The standard output is an array with a result for each state, written as soon as the state is read. An invalid state ends
/// the command with exit code 2. Its output is then no JSON: nothing where it is the first one, else an array that is not closed, so
/// that what reads it does not take the results of the states before it for all.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// The states, a JSON array; `-` for the standard input.
    states: String,
    /// The implementation of the dynamics.
    #[arg(long, value_enum, default_value_t = Dynamics::Auto)]
    dynamics: Dynamics,
    /// Do not say which implementation computes the dynamics.
    #[arg(short, long)]
    quiet: bool,
}

/// Evaluates the states one by one.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    let choice = arguments.dynamics.choose(&layout, &arguments.layout, robots)?;
    if !arguments.quiet {
        arguments.dynamics.announce(&choice, &arguments.layout, "");
    }
    let model = choice.model(&layout);
    let (input, name): (Box<dyn BufRead>, _) = if arguments.states == "-" {
        (Box::new(BufReader::new(io::stdin())), "standard input")
    } else {
        let file = File::open(&arguments.states);
        let file = file.map_err(|error| file_error(&arguments.states)(StateError::Unreadable(error)))?;
        (Box::new(BufReader::with_capacity(1 << 16, file)), arguments.states.as_str())
    };
    let mut out = io::stdout().lock();
    let count = evaluate_all(&*model, &layout, input, name, &mut out)?;
    // only now: after an invalid state the array stays open
    out.write_all(if count == 0 { b"[\n]\n" } else { b"\n]\n" })?;
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

/// How many states there were; the array begins with the first result.
fn evaluate_all(
    model: &AnyModel<f64>,
    layout: &Layout,
    input: Box<dyn BufRead>,
    name: &str,
    out: &mut impl Write,
) -> Result<u64, CommandError> {
    let mut states = States::new(input, layout);
    let mut line = Vec::new();
    let mut index = 0;
    while let Some(state) = states.next_state().map_err(file_error(name))? {
        let values = evaluate(model, &state).and_then(|mut values| {
            resolve_capture(model, &state, &mut values)?;
            Ok(values)
        });
        let values = values.map_err(file_error(&format!("{name}: line {}: state {index}", states.line())))?;
        line.clear();
        line.extend_from_slice(if index == 0 { b"[\n" } else { b",\n" });
        serde_json::to_writer(&mut line, &result_to_json(&values, &state.targets)).map_err(io::Error::from)?;
        out.write_all(&line)?;
        index += 1;
    }
    Ok(index)
}
