//! `planar-capture schema layout|scenario|sweep`: prints a JSON Schema.

use super::{CommandError, write_new};
use crate::file_format::FileFormat;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture schema scenario --out scenario.json";

/// Print the JSON Schema of layouts or scenarios for editors.
///
/// By it they complete keys and complain of wrong ones.
///
/// Editors with Taplo, as VS Code with "Even Better TOML", use it for a file that starts with the line
/// `#:schema ./scenario.json`, the path of the schema.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The kind of file.
    #[arg(value_name = "KIND")]
    kind: FileFormat,
    /// Where to write it [default: the standard output].
    #[arg(long, value_name = "FILE.json")]
    out: Option<PathBuf>,
}

/// Prints the schema.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    write_new(arguments.out.as_deref(), &arguments.kind.schema())?;
    Ok(ExitCode::SUCCESS)
}
