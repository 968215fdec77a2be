//! `planar-capture check FILE.toml`: describes a layout, scenario or sweep and warns of unlikely numbers.

use super::terminal::{note, print};
use super::{CommandError, color, layout};
use crate::check::inspect_with;
use crate::program::Program;
use std::path::Path;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture check scenarios/raina_shah_2017.toml
  planar-capture check dual_arm_3r";

/// Describe a layout, a scenario or a sweep, and warn of unusual values.
///
/// The description goes to the standard output, warnings and errors to the standard error. Exit code 2 for errors,
/// else 0.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The file, a layout, a scenario or a sweep; or the name of a shipped layout.
    #[arg(value_name = "FILE")]
    file: String,
}

/// Prints the description and the warnings.
pub fn run(arguments: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    let (text, file) = layout::source(&arguments.file, program.robots)?;
    let folder = Path::new(&arguments.file).parent().unwrap_or(Path::new(""));
    let inspection = inspect_with(&text, &file, folder, program.known(), program.robots)?;
    let warnings = inspection.warnings;
    let count = warnings.count();
    let none = if count == 0 && inspection.refusal.is_none() { "no warnings\n" } else { "" };
    print(&format!("{}\n{none}", inspection.description));
    if count > 0 {
        let noun = if count == 1 { "warning" } else { "warnings" };
        note(format_args!("{}\n\n{count} {noun}", warnings.render(color())));
    }
    // `run` would say the same
    inspection.refusal.map_or(Ok(ExitCode::SUCCESS), |refusal| Err(refusal.into()))
}
