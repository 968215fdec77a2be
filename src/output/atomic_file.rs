//! Result files that are complete or absent: written under a temporary name in the same folder, then renamed.
//!
//! # Example
//! ```
//! use planar_capture::output::atomic_file::StagedFile;
//! use std::io::Write;
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("results.csv");
//! let staged = StagedFile::new(&path, |to| to.write_all(b"time [s]\n0.0\n"))?;
//! assert!(!path.exists()); // nothing half-written has this name
//! staged.commit()?;
//! assert_eq!(std::fs::read(&path)?, b"time [s]\n0.0\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::output_error::OutputError;
use super::sweep::{sweep, sweep_locked};
use super::temporary;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Bytes that are written at once: time series have megabytes.
const BUFFER: usize = 1 << 16;

/// Creates a folder for results and its parents; removes what a killed process left in it.
///
/// # Errors
/// [`OutputError`] with the reason.
pub fn create_folder(path: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(path).map_err(OutputError::at(path))?;
    sweep(path);
    Ok(())
}

/// Waits until no other process changes a folder, then removes what killed ones left in it; others wait while this lives.
/// Where there are no locks nobody waits.
pub(crate) fn lock_folder(path: &Path) -> Option<File> {
    let lock = temporary::lock(path);
    sweep_locked(path);
    lock
}

/// A complete file under a temporary name. [`commit`](Self::commit) gives it its own; dropping deletes it.
#[derive(Debug)]
pub struct StagedFile {
    path: PathBuf,
    file: tempfile::NamedTempFile,
}

impl StagedFile {
    /// Writes the content of `path` to a temporary file in the same folder.
    ///
    /// # Errors
    /// [`OutputError`] with the reason: no permission, a full disk, a folder at `path`.
    pub fn new(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<Self, OutputError> {
        let attempt = || -> io::Result<tempfile::NamedTempFile> {
            if path.is_dir() {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            let file = temporary::file_in(folder_of(path))?;
            write_whole(file.as_file(), write)?;
            Ok(file)
        };
        let file = attempt().map_err(OutputError::at(path))?;
        Ok(Self { path: path.to_owned(), file })
    }

    /// Renames the temporary file to `path`.
    ///
    /// # Errors
    /// [`OutputError`] with the reason; an earlier file at `path` is then unchanged.
    pub fn commit(self) -> Result<(), OutputError> {
        let Self { path, file } = self;
        file.persist(&path).map(drop).map_err(|e| OutputError { path, source: e.error })
    }

    /// Renames the temporary file to `path` unless there is one; whether there was none. On a file system that cannot do both
    /// at once it looks first.
    ///
    /// # Errors
    /// [`OutputError`] with the reason.
    #[cfg(feature = "sweep")]
    pub(crate) fn commit_new(self) -> Result<bool, OutputError> {
        let Self { path, file } = self;
        match file.persist_noclobber(&path) {
            Ok(_) => Ok(true),
            Err(_) if path.symlink_metadata().is_ok() => Ok(false),
            Err(failed) => Self { path, file: failed.file }.commit().map(|()| true),
        }
    }
}

/// Writes a file's content to the disk.
pub(super) fn write_whole(file: &File, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> io::Result<()> {
    let mut writer = BufWriter::with_capacity(BUFFER, file);
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    file.sync_all()
}

/// The folder of a file.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Writes files that belong together, all or none; removes what a killed process left in their folders.
///
/// # Errors
/// [`OutputError`] with the reason; where a file cannot be written, those that were there are unchanged.
pub fn write_together<'a>(files: impl IntoIterator<Item = (&'a Path, &'a [u8])>) -> Result<(), OutputError> {
    let stage = |(path, bytes): (&Path, &[u8])| {
        sweep(folder_of(path));
        StagedFile::new(path, |to| to.write_all(bytes))
    };
    let staged = files.into_iter().map(stage).collect::<Result<Vec<_>, _>>()?;
    staged.into_iter().try_for_each(StagedFile::commit)
}

/// Writes `text` to `path`, completely or not at all; removes what a killed process left in the same folder.
///
/// # Errors
/// [`OutputError`] with the reason; an earlier file at `path` is then unchanged.
pub fn write_text(path: &Path, text: &str) -> Result<(), OutputError> {
    write_together([(path, text.as_bytes())])
}

#[cfg(test)]
mod tests {
    use super::write_together;
    use std::fs;

    #[test]
    fn files_that_belong_together_are_all_written_or_none() {
        let folder = tempfile::TempDir::new().expect("a folder");
        let [source, header] = ["robot.c", "robot.h"].map(|name| folder.path().join(name));
        fs::write(&source, "old").expect("written");
        fs::create_dir(&header).expect("a folder in its place");
        let files = || [(source.as_path(), &b"new"[..]), (header.as_path(), b"new")];
        assert_eq!(write_together(files()).expect_err("a folder").path, header);
        assert_eq!(fs::read_to_string(&source).expect("a file"), "old");
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2, "no temporary file is left");
        fs::remove_dir(&header).expect("removed");
        write_together(files()).expect("written");
        assert_eq!([&source, &header].map(|path| fs::read_to_string(path).expect("a file")), ["new", "new"]);
    }
}
