//! The layout that an argument names.

use super::Problem;
use planar_capture::diagnostic::{nearest, read_text};
use planar_capture::layout::Layout;
use planar_capture::registry::SHIPPED;
use std::path::Path;

/// Reads a layout; see [`source`].
pub fn read(argument: &str) -> Result<Layout, Problem> {
    let (text, file) = source(argument)?;
    Ok(Layout::parse(&text, &file)?)
}

/// The text that an argument names, and its name as shown to the user: what ends in `.toml` or contains a `/` is a
/// path, anything else the name of a shipped layout.
pub fn source(argument: &str) -> Result<(String, String), Problem> {
    if Layout::is_path(argument) || argument.contains(std::path::MAIN_SEPARATOR) {
        return Ok((read_text(Path::new(argument), "TOML")?, argument.to_owned()));
    }
    match SHIPPED.iter().find(|(name, _)| *name == argument) {
        Some((name, text)) => Ok(((*text).to_owned(), format!("{name}.toml (shipped)"))),
        None => Err(Problem::NoLayout {
            name: argument.to_owned(),
            meant: nearest(argument, SHIPPED.iter().map(|(name, _)| *name))
                .map(|name| format!("did you mean `{name}`? "))
                .unwrap_or_default(),
            shipped: SHIPPED.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", "),
        }),
    }
}
