//! What the folder of a run has in it, to tell the results of one scenario from anything else.
//!
//! # Example
//! ```
//! use planar_capture::output::run_folder::{SUMMARY, objection, remove, scenario_in};
//! use std::fs;
//!
//! let temporary = tempfile::tempdir()?;
//! let folder = temporary.path();
//! fs::write(folder.join(SUMMARY), r#"{"scenario": "capture", "cases": [], "files": ["case1.csv"]}"#)?;
//! fs::write(folder.join("case1.csv"), "")?;
//! assert_eq!(scenario_in(folder).as_deref(), Some("capture"));
//! let names = ["case1.csv", SUMMARY].map(str::to_owned);
//! assert!(objection(folder, &names, "another").is_some_and(|what| what.contains("results of `capture`")));
//! fs::write(folder.join("notes.txt"), "")?;
//! remove(folder)?;
//! // what no run has written is left
//! assert!(folder.join("notes.txt").exists() && !folder.join("case1.csv").exists());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::output_error::OutputError;
use super::regular_file;
use crate::plain_text::count;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::{fs, io};

/// The file that names the scenario, its cases, and the files of the run.
pub const SUMMARY: &str = "summary.json";
/// The page with all cases.
pub const REPORT: &str = "report.html";
/// The folder in a folder of results; these have no other, and no name that begins with a point.
pub const FIGURES: &str = "figures";

/// What stands against replacing the content of a folder with a run of this scenario, as a predicate: a file that is not
/// in the list of its summary, or the results of another scenario.
#[must_use]
pub fn objection(folder: &Path, names: &[String], scenario: &str) -> Option<String> {
    let Some(summary) = summary_in(folder) else {
        let runs: Vec<_> = names.iter().filter(|name| scenario_in(&folder.join(name)).is_some()).collect();
        if let [first, others @ ..] = runs.as_slice()
            && runs.len() == names.len()
        {
            let others =
                if others.is_empty() { String::new() } else { format!(" and {}", count(others.len(), "other")) };
            return Some(format!("has the folders of other runs in it, `{first}`{others}"));
        }
        let name = names.iter().find(|name| *name == SUMMARY).or(names.first())?;
        return Some(format!("has `{name}`, which is not from a run"));
    };
    let found = summary["scenario"].as_str().unwrap_or_default();
    if found != scenario {
        return Some(format!("holds the results of `{found}`, not of `{scenario}`"));
    }
    let listed: BTreeSet<_> = files_of(&summary).collect();
    let foreign = names.iter().find_map(|name| foreign(folder, Path::new(name), &listed))?;
    Some(format!("has `{}`, which is not from a run of `{scenario}`", foreign.display()))
}

/// The scenario whose results are in a folder, and not in folders in it.
#[must_use]
pub fn scenario_in(folder: &Path) -> Option<String> {
    Some(summary_in(folder)?["scenario"].as_str()?.to_owned())
}

/// The summary of the results in a folder: a JSON object with scenario and cases.
#[must_use]
pub fn summary_in(folder: &Path) -> Option<Value> {
    let summary: Value = serde_json::from_slice(&regular_file::read(&folder.join(SUMMARY)).ok()?).ok()?;
    (summary["scenario"].is_string() && summary["cases"].is_array()).then_some(summary)
}

/// The files that a summary lists.
pub fn files_of(summary: &Value) -> impl Iterator<Item = &str> {
    summary["files"].as_array().into_iter().flatten().filter_map(Value::as_str)
}

/// Removes the results in a folder: the summary, without which they are none, and the files that it lists.
///
/// # Errors
/// [`OutputError`] with the reason.
pub fn remove(folder: &Path) -> Result<(), OutputError> {
    let Some(summary) = summary_in(folder) else { return Ok(()) };
    let files = files_of(&summary).map(Path::new);
    // no run lists a file beside its folder
    let inside = |file: &&Path| file.components().all(|part| matches!(part, Component::Normal(_)));
    for file in [Path::new(SUMMARY)].into_iter().chain(files.filter(inside)) {
        let path = folder.join(file);
        match fs::remove_file(&path) {
            Err(source) if source.kind() != io::ErrorKind::NotFound => return Err(OutputError { path, source }),
            _ => {}
        }
    }
    // where it has nothing else in it
    let _ = fs::remove_dir(folder.join(FIGURES));
    Ok(())
}

/// What is not listed of a file or folder, by its path in the results.
fn foreign(folder: &Path, name: &Path, listed: &BTreeSet<&str>) -> Option<PathBuf> {
    match fs::read_dir(folder.join(name)) {
        Ok(inner) => {
            let mut inner = inner.flatten().map(|entry| name.join(entry.file_name())).peekable();
            // a folder of the run's may have been emptied
            let is_own = inner.peek().is_some() || listed.iter().any(|file| Path::new(file).starts_with(name));
            if is_own { inner.find_map(|name| foreign(folder, &name, listed)) } else { Some(name.to_owned()) }
        }
        Err(_) => name.to_str().is_none_or(|name| !listed.contains(name)).then(|| name.to_owned()),
    }
}
