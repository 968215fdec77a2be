//! The layout that an argument names.

use super::CommandError;
use crate::layout::Layout;
use crate::named_layout::{NoLayout, named_layout};
use crate::registry::Robots;

/// Reads a layout; see [`named_layout`].
pub fn read(argument: &str, robots: Robots<'_>) -> Result<Layout, CommandError> {
    let (text, file) = source(argument, robots)?;
    Ok(Layout::parse(&text, &file)?)
}

/// The text that an argument names and its name in messages.
pub fn source(argument: &str, robots: Robots<'_>) -> Result<(String, String), CommandError> {
    named_layout(argument, robots).map_err(|error| match error {
        NoLayout::Unreadable(report) => report.into(),
        NoLayout::Unknown(message) => CommandError::Usage(message),
    })
}
