//! A folder of results, which holds those of one run: claimed before the run, and filled or replaced whole after it.
//!
//! # Example
//! ```
//! use planar_capture::output::result_folder::{ClaimError, ResultFolder};
//! use std::io::Write;
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("run");
//! let foreign = |_: &std::path::Path, names: &[String]| Some(format!("has `{}`", names[0]));
//! let results = ResultFolder::claim(&path, false, &[], &foreign)?;
//! let staged = results.stage()?;
//! staged.write("summary.json", |to| to.write_all(b"{}"))?;
//! assert!(!path.exists());
//! results.commit(staged, "summary.json")?;
//! assert_eq!(std::fs::read(path.join("summary.json"))?, b"{}");
//! let again = ResultFolder::claim(&path, false, &[], &foreign);
//! assert!(matches!(again, Err(ClaimError::Occupied { found, .. }) if found == "has `summary.json`"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::atomic_file::{create_folder, lock_folder, write_whole};
use super::output_error::OutputError;
use super::replacement::{NEW, is_settled, replace};
use super::run_folder::{FIGURES, scenario_in};
use super::sweep::sweep;
use super::temporary::{self, TemporaryFolder, names};
use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

/// Why a folder is not to be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ClaimError {
    /// A file, a device, or something below one.
    #[error("{path} is not a folder, expected a folder for results", path = .0.display())]
    NotAFolder(PathBuf),
    /// Its content is not what this run may replace.
    #[error(
        "{path} {found}, and a folder holds one run: choose another folder, or replace the files in it with --force",
        path = path.display()
    )]
    Occupied {
        /// The folder.
        path: PathBuf,
        /// What is in it, as a predicate.
        found: String,
    },
    /// Its content is not what any run may replace, with `--force` neither.
    #[error("{path} {found}: choose another folder, or a new one in it, such as --out {inner}",
        path = path.display(), inner = path.join("new").display())]
    Shared {
        /// The folder.
        path: PathBuf,
        /// What is in it, as a predicate.
        found: String,
    },
    /// It is inside the folder of a run, which could not be replaced any more.
    #[error(
        "{path} is inside {outer}, which holds the results of `{scenario}`, and a folder holds one run: choose another folder",
        path = path.display(), outer = outer.display()
    )]
    Inside {
        /// The folder.
        path: PathBuf,
        /// That of the run.
        outer: PathBuf,
        /// Whose results are in it.
        scenario: String,
    },
    /// It has what `--force` is not to delete.
    #[error("{}: choose another folder", protection(path, kept))]
    Protected {
        /// The folder.
        path: PathBuf,
        /// The working folder, the user's own, an input of the run, or what no run writes.
        kept: PathBuf,
    },
    /// Another run has filled it since it was claimed.
    #[error(
        "{path} {found}: another run was there first; the results of this one are complete but not written: \
         run it again into another folder",
        path = path.display()
    )]
    Lost {
        /// The folder.
        path: PathBuf,
        /// What is in it, as a predicate.
        found: String,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    Unusable(#[from] OutputError),
}

/// A folder that a run may fill.
pub struct ResultFolder<'a> {
    path: PathBuf,
    force: bool,
    keep: Vec<PathBuf>,
    objection: Objection<'a>,
}

/// Decides whether the content of a folder, its path and sorted names, may be replaced: what is wrong with it as a
/// predicate ("holds …"), or `None`.
pub type Objection<'a> = &'a dyn Fn(&Path, &[String]) -> Option<String>;

impl fmt::Debug for ResultFolder<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ResultFolder").field("path", &self.path).field("force", &self.force).finish_non_exhaustive()
    }
}

impl<'a> ResultFolder<'a> {
    /// Claims a folder that is absent or empty, or to whose content there is no `objection`; with `force` any folder of
    /// files, and figures, that contains neither the working folder, nor the user's own, nor one of the files in `keep`.
    /// What killed runs left there is ended or undone, and removed, first.
    ///
    /// # Errors
    /// [`ClaimError`].
    pub fn claim(path: &Path, force: bool, keep: &[&Path], objection: Objection<'a>) -> Result<Self, ClaimError> {
        let keep = keep.iter().copied().map(Path::to_owned).collect();
        let claimed = Self { path: path.to_owned(), force, keep, objection };
        let existing = existing_folder(path)?;
        if existing == path {
            // not in the moment in which another run puts its files in their place
            let _lock = lock_folder(path);
            claimed.permit()?;
        } else {
            // a folder above it, in which results are staged until it is made
            sweep(if existing.as_os_str().is_empty() { Path::new(".") } else { existing });
        }
        // a file without a name: nothing is left even if the process is killed
        tempfile::tempfile_in(existing).map_err(|source| OutputError { path: path.to_owned(), source })?;
        Ok(claimed)
    }

    /// Whether what is in the folder now may be replaced.
    fn permit(&self) -> Result<(), ClaimError> {
        let path = &self.path;
        let names: Vec<_> = names(path)?.iter().map(|name| name.to_string_lossy().into_owned()).collect();
        match if names.is_empty() { None } else { (self.objection)(path, &names) } {
            Some(_) if self.force => protect(path, &self.keep),
            // --force, which would refuse it, is no advice
            Some(found) if protect(path, &self.keep).is_err() => Err(ClaimError::Shared { path: path.clone(), found }),
            Some(found) => Err(ClaimError::Occupied { path: path.clone(), found }),
            None => Ok(()),
        }
    }

    /// The folder.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// A temporary folder for the results.
    ///
    /// # Errors
    /// [`OutputError`] with the reason.
    pub fn stage(&self) -> Result<StagedFolder, OutputError> {
        let (path, existing) = (self.path.clone(), existing(&self.path));
        let make = || {
            let temporary = temporary::folder_in(existing)?;
            let new = temporary.folder.path().join(NEW);
            fs::create_dir(&new)?;
            Ok(StagedFolder { path: path.clone(), new, inside: existing == path, temporary })
        };
        make().map_err(OutputError::at(&self.path))
    }

    /// Puts the results in their place. A new folder appears at once. In a folder that exists (which may be a mount
    /// point, or where a terminal is) the file `last` of the old results is moved away first and that of the new ones
    /// comes last: while it is absent, the folder is not complete. If a file cannot be moved, all are moved back. What
    /// may be replaced is decided again: another run may have filled the folder since it was claimed.
    ///
    /// # Errors
    /// [`ClaimError`]; the folder is then as it was.
    pub fn commit(&self, results: StagedFolder, last: &str) -> Result<(), ClaimError> {
        let StagedFolder { path, new, inside, mut temporary } = results;
        if !path.exists() {
            path.parent().filter(|parent| !parent.as_os_str().is_empty()).map_or(Ok(()), create_folder)?;
            match fs::rename(&new, &path) {
                Ok(()) => return Ok(()),
                // another run was faster
                Err(_) if path.exists() => {}
                Err(source) => return Err(OutputError { path, source }.into()),
            }
        }
        // held until the end: two runs do not mix
        let _lock = lock_folder(&path);
        self.permit().map_err(|error| match error {
            ClaimError::Occupied { path, found } | ClaimError::Shared { path, found } => {
                ClaimError::Lost { path, found }
            }
            other => other,
        })?;
        if !inside {
            // whoever comes after a killed process looks for what it left in the folder
            let here = temporary::folder_in(&path).map_err(OutputError::at(&path))?;
            fs::rename(&new, here.folder.path().join(NEW)).map_err(OutputError::at(&path))?;
            temporary = here;
        }
        let replaced = replace(&path, temporary.folder.path(), last, &mut |from, to| fs::rename(from, to));
        // otherwise not all could be moved back: that is for a later run
        temporary.folder.disable_cleanup(!is_settled(temporary.folder.path()));
        Ok(replaced?)
    }
}

/// Complete results in a temporary folder. [`commit`](ResultFolder::commit) puts them in their place; dropping deletes them.
#[derive(Debug)]
pub struct StagedFolder {
    path: PathBuf,
    /// Where they are.
    new: PathBuf,
    /// Whether that is in the folder that they are for.
    inside: bool,
    temporary: TemporaryFolder,
}

impl StagedFolder {
    /// Writes a file; `name` is relative to the folder.
    ///
    /// # Errors
    /// [`OutputError`] with the reason.
    pub fn write(
        &self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), OutputError> {
        let path = self.new.join(name);
        let attempt = || {
            path.parent().map_or(Ok(()), fs::create_dir_all)?;
            write_whole(&File::create(&path)?, write)
        };
        attempt().map_err(OutputError::at(&self.path.join(name)))
    }

    /// The paths of the files that have been written, relative to the folder.
    ///
    /// # Errors
    /// [`OutputError`] with the reason.
    pub fn files(&self) -> Result<Vec<String>, OutputError> {
        let root = &self.new;
        let (mut files, mut folders) = (Vec::new(), vec![PathBuf::new()]);
        while let Some(folder) = folders.pop() {
            for name in names(&root.join(&folder))? {
                let path = folder.join(name);
                if root.join(&path).is_dir() {
                    folders.push(path);
                } else {
                    files.push(path.to_string_lossy().replace(std::path::MAIN_SEPARATOR, "/"));
                }
            }
        }
        Ok(files)
    }
}

/// The path, or its nearest ancestor that exists, where results can be: it is a folder.
///
/// # Errors
/// [`ClaimError::NotAFolder`].
pub fn existing_folder(path: &Path) -> Result<&Path, ClaimError> {
    let existing = existing(path);
    if existing.is_dir() { Ok(existing) } else { Err(ClaimError::NotAFolder(existing.to_owned())) }
}

/// Refuses a path inside the folder of a run, which could not be replaced any more; of the folder `but` the caller decides.
///
/// # Errors
/// [`ClaimError::Inside`].
pub fn outside_of_runs(path: &Path, but: Option<&Path>) -> Result<(), ClaimError> {
    let existing = existing(path);
    let canonical = |path: &Path| path.canonicalize().ok();
    let (above, but) = (canonical(existing), but.and_then(canonical));
    let around = above.iter().flat_map(|above| above.ancestors()).skip(usize::from(existing == path));
    let mut runs = around.filter(|folder| Some(*folder) != but.as_deref()).filter_map(|folder| {
        let scenario = scenario_in(folder)?;
        Some(ClaimError::Inside { path: path.to_owned(), outer: folder.to_owned(), scenario })
    });
    runs.next().map_or(Ok(()), Err)
}

/// The path, or its nearest ancestor that exists.
fn existing(path: &Path) -> &Path {
    let found = path.ancestors().find(|folder| folder.symlink_metadata().is_ok());
    found.unwrap_or(Path::new("."))
}

/// Why `--force` does not empty a folder, for what it would delete.
fn protection(path: &Path, kept: &Path) -> String {
    let (shown, inner) = (path.display(), kept.display());
    if path.canonicalize().is_ok_and(|path| path == kept) {
        format!("--force would delete all in {shown}, the working folder or your home folder")
    } else {
        format!("--force would delete {inner}, which is in {shown}")
    }
}

/// Refuses a folder that is more than one of results: that contains the working folder, the user's own folder, one of the
/// files, a folder other than that of figures, or a hidden file.
fn protect(path: &Path, keep: &[PathBuf]) -> Result<(), ClaimError> {
    let protected = |kept| ClaimError::Protected { path: path.to_owned(), kept };
    let absolute = |path: &Path| path.canonicalize().ok();
    // a folder whose place cannot be told is not emptied
    let folder = absolute(path).ok_or_else(|| protected(path.to_owned()))?;
    let home = std::env::home_dir();
    let kept = [Some(Path::new(".")), home.as_deref()].into_iter().flatten().chain(keep.iter().map(PathBuf::as_path));
    if let Some(kept) = kept.filter_map(absolute).find(|kept| kept.starts_with(&folder)) {
        return Err(protected(kept));
    }
    for name in names(path)? {
        let entry = path.join(&name);
        let is_hidden = |name: &OsString| name.to_string_lossy().starts_with('.');
        let inner = if name == FIGURES && !entry.is_symlink() && entry.is_dir() { names(&entry)? } else { Vec::new() };
        if let Some(kept) = inner.iter().map(|name| entry.join(name)).find(|inner| inner.is_dir()) {
            return Err(protected(kept));
        }
        if is_hidden(&name) || (entry.is_dir() && name != FIGURES) {
            return Err(protected(entry));
        }
    }
    Ok(())
}
