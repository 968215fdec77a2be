//! The name of a crate, which is that of its robot, of a Rust module and of a program.

use crate::layout::Layout;

/// Names that are valid for a module, but not for a package, a program, or beside what `main.rs` uses.
const TAKEN: [&str; 17] = [
    "alloc",
    "aux",
    "build",
    "con",
    "core",
    "deps",
    "examples",
    "incremental",
    "nul",
    "planar_build",
    "planar_capture",
    "planar_dynamics",
    "planar_layout",
    "prn",
    "std",
    "test",
    "tests",
];

/// A name is not one of a crate.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{name}` is no name for a crate and its robot: expected a Rust module's (lower-case letters, digits and `_`, a \
         letter first, no keyword, at most 64 of them){hint}"
)]
pub struct NoName {
    name: String,
    hint: String,
}

/// Whether a crate and its robot can have this name.
///
/// # Errors
/// [`NoName`], with one that would do.
pub fn check_name(name: &str) -> Result<(), NoName> {
    if is_valid(name) {
        return Ok(());
    }
    let letters: String =
        name.to_lowercase().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    let letters = letters.trim_matches('_');
    let candidates = [letters.to_owned(), format!("{letters}_robot"), format!("robot_{letters}")];
    let would_do = candidates.into_iter().find(|candidate| is_valid(candidate));
    let hint = would_do.map_or_else(String::new, |would_do| format!("; `--name {would_do}` would do"));
    Err(NoName { name: name.to_owned(), hint })
}

fn is_valid(name: &str) -> bool {
    Layout::is_name(name) && !TAKEN.contains(&name)
}
