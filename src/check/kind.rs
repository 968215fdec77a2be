//! Which kind of file a TOML text is, by its top-level keys.

use crate::diagnostic::{Report, nearest, reject_document};
use crate::file_format::FileFormat;
use toml::de::DeTable;

/// The key that all have at their top level.
const OF_ALL: &str = "name";

/// The keys at the top level of a kind of file, without that of all.
fn keys(format: FileFormat) -> Vec<&'static str> {
    format.table().names().into_iter().filter(|name| *name != OF_ALL).collect()
}

/// The kind with most of its keys in the text, which may be broken and its keys misspelt; of several the first.
pub(super) fn kind(text: &str, file: &str) -> Result<FileFormat, Report> {
    let (tree, errors) = DeTable::parse_recoverable(text.trim_start_matches('\u{feff}'));
    let known: Vec<_> = FileFormat::ALL.iter().map(|format| (*format, keys(*format))).collect();
    let meant = |key: &str| nearest(key, known.iter().flat_map(|(_, keys)| keys.iter().copied()));
    let given: Vec<_> = tree.get_ref().keys().filter_map(|key| meant(key.get_ref())).collect();
    // a layout's reader reports invalid TOML
    if given.is_empty() && errors.is_empty() {
        return Err(none_of_them(text, file));
    }
    let count = |keys: &[&str]| given.iter().filter(|key| keys.contains(key)).count();
    // the last of the largest is the first
    let best = known.iter().rev().max_by_key(|(_, keys)| count(keys));
    Ok(best.map_or(FileFormat::Layout, |(format, _)| *format))
}

fn none_of_them(text: &str, file: &str) -> Report {
    let keys = FileFormat::ALL.iter().flat_map(|format| keys(*format));
    let mut known: Vec<_> = [OF_ALL].into_iter().chain(keys).collect();
    let all = known.clone();
    let mut at = 0..;
    known.retain(|key| !all[..at.next().unwrap_or_default()].contains(key));
    let sweep = if cfg!(feature = "sweep") { ", nor a sweep, which has `name`, `scenario` and `[[vary]]`" } else { "" };
    let message = format!(
        "this is neither a layout, which has `name`, `[base]` and `[[arm]]`, nor a scenario, which has `name`, `layout`, \
         `[initial]` and `[approach]`{sweep}"
    );
    reject_document(text, file, &known, &message, "none of these keys is here")
}
