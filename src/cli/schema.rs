//! `planar-capture schema layout|scenario|sweep`: prints a JSON Schema.

use super::CommandError;
use super::out_file::{Force, write_new};
use crate::file_format::FileFormat;
use crate::program::Program;
use serde_json::Value;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture schema scenario --out scenario.json";

/// Print the JSON Schema of layouts, scenarios or sweeps for editors.
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
    #[command(flatten)]
    force: Force,
}

/// Prints the schema.
pub fn run(arguments: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    let mut text = arguments.kind.schema();
    if let (FileFormat::Scenario, [_, ..]) = (arguments.kind, program.laws) {
        let mut schema: Value = serde_json::from_str(&text).map_err(std::io::Error::from)?;
        let laws = program.law_formats();
        for (phase, key, own) in
            [("approach", "tracking", laws.tracking), ("post_impact", "control", laws.post_capture)]
        {
            let choice = &mut schema["properties"][phase]["properties"][key];
            for (path, word) in [("/enum", 0), ("/x-taplo/docs/enumValues", 1)] {
                if let Some(Value::Array(words)) = choice.pointer_mut(path) {
                    words.extend(own.iter().map(|law| [law.name, law.doc][word].into()));
                }
            }
        }
        text = format!("{schema:#}\n");
    }
    write_new(arguments.out.as_deref(), &arguments.force, &text)?;
    Ok(ExitCode::SUCCESS)
}
