//! Files of folders that others may have put something else into: a pipe has no end, and nobody waits for one.

use std::fs;
use std::io;
use std::path::Path;

/// Reads a file, also through a link; whatever is no regular file is [`io::ErrorKind::InvalidInput`], and is not opened.
pub(crate) fn read(path: &Path) -> io::Result<Vec<u8>> {
    check(path)?;
    fs::read(path)
}

/// That a path is that of a regular file.
pub(crate) fn check(path: &Path) -> io::Result<()> {
    if fs::metadata(path)?.is_file() {
        return Ok(());
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, "it is not a regular file"))
}
