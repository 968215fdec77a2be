//! `planar-capture reproduce --out FOLDER`: the paper's tables and figures from simulations.

use super::CommandError;
use super::progress::Display;
use std::path::PathBuf;
use std::process::ExitCode;

const EXAMPLES: &str = "\
Examples:
  planar-capture reproduce --out docs";

/// Write the report on the reproduction of the paper.
///
/// It has the paper's tables and figures beside the computed ones. Writes FOLDER/reproduction.md and the figures it shows; needs a build with the feature `figures`.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Folder of the report.
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Write nothing; exit code 1 if the report is not up to date.
    #[arg(long)]
    check: bool,
    #[command(flatten)]
    display: Display,
}

/// Names the missing feature.
#[cfg(not(feature = "figures"))]
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    use super::optional_outputs::{FIGURES, require};
    let Arguments { out: _, check: _, display: _ } = arguments;
    require(&[FIGURES]).map(|()| ExitCode::SUCCESS)
}

/// Computes the report, then writes it or compares it with the files.
#[cfg(feature = "figures")]
pub fn run(arguments: &Arguments) -> Result<ExitCode, CommandError> {
    use super::progress::Progress;
    use super::terminal::{note, print};
    use crate::output::atomic_file::{StagedFile, create_folder};
    use crate::output::result_folder::ResultFolder;
    use crate::reproduction::reproduce;
    use std::io::Write;

    if !arguments.check {
        // among other documents
        ResultFolder::claim(&arguments.out, false, &[], &|_, _| None)?;
    }
    let mut progress = Progress::new(arguments.display);
    let result = reproduce(&mut progress);
    progress.finish();
    let files = result.map_err(|error| CommandError::Figures(error.into()))?.files;
    let (out, shown) = (&arguments.out, arguments.out.display());
    if arguments.check {
        let stale =
            |(path, text): &&(String, String)| std::fs::read_to_string(out.join(path)).ok().as_ref() != Some(text);
        let Some((path, _)) = files.iter().find(stale) else {
            print(&format!("{shown}: fresh\n"));
            return Ok(ExitCode::SUCCESS);
        };
        note(format_args!(
            "{} is not what is computed; to mend: cargo run --release --features figures -- reproduce --out {shown}",
            out.join(path).display()
        ));
        return Ok(ExitCode::from(1));
    }
    let mut staged = Vec::new();
    for (path, text) in &files {
        let path = out.join(path);
        if let Some(folder) = path.parent() {
            create_folder(folder)?;
        }
        staged.push(StagedFile::new(&path, |to| to.write_all(text.as_bytes()))?);
    }
    staged.into_iter().try_for_each(StagedFile::commit)?;
    print(&format!("{}: {} figures\n", out.join("reproduction.md").display(), files.len() - 1));
    Ok(ExitCode::SUCCESS)
}
