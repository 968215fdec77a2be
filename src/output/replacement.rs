//! The replacement of what is in a folder by something else: whenever the process is killed, one of the two can be had
//! whole.
//!
//! The new content is written to `new` in a temporary folder, which is in the folder itself where that exists. A process
//! holds its temporary folder while it lives. Then, with the folder locked:
//!
//! 1. everything in the folder goes to `old` in the temporary folder; first the file that says that it is complete,
//! 2. `old` becomes `replaced`,
//! 3. everything in `new` goes to the folder; last the file that says that it is complete,
//! 4. the temporary folder is removed.
//!
//! Until then each operation is the renaming of one file or folder, so that at any time
//!
//! - while there is `old`, the old content is what is in the folder and in `old` together;
//! - while there is `replaced`, the new content is what is in the folder and in `new` together.
//!
//! An operation that fails is followed by the inverse ones of those before it, by which both stay true. Whoever finds the
//! temporary folder of a dead process [settles](settle) it, with the folder locked, before anything is decided about the
//! folder: what is in `old` goes back, and after the second step what is in `new` goes on. That may be killed too: both
//! stay true, and the next one goes on with it. Nothing is removed before `old`, or `new` beside `replaced`, is empty;
//! then there is nothing to be moved any more, whatever is removed first.
//!
//! Without locks a dead process cannot be told from a living one, and nothing is settled: the content that is not in the
//! folder then stays in the temporary folder.

use super::output_error::OutputError;
use super::run_folder::SUMMARY;
use super::temporary::names;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// In a temporary folder: the content to come, the one that goes, and the same once all of it is there.
pub(super) const NEW: &str = "new";
const OLD: &str = "old";
const REPLACED: &str = "replaced";

/// Renames a file or a folder.
type Rename<'a> = &'a mut dyn FnMut(&Path, &Path) -> io::Result<()>;

/// Replaces the content of a folder by that of `new` in a temporary folder in it. The file `last` goes first and comes
/// last: while it is absent, the folder is not complete.
pub(super) fn replace(folder: &Path, temporary: &Path, last: &str, rename: Rename<'_>) -> Result<(), OutputError> {
    let [new, old, replaced] = [NEW, OLD, REPLACED].map(|name| temporary.join(name));
    fs::create_dir(&old).map_err(OutputError::at(folder))?;
    let (mut going, mut coming) = (names(folder)?, names(&new)?);
    going.sort_by_key(|name| name != last);
    coming.sort_by_key(|name| name == last);
    let away = going.iter().map(|name| (folder.join(name), old.join(name)));
    let into = coming.iter().map(|name| (new.join(name), folder.join(name)));
    let moves: Vec<_> = away.chain([(old.clone(), replaced)]).chain(into).collect();
    for (i, (from, to)) in moves.iter().enumerate() {
        if let Err(source) = rename(from, to) {
            // one that fails too is left to be settled
            let _ = moves[..i].iter().rev().try_for_each(|(from, to)| rename(to, from));
            return Err(OutputError { path: from.clone(), source });
        }
    }
    Ok(())
}

/// Where what is still to be moved to the folder is.
fn waiting(temporary: &Path) -> PathBuf {
    temporary.join(if temporary.join(REPLACED).exists() { NEW } else { OLD })
}

/// Whether everything is in the folder, so that the temporary one can be removed.
pub(super) fn is_settled(temporary: &Path) -> bool {
    fs::read_dir(waiting(temporary))
        .map_or_else(|e| e.kind() == io::ErrorKind::NotFound, |mut all| all.next().is_none())
}

/// Ends or undoes a replacement that was left unfinished.
pub(super) fn settle(folder: &Path, temporary: &Path, rename: Rename<'_>) -> Result<(), OutputError> {
    if is_settled(temporary) {
        return Ok(());
    }
    let waiting = waiting(temporary);
    let mut names = names(&waiting)?;
    names.sort_by_key(|name| name == SUMMARY);
    for name in names {
        let to = folder.join(&name);
        // somebody's own: no run has put it there
        if to.symlink_metadata().is_ok() {
            return Err(OutputError { path: to, source: io::ErrorKind::AlreadyExists.into() });
        }
        rename(&waiting.join(name), &to).map_err(OutputError::at(&to))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
