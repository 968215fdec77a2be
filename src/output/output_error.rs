//! Why results could not be written.
//!
//! # Example
//! ```
//! use planar_capture::output::atomic_file::write_text;
//! use std::io::ErrorKind;
//!
//! let folder = tempfile::tempdir()?;
//! let error = write_text(folder.path(), "time [s]").expect_err("a folder is not a file");
//! assert_eq!(error.path, folder.path());
//! assert_eq!(error.source.kind(), ErrorKind::IsADirectory);
//! # Ok::<(), std::io::Error>(())
//! ```

use std::io;
use std::path::{Path, PathBuf};

/// A result that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {path}: {source}; nothing half-written was left there", path = path.display())]
pub struct OutputError {
    /// The file or folder.
    pub path: PathBuf,
    /// The reason.
    #[source]
    pub source: io::Error,
}

impl OutputError {
    /// For results of a function about `path`.
    pub(crate) fn at(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |source| Self { path: path.to_owned(), source }
    }
}
