//! A text as the result of a command.

use super::Problem;
use planar_capture::output::atomic_file::write_whole;
use std::io::Write;
use std::path::Path;

/// Writes it to a file, whole, or to the standard output. A file that is there already stays as it is.
pub fn write(path: Option<&Path>, text: &str) -> Result<(), Problem> {
    match path {
        Some(path) if path.exists() => return Err(Problem::Exists { file: path.display().to_string() }),
        Some(path) => write_whole(path, |to| to.write_all(text.as_bytes()))?,
        None => std::io::stdout().lock().write_all(text.as_bytes())?,
    }
    Ok(())
}
