//! Temporary files and folders. A process holds a lock on each of its own while it lives, which the operating system
//! releases when it dies.

use super::output_error::OutputError;
use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use tempfile::{NamedTempFile, TempDir};

/// The names of all temporary files: this, then letters and digits.
const PREFIX: &str = ".planar-capture-";
/// Number of these random letters and digits: no name that people choose.
const RANDOM: usize = 24;

/// A temporary folder, removed with its content when it is dropped.
#[derive(Debug)]
pub(super) struct TemporaryFolder {
    pub(super) folder: TempDir,
    _lock: Option<File>,
}

/// A temporary file in a folder, with the permissions of an ordinary one.
pub(super) fn file_in(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
    loop {
        let file = builder.tempfile_in(folder).map_err(without_name)?;
        if hold(file.as_file(), file.path()) {
            return Ok(file);
        }
    }
}

/// A temporary folder in a folder, with the permissions of an ordinary one (less the process's mask).
pub(super) fn folder_in(folder: &Path) -> io::Result<TemporaryFolder> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).rand_bytes(RANDOM);
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o777));
    loop {
        let folder = builder.tempdir_in(folder).map_err(without_name)?;
        #[cfg(unix)]
        match check_mask(folder.path()) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue, // as below
            checked => checked?,
        }
        let lock = match File::open(folder.path()) {
            Ok(lock) => Some(lock),
            // another process has taken it for a dead one's
            Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
            // a system that opens no folders
            Err(_) => None,
        };
        if lock.as_ref().is_none_or(|lock| hold(lock, folder.path())) {
            return Ok(TemporaryFolder { folder, _lock: lock });
        }
    }
}

/// The error without the temporary name, which no user has chosen: who reports it names the file that was to be written.
fn without_name(error: io::Error) -> io::Error {
    match error.to_string().rsplit_once(" at path ") {
        Some((reason, _)) => io::Error::new(error.kind(), reason),
        None => error,
    }
}

/// Removes a folder again that the process's mask has taken from its owner: nothing can be put there, and nobody else may
/// look whether it is empty.
#[cfg(unix)]
fn check_mask(folder: &Path) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    const OWNER: u32 = 0o700;
    if fs::metadata(folder)?.permissions().mode() & OWNER == OWNER {
        return Ok(());
    }
    fs::remove_dir(folder)?;
    let why = "the process's mask takes the rights of new folders from their owner: `umask 022` is the usual one";
    Err(io::Error::new(io::ErrorKind::PermissionDenied, why))
}

/// Locks a file that was just made; whether it is still there: another process may have taken it for a dead one's
/// before it was locked.
fn hold(file: &File, path: &Path) -> bool {
    match file.try_lock() {
        Ok(()) => path.exists(),
        Err(TryLockError::WouldBlock) => false,
        // a file system without locks: others remove nothing
        Err(TryLockError::Error(_)) => true,
    }
}

/// Whether a file of this name is one of them.
pub(super) fn is_temporary(name: &str) -> bool {
    let random = name.strip_prefix(PREFIX);
    random.is_some_and(|random| random.len() == RANDOM && random.chars().all(|c| c.is_ascii_alphanumeric()))
}

/// The sorted names in a folder, without temporary ones.
pub(super) fn names(folder: &Path) -> Result<Vec<OsString>, OutputError> {
    let read = || fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name())).collect::<io::Result<Vec<_>>>();
    let mut names = read().map_err(OutputError::at(folder))?;
    names.retain(|name| !name.to_str().is_some_and(is_temporary));
    names.sort();
    Ok(names)
}

/// Waits for the lock on a folder, of which there is no file; `None` where there are no locks.
pub(super) fn lock(folder: &Path) -> Option<File> {
    File::open(folder).ok().filter(|folder| folder.lock().is_ok())
}
