//! What the folder of a run has in it, to tell the results of one scenario from anything else.

use serde_json::Value;
use std::fs;
use std::path::Path;

/// The file that names the scenario and its cases.
pub const SUMMARY: &str = "summary.json";

/// What stands against replacing the content of a folder with a run of this scenario, as a predicate: a file that no run
/// of it writes, or the results of another scenario.
///
/// A run that was killed while it put its results in their place leaves them without a summary; it is then in one of the
/// temporary folders.
#[must_use]
pub fn objection(folder: &Path, names: &[String], scenario: &str) -> Option<String> {
    let inner = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let inner = inner
        .filter(|path| path.file_name().and_then(|name| name.to_str()).is_some_and(super::temporary::is_temporary));
    let summaries = std::iter::once(folder.to_owned()).chain(inner).map(|folder| folder.join(SUMMARY));
    let Some(summary) = summaries.into_iter().find_map(|path| read(&path)) else {
        let name = names.iter().find(|name| *name == SUMMARY).or(names.first())?;
        return Some(format!("has `{name}`, which is not from a run"));
    };
    let found = summary["scenario"].as_str().unwrap_or_default();
    if found != scenario {
        return Some(format!("holds the results of `{found}`, not of `{scenario}`"));
    }
    let cases: Vec<_> =
        summary["cases"].as_array().into_iter().flatten().filter_map(|case| case["name"].as_str()).collect();
    let foreign = names.iter().find(|name| !belongs(folder, name, &cases))?;
    Some(format!("has `{foreign}`, which is not from a run of `{scenario}`"))
}

/// A summary: a JSON object with scenario and cases.
fn read(path: &Path) -> Option<Value> {
    let summary: Value = serde_json::from_slice(&fs::read(path).ok()?).ok()?;
    (summary["scenario"].is_string() && summary["cases"].is_array()).then_some(summary)
}

/// Whether a run with these cases writes a file or folder of this name.
fn belongs(folder: &Path, name: &str, cases: &[&str]) -> bool {
    let path = folder.join(name);
    match name {
        SUMMARY | "report.html" => path.is_file(),
        "figures" => {
            let mut figures = fs::read_dir(&path).into_iter().flatten().flatten().map(|entry| entry.path());
            path.is_dir() && figures.all(|path| path.extension().is_some_and(|kind| kind == "svg" || kind == "png"))
        }
        name => {
            let of_case = name
                .rsplit_once('.')
                .is_some_and(|(case, kind)| cases.contains(&case) && ["csv", "parquet", "mcap"].contains(&kind));
            of_case && path.is_file()
        }
    }
}
