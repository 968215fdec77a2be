//! `planar-capture derive LAYOUT.toml`: derives a layout into the user's cache folder.

use super::progress::spinner;
use super::terminal::{note, print};
use super::{CommandError, file_error, layout};
use crate::generate::{self, GenerateError, Proof, Proved};
use crate::graphs::{cache_path, keep};
use crate::layout::Layout;
use crate::python_package::PYTHON_PACKAGE;
use crate::registry::Robots;
use indicatif::ProgressBar;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture derive mine.toml";

/// Derive the equations of a layout into your cache folder.
///
/// There `run`, `eval` and `compare` find them. They serve every layout of the same arms, links and exact zeros. The first run makes a Python environment with CasADi
/// in the same folder (Python 3.11 or newer, network); later ones use it. The derived functions are compared with the
/// generic implementation before they are kept.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The layout: a path, or the name of a shipped one.
    layout: String,
    /// Show no progress.
    #[arg(short, long)]
    quiet: bool,
}

/// Derives the graph, proves it, and keeps it.
pub fn run(arguments: &Arguments, robots: Robots<'_>) -> Result<ExitCode, CommandError> {
    let layout = layout::read(&arguments.layout, robots)?;
    let (path, proof) = into_cache(&layout, &arguments.layout, arguments.quiet)?;
    print(&format!(
        "{}: the graph of {}, {} degrees of freedom\n{proof}\n",
        path.display(),
        layout.name,
        layout.joints() + 3
    ));
    Ok(ExitCode::SUCCESS)
}

/// Derives the graph of a layout, which is in `file`, and keeps it in the user's cache folder.
pub fn into_cache(layout: &Layout, file: &str, quiet: bool) -> Result<(PathBuf, Proof), CommandError> {
    let path = cache_path(layout).map_err(file_error(file))?;
    let progress = (!quiet).then(|| spinner("starting Python"));
    let Proved { text, proof, .. } = proved(layout, &[], file, progress.as_ref())?;
    progress.inspect(ProgressBar::finish_and_clear);
    keep(&path, &text)?;
    Ok((path, proof))
}

/// Derives the graph of a layout, which is in `file`, and proves it; without a spinner silently.
pub fn proved(
    layout: &Layout,
    options: &[String],
    file: &str,
    progress: Option<&ProgressBar>,
) -> Result<Proved, CommandError> {
    let mut show = |line: &str| progress.into_iter().for_each(|progress| show(progress, line));
    let text = generate::derive(layout, options, PYTHON_PACKAGE, &mut show);
    let text = text.map_err(file_error(file))?;
    if let Some(progress) = progress {
        progress.set_message("comparing with the generic implementation");
    }
    generate::complete(&text, layout).map_err(|source| {
        let exit_code = if matches!(source, GenerateError::Disagreement { .. }) { 1 } else { 2 };
        CommandError::File { file: file.to_owned(), source: source.into(), exit_code }
    })
}

/// Shows a line of the derivation's output; without a terminal only those about the environment, which takes minutes.
fn show(progress: &ProgressBar, line: &str) {
    if !progress.is_hidden() {
        progress.set_message(line.to_owned());
    } else if line.contains("environment") {
        note(line);
    }
}
