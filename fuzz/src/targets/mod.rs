//! The readers, each with its seeds and what it promises.

mod graph;
mod layout;
mod scenario;
mod states;
mod urdf;

use planar_capture::diagnostic::is_hidden;
use std::fs;
use std::path::{Path, PathBuf};

/// A reader.
pub struct Target {
    /// Of the command line.
    pub name: &'static str,
    /// Of a hundred inputs; the faster, the more.
    pub share: u64,
    /// Valid texts.
    pub seeds: Vec<String>,
    /// Reads an input; whether it is valid, or the promise that is broken.
    pub read: fn(&[u8]) -> Result<bool, String>,
}

/// All of them.
pub fn all() -> [Target; 5] {
    [layout::target(), scenario::target(), states::target(), urdf::target(), graph::target()]
}

/// A path of the repository.
fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(name)
}

/// A file of the repository.
fn file(name: &str) -> String {
    let path = path(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The files of a folder of the repository that have an extension, in the order of their names.
fn files(folder: &str, extension: &str) -> Vec<String> {
    let entries = fs::read_dir(path(folder)).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let mut paths: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    paths.retain(|path| path.extension().is_some_and(|found| found == extension));
    paths.sort();
    paths.iter().map(|path| fs::read_to_string(path).expect("a text file")).collect()
}

/// A message that a person reads: with text, on a screen, as it is.
fn refused(message: &dyn std::fmt::Display) -> Result<bool, String> {
    const LONGEST: usize = 1 << 18;
    let message = message.to_string();
    if message.is_empty() || message.len() > LONGEST || message.contains(|c| c != '\n' && is_hidden(c)) {
        return Err(format!("its message is empty, long, or has hidden characters: {message:?}"));
    }
    Ok(false)
}

/// A promise.
fn promised(holds: bool, what: &str) -> Result<(), String> {
    if holds { Ok(()) } else { Err(format!("it breaks a promise: {what}")) }
}
