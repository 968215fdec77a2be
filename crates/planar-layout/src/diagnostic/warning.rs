//! Warnings: what a reader accepts, and a person should look at.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::document::{Document, without_mark};
use super::value::Value;
use super::{Report, Severity};

/// Something in a file that can be worked with, but is probably not what was meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Path of the key: `arm[1].link[0].mass`.
    pub key: String,
    /// What is odd about its value, as it reads after "`key` is value:".
    pub why: String,
    /// What would be right.
    pub help: String,
}

/// The oddities as warnings at their places in the text; `file` is the name that it is shown under.
///
/// A key that is left out is shown at the table that could hold it.
#[must_use]
pub fn report_warnings(text: &str, file: &str, warnings: &[Warning]) -> Report {
    let text = without_mark(text);
    let document = Document::new(text, file);
    let (tree, _) = DeTable::parse_recoverable(text);
    for Warning { key, why, help } in warnings {
        let found = follow(tree.get_ref(), key);
        let span = found.as_ref().map_or(0..0, |(value, _)| value.span());
        let (message, label) = match found {
            Some((value, "")) => {
                let shown = Value::new(&document, value, key.clone()).shown();
                (format!("`{key}` is {shown}: {why}"), None)
            }
            _ => (format!("`{key}` is left at its default: {why}"), Some("it could stand here".to_owned())),
        };
        document.note(Severity::Warning, &span, message, label, Some(help.clone()));
    }
    document.into_report()
}

/// The value that a path leads to, or the last there is on the way and what remains of the path.
fn follow<'a, 'p>(table: &'a DeTable<'a>, path: &'p str) -> Option<(&'a Spanned<DeValue<'a>>, &'p str)> {
    let after = |key: &str| path.strip_prefix(key).filter(|rest| rest.is_empty() || rest.starts_with(['.', '[']));
    let (value, rest) = table.iter().find_map(|(key, value)| Some((value, after(key.get_ref())?)))?;
    Some(descend(value, rest))
}

fn descend<'a, 'p>(value: &'a Spanned<DeValue<'a>>, rest: &'p str) -> (&'a Spanned<DeValue<'a>>, &'p str) {
    let inner = match value.get_ref() {
        DeValue::Table(table) => rest.strip_prefix('.').and_then(|path| follow(table, path)),
        DeValue::Array(items) => {
            rest.strip_prefix('[').and_then(|rest| rest.split_once(']')).and_then(|(index, rest)| {
                let item = items.get(index.parse::<usize>().ok()?)?;
                Some(descend(item, rest))
            })
        }
        _ => None,
    };
    inner.unwrap_or((value, rest))
}
