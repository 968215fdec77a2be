//! Reports of the problems in input files, in the form of a compiler's diagnostics.
//!
//! [`read_text`] reads a file; [`read_document`] parses it and passes its root [`Table`] to a reader. Readers continue
//! after a problem, so that one [`Report`] shows all. [`report_warnings`] shows warnings about the content at their places
//! in the file, [`report_error`] an error that its use brings up.

mod document;
mod file;
mod hidden_character;
mod number_rule;
mod syntax;
mod table;
mod warning;

use std::error::Error;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use document::Document;
use toml::de::DeTable;

pub use file::read_text;
pub use hidden_character::{is_hidden, printable};
pub use number_rule::NumberRule;
pub use table::{Table, Value, every};
pub use warning::{Warning, report_error, report_warnings};

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

/// Parses `text` and reads its root table, which may hold `keys` and no others, with `read`. `read` returns `None` where
/// it has found problems.
///
/// # Errors
/// The syntax errors, one per line, or all problems of the content.
pub fn read_document<T>(
    text: &str,
    file: &str,
    keys: &[&str],
    read: impl FnOnce(&Table<'_>) -> Option<T>,
) -> Result<T, Report> {
    let document = Document::new(text, file, Severity::Error);
    let content = {
        let (tree, errors) = DeTable::parse_recoverable(document.source());
        syntax::report(&document, &errors);
        let root = || Table::new(&document, tree.get_ref(), 0..0, String::new(), keys);
        if errors.is_empty() { read(&root()) } else { None }
    };
    content.filter(|_| document.is_valid()).ok_or_else(|| document.into_report())
}

/// The candidate that is most similar to `name`, ignoring case; `None` if all have a Jaro–Winkler similarity below 0.8.
#[must_use]
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&name, &candidate.to_lowercase()), candidate))
        .filter(|(similarity, _)| *similarity >= 0.8)
        .max_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, candidate)| candidate)
}

/// The names in backticks as an English list, such as `` `a`, `b` or `c` `` with the conjunction "or".
#[must_use]
pub fn listing(names: &[&str], conjunction: &str) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} {conjunction} {last}", rest.join(", ")),
        None => "nothing".to_owned(),
    }
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
