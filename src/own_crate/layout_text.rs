//! The text of a layout with another name.

use crate::layout::Layout;

/// The TOML text with the layout's name changed, comments and all; written anew where the line of the name is not found.
#[must_use]
pub fn renamed(text: &str, layout: &Layout, name: &str) -> String {
    let renamed = Layout { name: name.to_owned(), ..layout.clone() };
    let mut found = false;
    let lines = text.split_inclusive('\n').map(|line| {
        let is_name = !found && line.split_once('=').is_some_and(|(key, _)| key.trim() == "name");
        found |= is_name;
        let replaced = is_name.then(|| line.replacen(&format!("\"{}\"", layout.name), &format!("\"{name}\""), 1));
        replaced.unwrap_or_else(|| line.to_owned())
    });
    let edited: String = lines.collect();
    let is_right = Layout::parse(&edited, name).is_ok_and(|edited| edited == renamed);
    if is_right { edited } else { renamed.to_toml() }
}
