//! The layout that an argument names.

use super::Problem;
use planar_capture::diagnostic::nearest;
use planar_capture::layout::Layout;
use planar_capture::models::SHIPPED;
use std::path::Path;

/// Reads a layout: what ends in `.toml` or contains a `/` is a path, anything else the name of a shipped one.
pub fn read(argument: &str) -> Result<Layout, Problem> {
    if Layout::is_path(argument) || argument.contains(std::path::MAIN_SEPARATOR) {
        return Ok(Layout::read(Path::new(argument))?);
    }
    match SHIPPED.iter().find(|(name, _)| *name == argument) {
        Some((name, text)) => Ok(Layout::parse(text, &format!("{name}.toml (shipped)"))?),
        None => Err(Problem::NoLayout {
            name: argument.to_owned(),
            meant: nearest(argument, SHIPPED.iter().map(|(name, _)| *name))
                .map(|name| format!("did you mean `{name}`? "))
                .unwrap_or_default(),
            shipped: SHIPPED.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", "),
        }),
    }
}
