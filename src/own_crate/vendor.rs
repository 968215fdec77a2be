//! The sources of `planar-capture`, as a crate of one's own has them.

use crate::graphs;
use crate::python_package::PYTHON_PACKAGE;
use crate::registry::SHIPPED;

macro_rules! sources {
    ($($path:literal),* $(,)?) => {
        /// (path, text).
        const SOURCES: &[(&str, &str)] =
            &[$(($path, include_str!(concat!(env!("CARGO_MANIFEST_DIR"), '/', $path)))),*];
    };
}

include!(concat!(env!("OUT_DIR"), "/sources.rs"));

/// The folder of the root's crate.
const FOLDER: &str = "vendor/planar-capture";
/// The versions of the libraries, which hold for the whole crate.
const LOCK: &str = "Cargo.lock";

/// Whether this program was built with the sources of all crates beside it.
#[must_use]
pub fn has_sources() -> bool {
    !SOURCES.is_empty()
}

/// (path, text) of the sources, and of the lock.
pub(super) fn files() -> Vec<(String, String)> {
    let text = |path: &str, text: &str| if path.ends_with("Cargo.toml") { manifest(text) } else { text.to_owned() };
    let sources = SOURCES.iter().map(|(path, source)| ((*path).to_owned(), text(path, source)));
    let python = PYTHON_PACKAGE.iter().map(|(path, text)| (format!("codegen/{path}"), (*text).to_owned()));
    let layouts = SHIPPED.iter().map(|(name, text)| (format!("codegen/layouts/{name}.toml"), (*text).to_owned()));
    let graphs = graphs::carried().map(|(path, text)| (format!("codegen/{path}"), text.to_owned()));
    let all = sources.chain(python).chain(layouts).chain(graphs);
    let mut files: Vec<_> = all.map(|(path, text)| (format!("{FOLDER}/{path}"), text)).collect();
    let lock = SOURCES.iter().filter(|(path, _)| *path == LOCK);
    files.extend(lock.map(|(path, text)| ((*path).to_owned(), (*text).to_owned())));
    files
}

/// A manifest without what only tests need: they are not there.
fn manifest(text: &str) -> String {
    let mut is_kept = true;
    let kept = text.split_inclusive('\n').filter(|line| {
        if line.starts_with('[') {
            is_kept = line.trim() != "[dev-dependencies]";
        }
        let is_of_tests = line.starts_with("default-members") || line.starts_with("planar-proof =");
        is_kept && !is_of_tests
    });
    let members = |line: &str| {
        if line.starts_with("members") { "members = [\"crates/*\"]\n".to_owned() } else { line.to_owned() }
    };
    kept.map(members).collect()
}
