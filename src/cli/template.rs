//! `planar-capture template layout|scenario|sweep`: prints a file to start from.

use super::{CommandError, write_new};
use crate::file_format::FileFormat;
use std::path::PathBuf;
use std::process::ExitCode;

/// Print a commented layout, scenario or sweep to start from, with every key; it is valid as it stands.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The kind of file.
    #[arg(value_name = "KIND")]
    kind: FileFormat,
    /// Where to write it [default: the standard output].
    #[arg(long, value_name = "FILE.toml")]
    out: Option<PathBuf>,
}

/// Prints the template.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    write_new(arguments.out.as_deref(), &arguments.kind.template())?;
    Ok(ExitCode::SUCCESS)
}
