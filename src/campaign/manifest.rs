//! `manifest.json`: what the files of a folder were computed with. Other files of the same sweep join them only where all
//! of it is the same.
//!
//! # Example
//! ```
//! use planar_capture::campaign::Campaign;
//! use planar_capture::campaign::manifest::{claim, engine_of};
//! use planar_capture::engine::Engine;
//! use planar_capture::registry::SHIPPED;
//!
//! let campaign = Campaign::read("scenarios/sweeps/uncertain_capture.toml".as_ref(), SHIPPED)?;
//! let folder = tempfile::tempdir()?;
//! claim(folder.path(), &campaign, Engine::Generated)?;
//! assert_eq!(engine_of(folder.path()).as_deref(), Some("generated"));
//! // results of another engine have other bits
//! let refused = claim(folder.path(), &campaign, Engine::Generic).unwrap_err();
//! assert!(refused.to_string().contains(r#"engine: was "generated", is "generic""#));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::reader::Campaign;
use crate::engine::Engine;
use crate::layout::sha256;
use crate::output::atomic_file::{StagedFile, lock_folder};
use crate::output::output_error::OutputError;
use crate::output::regular_file;
use serde_json::{Value, json};
use std::fs;
use std::io::{self, Write};
use std::path::Path;

/// The file's name.
pub const MANIFEST: &str = "manifest.json";

/// What can be changed from one command to the next, for samplings that can grow.
const CASES: &str = "cases";

/// Why a folder does not take the files of a sweep.
#[derive(Debug, thiserror::Error)]
pub enum ManifestError {
    /// It has something else in it.
    #[error("{folder} has `{found}`, and is not the folder of a sweep: choose another one with --out")]
    Foreign {
        /// The folder.
        folder: String,
        /// A file in it.
        found: String,
    },
    /// Its manifest is not one of a sweep.
    #[error("{folder}/{MANIFEST} is not the manifest of a sweep: choose another folder with --out")]
    Unreadable {
        /// The folder.
        folder: String,
    },
    /// It has files of another sweep, or of this one before a change.
    #[error(
        "{folder} has results that were computed with something else:\n{}\nChoose another folder with --out, or undo the \
         change", .changes.iter().map(|change| format!("  {change}")).collect::<Vec<_>>().join("\n")
    )]
    Changed {
        /// The folder.
        folder: String,
        /// What is different, one line each.
        changes: Vec<String>,
    },
    /// It cannot be read or written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// What a sweep computes: sweep, but for the number of cases, scenario and layout.
///
/// # Panics
/// Never: the texts were read before.
fn trees(campaign: &Campaign) -> [Value; 3] {
    let tree = |text: &str| -> Value {
        let table: toml::Table = text.strip_prefix('\u{feff}').unwrap_or(text).parse().expect("a text that was read");
        serde_json::to_value(table).expect("TOML has the values of JSON")
    };
    let sources = &campaign.scenario_source;
    let [mut sweep, scenario, layout] =
        [&campaign.source.text, &sources.scenario.text, &sources.layout.text].map(|text| tree(text));
    if let Some(table) = sweep.as_object_mut() {
        table.remove(CASES);
    }
    [sweep, scenario, layout]
}

/// The names of the hashes of [`trees`], in the manifest and in every file of cases.
const HASHES: [&str; 3] = ["sweep_sha256", "scenario_sha256", "layout_sha256"];

/// The hashes by which a file of cases belongs to a sweep, with their names: those of the manifest.
pub(super) type Origin = [(&'static str, String); 3];

/// The origin of the files of a campaign.
pub(super) fn origin(campaign: &Campaign) -> Origin {
    let mut hashes = trees(campaign).map(|tree| sha256(&tree.to_string())).into_iter();
    HASHES.map(|name| (name, hashes.next().unwrap_or_default()))
}

/// The manifest of a campaign that an engine computes.
#[must_use]
pub fn manifest(campaign: &Campaign, engine: Engine) -> Value {
    let [sweep, scenario, layout] = trees(campaign);
    let [sweep_sha256, scenario_sha256, layout_sha256] = origin(campaign).map(|(_, hash)| hash);
    json!({
        "sweep_name": campaign.sweep.name,
        "version": env!("CARGO_PKG_VERSION"),
        "engine": engine.name(),
        HASHES[0]: sweep_sha256,
        HASHES[1]: scenario_sha256,
        HASHES[2]: layout_sha256,
        CASES: campaign.sweep.cases,
        "sweep": sweep,
        "scenario": scenario,
        "layout": layout,
    })
}

/// Writes the manifest to a folder that is empty or has the same; with more cases in place of one with fewer, where
/// the sampling can grow. Of several processes at once the first has the folder, and the others see its manifest.
///
/// # Errors
/// [`ManifestError`].
///
/// # Panics
/// Never: a manifest has a text.
pub fn claim(folder: &Path, campaign: &Campaign, engine: Engine) -> Result<(), ManifestError> {
    let wanted = manifest(campaign, engine);
    let text = serde_json::to_string_pretty(&wanted).expect("a tree has a text") + "\n";
    let path = folder.join(MANIFEST);
    let staged = || StagedFile::new(&path, |to| to.write_all(text.as_bytes()));
    // between reading and writing
    let _lock = lock_folder(folder);
    loop {
        match regular_file::read(&path) {
            Ok(bytes) if bytes == text.as_bytes() => return Ok(()),
            Ok(bytes) => {
                check(&bytes, &wanted, folder, campaign)?;
                return Ok(staged()?.commit()?);
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let found = first_name(folder);
                // where there are no locks, as on some shared disks, another process may have been here meanwhile
                if path.exists() {
                    continue;
                }
                if let Some(found) = found {
                    return Err(ManifestError::Foreign { folder: folder.display().to_string(), found });
                }
                if staged()?.commit_new()? {
                    return Ok(());
                }
            }
            Err(error) if error.kind() == io::ErrorKind::InvalidInput => {
                return Err(ManifestError::Unreadable { folder: folder.display().to_string() });
            }
            Err(error) => return Err(OutputError::at(&path)(error).into()),
        }
    }
}

/// That a manifest is the wanted one, or that of fewer cases where these can grow.
fn check(bytes: &[u8], wanted: &Value, folder: &Path, campaign: &Campaign) -> Result<(), ManifestError> {
    let shown = || folder.display().to_string();
    let found: Value = serde_json::from_slice(bytes).unwrap_or_default();
    if !found[HASHES[0]].is_string() {
        return Err(ManifestError::Unreadable { folder: shown() });
    }
    let mut changes = Vec::new();
    differences("", &found, wanted, &mut changes);
    let cases = found[CASES].as_u64().unwrap_or_default();
    let grown = campaign.sweep.sampling.can_grow() && cases <= campaign.sweep.cases;
    changes.retain(|(path, _)| !(path.ends_with("_sha256") || path == CASES && grown));
    if changes.is_empty() {
        return Ok(());
    }
    let mut changes: Vec<String> = changes.into_iter().map(|(path, change)| format!("{path}: {change}")).collect();
    if changes.iter().any(|change| change.starts_with("cases: ")) {
        let why = if campaign.sweep.sampling.can_grow() { "there are files of more" } else { CANNOT_GROW };
        changes.push(format!("({why})"));
    }
    Err(ManifestError::Changed { folder: shown(), changes })
}

const CANNOT_GROW: &str = "only the samplings `random` and `sobol` can have more cases later";

/// The engine that the files of a folder were computed with, by its name.
#[must_use]
pub fn engine_of(folder: &Path) -> Option<String> {
    let found: Value = serde_json::from_slice(&regular_file::read(&folder.join(MANIFEST)).ok()?).ok()?;
    found["engine"].as_str().map(str::to_owned)
}

/// The first name in a folder that is not hidden.
fn first_name(folder: &Path) -> Option<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| !name.starts_with('.'))
        .collect();
    names.sort();
    names.into_iter().next()
}

/// The paths of values that differ, and how.
fn differences(path: &str, found: &Value, wanted: &Value, changes: &mut Vec<(String, String)>) {
    match (found, wanted) {
        (Value::Object(found), Value::Object(wanted)) => {
            let keys = found.keys().chain(wanted.keys().filter(|key| !found.contains_key(*key)));
            for key in keys {
                let inner = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                let value = |tree: &serde_json::Map<String, Value>| tree.get(key).cloned().unwrap_or_default();
                differences(&inner, &value(found), &value(wanted), changes);
            }
        }
        (Value::Array(found), Value::Array(wanted)) if found.len() == wanted.len() => {
            for (i, (found, wanted)) in found.iter().zip(wanted).enumerate() {
                differences(&format!("{path}[{i}]"), found, wanted, changes);
            }
        }
        _ if found == wanted => {}
        _ => {
            let shown = |value: &Value| if value.is_null() { "nothing".to_owned() } else { value.to_string() };
            changes.push((path.to_owned(), format!("was {}, is {}", shown(found), shown(wanted))));
        }
    }
}
