//! What is said of another file of this program in place of a scenario.

use crate::diagnostic::{Report, reject_document};

/// The report on a text that is a layout or a sweep; `None` of any other.
pub(super) fn other_file(text: &str, file: &str) -> Option<Report> {
    let tree: toml::Table = text.trim_start_matches('\u{feff}').parse().ok()?;
    let message = if tree.contains_key("approach") {
        return None;
    } else if tree.contains_key("base") && tree.contains_key("arm") {
        "this is a layout, expected a scenario that names it with `layout`: `planar-capture template scenario` prints one"
    } else if tree.contains_key("vary") {
        "this is a sweep, expected the scenario that it names, or the command `planar-capture sweep`"
    } else {
        return None;
    };
    let keys: Vec<&str> = tree.keys().map(String::as_str).collect();
    Some(reject_document(text, file, &keys, message, "a scenario has the table `[approach]`"))
}
