//! The removal of temporary files and folders that killed processes left behind. Where there are no locks by which to
//! tell a dead process from a living one, nothing is removed.

use super::replacement::{is_settled, settle};
use super::temporary::{is_temporary, lock};
use std::fs::{self, File};
use std::path::Path;

/// Settles and removes the temporary files and folders in a folder that no living process holds.
pub(super) fn sweep(folder: &Path) {
    let mut entries = fs::read_dir(folder).into_iter().flatten().flatten();
    if entries.any(|entry| entry.file_name().to_str().is_some_and(is_temporary)) {
        let _lock = lock(folder);
        sweep_locked(folder);
    }
}

/// The same for a folder whose [`lock`] the process has.
pub(super) fn sweep_locked(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        if !entry.file_name().to_str().is_some_and(is_temporary) {
            continue;
        }
        let path = entry.path();
        let Ok(kind) = entry.file_type() else { continue };
        // a device or a pipe of this name is not opened
        if !kind.is_file() && !kind.is_dir() {
            continue;
        }
        // held until it is gone: its owner, if it is just being made, cannot be mistaken for dead
        let Some(_lock) = File::open(&path).ok().filter(|file| file.try_lock().is_ok()) else { continue };
        if kind.is_file() {
            let _ = fs::remove_file(&path);
        } else if settle(folder, &path, &mut |from, to| fs::rename(from, to)).is_ok() && is_settled(&path) {
            let _ = fs::remove_dir_all(&path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::temporary::folder_in;
    use tempfile::TempDir;

    /// Content that is still to be moved is moved, or stays where it is while somebody's own is in its place.
    #[test]
    fn nothing_is_removed_before_it_is_settled() {
        let folder = TempDir::new().expect("a folder");
        let mut left = folder_in(folder.path()).expect("a temporary folder");
        left.folder.disable_cleanup(true);
        let killed = left.folder.path().to_owned();
        let (away, place) = (killed.join("old").join("a.csv"), folder.path().join("a.csv"));
        fs::create_dir(killed.join("old")).expect("a folder");
        fs::write(&away, "old").expect("written");
        fs::write(&place, "mine").expect("written");
        sweep(folder.path());
        assert!(away.exists(), "its process lives");
        drop(left);
        sweep(folder.path());
        assert!(away.exists(), "its place is taken");
        fs::remove_file(&place).expect("removed");
        sweep(folder.path());
        assert_eq!((fs::read_to_string(place).expect("moved back"), killed.exists()), ("old".to_owned(), false));
    }
}
