//! The file that a command writes, where an argument names one: looked at before anything is computed for it.

use super::{CommandError, print_product};
use crate::output::atomic_file::write_text;
use std::path::{Path, PathBuf};

/// Whether the file may be there already.
#[derive(Debug, clap::Args)]
pub struct Force {
    /// Replace the file.
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

/// Refuses a file that exists, and is not to be replaced, what is there and is no file, and a path that has no folder to be
/// in.
pub fn check_new(path: Option<&Path>, Force { force }: &Force) -> Result<(), CommandError> {
    let Some(path) = path else { return Ok(()) };
    let file = path.display();
    let problem = match path.metadata() {
        Ok(found) if !found.is_file() => format!("{file} is a folder, a device or a pipe: choose another file"),
        Ok(_) if !force => format!("{file} already exists: choose another file, or replace it with --force"),
        _ => return check_folder(path),
    };
    Err(CommandError::Usage(problem))
}

/// Refuses a file whose folder is not there, and the path of a folder.
pub fn check_folder(path: &Path) -> Result<(), CommandError> {
    if path.as_os_str().to_string_lossy().ends_with(std::path::is_separator) {
        let message = format!("cannot write {}: it ends as the path of a folder does", path.display());
        return Err(CommandError::Usage(message));
    }
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
        // through a link: the file that it names is replaced, not the link
        Some(path) => Ok(write_text(&path.canonicalize().unwrap_or_else(|_| path.to_owned()), text)?),
        None => print_product(text),
    }
}
