//! Warnings about values that are valid but probably mistakes, and errors that show only when valid values are used, at
//! their places in the source.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::document::Document;
use super::{Diagnostic, Report, Severity, Value};

/// A value that is valid but probably a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Path of the key: `arm[1].link[0].mass`.
    pub key: String,
    /// The reason, as it reads after "`key` is value:".
    pub why: String,
    /// A hint.
    pub help: String,
}

/// The report of warnings at their places in the text; `file` is its name in the report.
///
/// A key that is not given is shown at the table that may hold it.
#[must_use]
pub fn report_warnings(text: &str, file: &str, warnings: &[Warning]) -> Report {
    let document = Document::new(text, file, Severity::Warning);
    let (tree, _) = DeTable::parse_recoverable(document.source());
    for Warning { key, why, help } in warnings {
        report_at(&document, tree.get_ref(), (key, None), why, Some(help.clone()));
    }
    document.into_report()
}

/// The report of an error that the value of one key causes although it is valid by itself; `file` is the text's name in
/// the report.
///
/// A key that is not given is shown with its `default` at the table that may hold it.
#[must_use]
pub fn report_error(text: &str, file: &str, (key, default): (&str, &str), why: &str, help: Option<String>) -> Report {
    let document = Document::new(text, file, Severity::Error);
    let (tree, _) = DeTable::parse_recoverable(document.source());
    report_at(&document, tree.get_ref(), (key, Some(default)), why, help);
    document.into_report()
}

/// The report of an error for which no value of a file is at fault.
#[must_use]
pub fn report_without_place(why: String, help: String) -> Report {
    Diagnostic::with_file(why, help).into()
}

/// Adds a problem at the value of a key, or at the innermost table around a key that is not given.
fn report_at(
    document: &Document,
    root: &DeTable<'_>,
    (key, default): (&str, Option<&str>),
    why: &str,
    help: Option<String>,
) {
    let found = follow(root, key);
    let span = found.as_ref().map_or(0..0, |(value, _)| value.span());
    let (message, label) = if let Some((value, "")) = found {
        let value = Value::new(document, value, key.to_owned(), None);
        // of a table with a header there is no value to show
        let is_shown = if value.has_header() { String::new() } else { format!(" is {}", value.shown()) };
        (format!("`{key}`{is_shown}: {why}"), None)
    } else {
        let default = default.map_or_else(String::new, |default| format!(", {default}"));
        (format!("`{key}` is left at its default{default}: {why}"), Some("it could stand here".to_owned()))
    };
    document.report(&span, &message, label, help);
}

/// The value at a path, or the innermost value around it and the rest of the path.
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

#[cfg(test)]
mod tests {
    use super::{Warning, report_error, report_warnings};

    const TEXT: &str = "name = \"it\"\n[approach]\nduration = 1.0\n[[target]]\nmass = 2.0\n";

    /// An error says what the default is, a warning does not; both stand at the table that may hold the key.
    #[test]
    fn what_is_left_at_its_default_is_said_with_it() {
        for (key, line) in [("approach.step", 2), ("target[0].yaw", 4), ("limits", 1)] {
            let error = report_error(TEXT, "it.toml", (key, "0.25 s"), "too long", None).to_string();
            assert!(error.starts_with(&format!("error: `{key}` is left at its default, 0.25 s: too long")), "{error}");
            let (key, why, help) = (key.to_owned(), "too long".to_owned(), "less".to_owned());
            let said = format!("warning: `{key}` is left at its default: too long");
            let warning = report_warnings(TEXT, "it.toml", &[Warning { key, why, help }]).to_string();
            assert!(warning.starts_with(&said), "{warning}");
            for shown in [error, warning] {
                let place = format!("it.toml:{line}:");
                assert!(shown.contains(&place) && shown.contains("it could stand here"), "no {place} in\n{shown}");
            }
        }
    }

    /// What is given is shown as it is, whatever its default.
    #[test]
    fn what_is_given_is_shown() {
        let error = report_error(TEXT, "it.toml", ("target[0].mass", "1.0"), "too heavy", None).to_string();
        assert!(
            error.starts_with("error: `target[0].mass` is 2.0: too heavy") && error.contains("it.toml:5:"),
            "{error}"
        );
        let error = report_error(TEXT, "it.toml", ("approach", "none"), "too fast", None).to_string();
        assert!(error.starts_with("error: `approach`: too fast") && error.contains("it.toml:2:"), "{error}");
    }

    /// A key whose name only begins as another's is another key.
    #[test]
    fn keys_are_found_by_their_whole_names() {
        let shown =
            |text: &str| report_error(text, "it.toml", ("approach.step_size", "0.25 s"), "too long", None).to_string();
        let both = shown("[approach]\nstep = 0.5\nsteps = 3\nstep_size = 2.0\n");
        assert!(
            both.starts_with("error: `approach.step_size` is 2.0: too long") && both.contains("it.toml:4:"),
            "{both}"
        );
        let other = shown("[approach]\nstep = 0.5\n[approaches]\nstep_size = 2.0\n");
        assert!(other.contains("is left at its default, 0.25 s") && other.contains("it.toml:1:"), "{other}");
    }
}
