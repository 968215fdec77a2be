//! The sources of this workspace's crates, which the program carries for crates of one's own.

use std::fs;
use std::path::Path;

/// Files beside the manifest that belong to the root's crate.
const OWN: [&str; 6] = ["Cargo.lock", "Cargo.toml", "LICENSE", "LICENSE-APACHE", "LICENSE-MIT", "build.rs"];
/// Folders with all that is in them, but tests.
const FOLDERS: [&str; 3] = ["codegen/structures", "crates", "src"];
/// What the program carries anyway: graphs.
const CARRIED: &str = "json";

/// Paths of the sources below the root's folder, sorted, with `/`; none where the other crates are not there, as in a
/// package from a registry. Tests are left out, and the files of the derivation that the program has anyway.
///
/// # Errors
/// A folder that cannot be read.
pub fn sources(root: &Path) -> Result<Vec<String>, String> {
    if !root.join("crates").is_dir() {
        return Ok(Vec::new());
    }
    let mut files: Vec<String> = OWN.into_iter().filter(|name| root.join(name).is_file()).map(str::to_owned).collect();
    FOLDERS.iter().try_for_each(|folder| collect(root, folder, &mut files))?;
    files.sort();
    Ok(files)
}

fn collect(root: &Path, folder: &str, files: &mut Vec<String>) -> Result<(), String> {
    let path = root.join(folder);
    for entry in fs::read_dir(&path).map_err(|e| format!("{}: {e}", path.display()))? {
        let entry = entry.map_err(|e| format!("{}: {e}", path.display()))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let below = format!("{folder}/{name}");
        let is_left_out =
            name.starts_with('.') || ["tests", "tests.rs", "target", "Cargo.lock"].contains(&name.as_str());
        if is_left_out || Path::new(&name).extension().is_some_and(|extension| extension == CARRIED) {
            continue;
        }
        if entry.path().is_dir() {
            collect(root, &below, files)?;
        } else {
            files.push(below);
        }
    }
    Ok(())
}
