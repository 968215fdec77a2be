//! `planar-capture check FILE.toml`: describes a layout or scenario and warns of unlikely numbers.

use super::terminal::{note, print};
use super::{CommandError, color, layout};
use crate::check::inspect_with;
use crate::registry::Robots;
use std::path::Path;
use std::process::ExitCode;

/// Describe a layout or a scenario, and warn of unusual values.
///
/// The description goes to the standard output, warnings and errors to the standard error. Exit code 2 for errors,
/// else 0.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The file, a layout or a scenario; or the name of a shipped layout.
    #[arg(value_name = "FILE")]
    file: String,
}

/// Prints the description and the warnings.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let (text, file) = layout::source(&arguments.file, robots)?;
    let folder = Path::new(&arguments.file).parent().unwrap_or(Path::new(""));
    let inspection = inspect_with(&text, &file, folder, &robots.layouts(), robots)?;
    let warnings = inspection.warnings;
    let count = warnings.count();
    print(&format!("{}\n{}", inspection.description, if count == 0 { "no warnings\n" } else { "" }));
    if count > 0 {
        let noun = if count == 1 { "warning" } else { "warnings" };
        note(format_args!("{}\n\n{count} {noun}", warnings.render(color())));
    }
    Ok(ExitCode::SUCCESS)
}
