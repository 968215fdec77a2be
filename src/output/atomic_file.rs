//! Files that are whole or not there: written under a temporary name beside their place, then renamed.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// A result that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {path}: {source}; nothing half-written was left there", path = path.display())]
pub struct OutputError {
    /// Where it should have gone.
    pub path: PathBuf,
    /// Why not.
    #[source]
    pub source: io::Error,
}

/// Makes a folder for results, with the folders above it.
///
/// # Errors
/// [`OutputError`] with the reason.
pub fn make_folder(path: &Path) -> Result<(), OutputError> {
    fs::create_dir_all(path).map_err(|source| OutputError { path: path.to_owned(), source })
}

/// A file that is written but does not stand in its place yet; dropped, it is gone.
#[derive(Debug)]
pub struct Staged {
    path: PathBuf,
    file: tempfile::NamedTempFile,
}

impl Staged {
    /// Writes what is to stand at `path`, under a temporary name beside it.
    ///
    /// # Errors
    /// [`OutputError`] with the reason: no permission, a full disk, a folder in that place.
    pub fn new(path: &Path, write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>) -> Result<Self, OutputError> {
        let attempt = || -> io::Result<tempfile::NamedTempFile> {
            if path.is_dir() {
                return Err(io::ErrorKind::IsADirectory.into());
            }
            let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
            let mut builder = tempfile::Builder::new();
            builder.prefix(".planar-capture-");
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
            let file = builder.tempfile_in(folder)?;
            let mut writer = BufWriter::new(file.as_file());
            write(&mut writer)?;
            writer.flush()?;
            drop(writer);
            file.as_file().sync_all()?;
            Ok(file)
        };
        let failed = |source| OutputError { path: path.to_owned(), source };
        Ok(Self { path: path.to_owned(), file: attempt().map_err(failed)? })
    }

    /// Puts it in its place.
    ///
    /// # Errors
    /// [`OutputError`] with the reason; what was there is then as it was.
    pub fn commit(self) -> Result<(), OutputError> {
        let Self { path, file } = self;
        file.persist(&path).map(drop).map_err(|e| OutputError { path, source: e.error })
    }
}

/// Writes `path` whole, or leaves what is there as it is.
///
/// # Errors
/// [`OutputError`] with the reason.
pub fn write_whole(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    Staged::new(path, write)?.commit()
}
