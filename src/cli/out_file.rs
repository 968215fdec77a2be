//! The file that a command writes, where an argument names one: looked at before anything is computed for it.

use super::{CommandError, print_product};
use crate::output::atomic_file::write_text;
use std::path::{Path, PathBuf};

/// Whether the file may be there already.
#[derive(Debug, clap::Args)]
pub struct Force {
    /// Replace the file, whatever it is.
    #[arg(long, requires = "out")]
    force: bool,
}

/// The path of a picture as an argument: one that ends like another kind of file is not what is written.
pub fn svg(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    if path.extension().is_none_or(|extension| extension.eq_ignore_ascii_case("svg")) {
        Ok(path)
    } else {
        Err("the picture is SVG, expected a file that ends in `.svg`".to_owned())
    }
}

/// Refuses a file that exists, and is not to be replaced, and one that has no folder to be in.
pub fn check_new(path: Option<&Path>, Force { force }: &Force) -> Result<(), CommandError> {
    let Some(path) = path else { return Ok(()) };
    if path.exists() && !force {
        let file = path.display();
        let message = format!("{file} already exists: choose another file, or replace it with --force");
        return Err(CommandError::Usage(message));
    }
    check_folder(path)
}

/// Refuses a file whose folder is not there.
pub fn check_folder(path: &Path) -> Result<(), CommandError> {
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => {
            let (file, folder) = (path.display(), folder.display());
            Err(CommandError::Usage(format!("cannot write {file}: there is no folder {folder}; make it first")))
        }
        None => Ok(()),
    }
}

/// Writes a text to a file, a new one without `--force`, or to the standard output without a path.
pub fn write_new(path: Option<&Path>, force: &Force, text: &str) -> Result<(), CommandError> {
    check_new(path, force)?;
    match path {
        Some(path) => Ok(write_text(path, text)?),
        None => print_product(text),
    }
}
