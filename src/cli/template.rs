//! `planar-capture template layout|scenario|sweep`: prints a file to start from.

use super::CommandError;
use super::out_file::{Force, write_new};
use crate::file_format::FileFormat;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture template scenario --out mine.toml";

/// Print a commented layout, scenario or sweep to start from.
///
/// It has every key, and is valid as it stands.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The kind of file.
    #[arg(value_name = "KIND")]
    kind: FileFormat,
    /// Where to write it [default: the standard output].
    #[arg(long, value_name = "FILE.toml")]
    out: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
}

/// Prints the template.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    write_new(arguments.out.as_deref(), &arguments.force, &arguments.kind.template())?;
    Ok(ExitCode::SUCCESS)
}
