//! Reports of the problems in input files, in the form of a compiler's diagnostics.
//!
//! [`read_text`] reads a file; [`read_document`] parses it and passes its root [`Table`] to a reader. Readers continue
//! after a problem, so that one [`Report`] shows all. [`report_warnings`] shows warnings about the content at their places
//! in the file, [`report_error`] an error that its use brings up.
//!
//! # Example
//! ```
//! use planar_layout::diagnostic::{NumberRule, read_document};
//! use planar_layout::format::{Key, Shape, TableFormat};
//!
//! static BALL: TableFormat = TableFormat {
//!     doc: "A ball.",
//!     keys: &[Key::required("mass", Shape::Number(NumberRule::positive("a mass", "kg")), "of the ball")],
//!     one_of: &[],
//! };
//! let read = |text| read_document(text, "ball.toml", &BALL, |ball| ball.number("mass"));
//! assert_eq!(read("mass = 2.5")?, 2.5);
//! let report = read("mas = 2.5").expect_err("a key that there is not").to_string();
//! let lines: Vec<&str> = report.lines().collect();
//! assert_eq!(lines[0], "error: unknown key `mas` (2.5)");
//! assert_eq!(lines[1], " --> ball.toml:1:1");
//! assert_eq!(lines[4], "  | ^^^ did you mean `mass`?");
//! # Ok::<(), planar_layout::diagnostic::Report>(())
//! ```

mod document;
mod document_kind;
mod file;
mod hidden_character;
mod inline_table;
mod syntax;
mod table;
mod warning;

use std::convert::Infallible;
use std::error::Error;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::sync::Arc;

use crate::format::TableFormat;
use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use document::Document;
use table::Keys;
use toml::de::DeTable;

pub use crate::format::NumberRule;
pub use crate::names::{listing, nearest};
pub use document_kind::DocumentKind;
pub use file::{read_text, read_text_from};
pub use hidden_character::{is_hidden, printable};
pub use table::{Table, Value, every};
pub use warning::{Warning, report_error, report_warnings, report_without_place};

/// Number of problems that a report shows, about one screen; it counts the others.
const SHOWN: usize = 8;

/// A file's name as shown to the user, and its text.
#[derive(Debug)]
struct Source {
    file: String,
    text: String,
}

/// The severity of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Severity {
    /// The file cannot be used.
    Error,
    /// The file can be used, but may contain a mistake.
    Warning,
}

/// One problem, its place, and a hint.
#[derive(Clone, Debug)]
struct Diagnostic {
    severity: Severity,
    place: Option<(Arc<Source>, Range<usize>)>,
    message: String,
    label: Option<String>,
    help: Option<String>,
}

impl Diagnostic {
    /// A problem with a whole file, or with one that cannot be read at all.
    fn with_file(message: String, help: impl Into<Option<String>>) -> Self {
        Self { severity: Severity::Error, place: None, message, label: None, help: help.into() }
    }

    fn render(&self, renderer: &Renderer) -> String {
        let level = match self.severity {
            Severity::Error => Level::ERROR,
            Severity::Warning => Level::WARNING,
        };
        let title = level.primary_title(self.message.as_str());
        let snippet = self.place.as_ref().map(|(source, span)| {
            let mark = AnnotationKind::Primary.span(first_line(&source.text, span));
            Snippet::source(source.text.as_str())
                .path(source.file.as_str())
                .annotation(mark.label(self.label.as_deref()))
        });
        let help = self.help.as_deref().map(|help| Level::HELP.message(help));
        renderer.render(&[title.elements(snippet).elements(help)])
    }
}

/// The part of a span on its first line, so that a long array is not printed.
fn first_line(text: &str, span: &Range<usize>) -> Range<usize> {
    let length = text[span.clone()].find(['\r', '\n']);
    span.start..length.map_or(span.end, |length| span.start + length)
}

/// All problems of an input, the error of every reader here, or all warnings, see [`report_warnings`].
///
/// `Display` is [`render`](Self::render) without colour: for each of the first eight problems the message, the file, line
/// and column, the line itself, and a hint; the others are counted.
#[derive(Clone, Debug)]
pub struct Report {
    problems: Vec<Diagnostic>,
}

impl Report {
    /// The report for a terminal (`color`) or as plain text; no newline at its end.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let mut parts: Vec<_> = self.problems.iter().take(SHOWN).map(|problem| problem.render(&renderer)).collect();
        let noun = match self.problems.first() {
            Some(Diagnostic { severity: Severity::Warning, .. }) => "warning",
            _ => "problem",
        };
        match self.problems.len().saturating_sub(SHOWN) {
            0 => {}
            1 => parts.push(format!("... and 1 more {noun}")),
            more => parts.push(format!("... and {more} more {noun}s")),
        }
        // the renderer shows ASCII control characters of the source safely, and uses some itself, but not all others
        parts.join("\n\n").replace(|c: char| !c.is_ascii() && is_hidden(c), "\u{fffd}")
    }

    /// The number of problems, shown or not.
    #[must_use]
    pub fn count(&self) -> usize {
        self.problems.len()
    }

    /// The problems in one line of text, without their places: for a text that is no file of the user's.
    #[must_use]
    pub fn sentence(&self) -> String {
        let parts = self.problems.iter().flat_map(|Diagnostic { message, label, help, .. }| {
            [Some(message), label.as_ref(), help.as_ref()].into_iter().flatten()
        });
        parts.map(String::as_str).collect::<Vec<_>>().join("; ")
    }

    /// This report followed by another.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.problems.extend(other.problems);
        self
    }
}

impl From<Diagnostic> for Report {
    fn from(problem: Diagnostic) -> Self {
        Self { problems: vec![problem] }
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl Error for Report {}

/// Parses `text` and reads its root table, which may hold the keys of `format` and no others, with `read`. `read` returns
/// `None` where it has found problems.
///
/// # Errors
/// The syntax errors, one per line, or all problems of the content.
pub fn read_document<T>(
    text: &str,
    file: &str,
    format: &'static TableFormat,
    read: impl FnOnce(&Table<'_>) -> Option<T>,
) -> Result<T, Report> {
    read_root(text, file, &Keys::Of(format), read)
}

/// The report that a text, which may hold these keys at its top level, is not what is wanted; with its syntax errors alone
/// if it has any.
#[must_use]
pub fn reject_document(text: &str, file: &str, keys: &[&str], message: &str, label: &str) -> Report {
    let Err(report) = read_root::<Infallible>(text, file, &Keys::Names(keys.to_vec(), None), |root| {
        root.reject(message, label);
        None
    });
    report
}

fn read_root<T>(
    text: &str,
    file: &str,
    keys: &Keys<'_>,
    read: impl FnOnce(&Table<'_>) -> Option<T>,
) -> Result<T, Report> {
    let document = Document::new(text, file, Severity::Error);
    let content = {
        let (tree, errors) = DeTable::parse_recoverable(document.source());
        syntax::report(&document, &errors);
        let root = || Table::new(&document, tree.get_ref(), 0..0, String::new(), keys);
        if errors.is_empty() {
            inline_table::report(&document, tree.get_ref());
            read(&root())
        } else {
            None
        }
    };
    content.filter(|_| document.is_valid()).ok_or_else(|| document.into_report())
}

/// Text from an input as one short printable line.
#[must_use]
pub fn excerpt(text: &str) -> String {
    const LONGEST: usize = 48;
    // a line separator is shown as what it is
    let is_space = |c: char| matches!(c, '\t' | '\n' | '\r') || (c.is_whitespace() && !is_hidden(c));
    let words = text.split(is_space).filter(|word| !word.is_empty());
    let line = printable(&words.collect::<Vec<_>>().join(" "));
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::first_line;

    #[test]
    fn a_mark_ends_with_its_line_whatever_ends_that() {
        for text in ["a = [1,\n2]", "a = [1,\r\n2]", "a = [1,\r2]"] {
            assert_eq!(first_line(text, &(4..text.len())), 4..7, "{text:?}");
        }
        assert_eq!(first_line("a = [1, 2]", &(4..10)), 4..10);
    }
}
