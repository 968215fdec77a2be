//! Problems in input files, shown the way a compiler shows them.
//!
//! [`read_text`] reads a file, [`read_document`] parses it and hands its root [`Table`] to a reader. Readers note every
//! problem they meet and carry on, so that one [`Report`] shows all. What can be read but is odd, somebody else finds
//! in the content; [`report_warnings`] shows it at its place in the file.

mod document;
mod file;
mod quantity;
mod syntax;
mod table;
mod value;
mod warning;

use std::error::Error;
use std::fmt::{self, Display, Formatter};
use std::ops::Range;
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};

pub use document::read_document;
pub use file::read_text;
pub use quantity::NumberRule;
pub use table::{Table, every};
pub use value::Value;
pub use warning::{Warning, report_warnings};

/// How many problems a report shows before it only counts them: about one screen.
const SHOWN: usize = 8;

/// A file's name as shown to the user, and its text.
#[derive(Debug)]
struct Source {
    file: String,
    text: String,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Severity {
    /// The file cannot be worked with.
    Error,
    /// The file can be worked with, but may not say what was meant.
    Warning,
}

/// One thing that is wrong or odd, where it is and what would be right.
#[derive(Clone, Debug)]
struct Problem {
    severity: Severity,
    place: Option<(Arc<Source>, Range<usize>)>,
    message: String,
    label: Option<String>,
    help: Option<String>,
}

impl Problem {
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

/// The part of a span on its first line: a long array is pointed at, not reprinted.
fn first_line(text: &str, span: &Range<usize>) -> Range<usize> {
    let length = text.get(span.clone()).and_then(|part| part.find(['\r', '\n']));
    span.start..length.map_or(span.end, |length| span.start + length)
}

/// All that is wrong with an input: the error of every reader here. Or all that is odd about one: see
/// [`report_warnings`].
///
/// `Display` is [`render`](Self::render) without colour: for each problem (the first eight; the
/// rest are counted) what is wrong, the file, line and column, the line itself, and a hint.
#[derive(Clone, Debug)]
pub struct Report {
    problems: Vec<Problem>,
}

impl Report {
    /// The report for a terminal (`color`) or as plain text; no newline at its end.
    #[must_use]
    pub fn render(&self, color: bool) -> String {
        let renderer = if color { Renderer::styled() } else { Renderer::plain() };
        let mut parts: Vec<_> = self.problems.iter().take(SHOWN).map(|problem| problem.render(&renderer)).collect();
        let noun = match self.problems.first() {
            Some(Problem { severity: Severity::Warning, .. }) => "warning",
            _ => "problem",
        };
        match self.problems.len().saturating_sub(SHOWN) {
            0 => {}
            1 => parts.push(format!("... and 1 more {noun}")),
            more => parts.push(format!("... and {more} more {noun}s")),
        }
        // The renderer shows ASCII control characters of the source safely, but not these.
        parts.join("\n\n").replace(|c| matches!(c, '\u{80}'..='\u{9f}'), "\u{fffd}")
    }

    /// The number of problems, shown or not.
    #[must_use]
    pub fn count(&self) -> usize {
        self.problems.len()
    }

    /// This report and, after it, another.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.problems.extend(other.problems);
        self
    }
}

impl From<Problem> for Report {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

impl Display for Report {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render(false))
    }
}

impl Error for Report {}

/// The candidate that `name` is most likely a misspelling of, ignoring case; `None` if none is
/// close (Jaro–Winkler similarity below 0.8).
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

/// The names in backticks as an English list, such as `` `a`, `b` or `c` `` with the conjunction
/// "or".
#[must_use]
pub fn listing(names: &[&str], conjunction: &str) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} {conjunction} {last}", rest.join(", ")),
        None => "nothing".to_owned(),
    }
}

/// Text from an input as one short line that is safe to print.
#[must_use]
pub fn excerpt(text: &str) -> String {
    const LONGEST: usize = 48;
    let line = printable(&text.split_whitespace().collect::<Vec<_>>().join(" "));
    match line.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}…", line.get(..end).unwrap_or_default()),
        None => line,
    }
}

/// The text without characters that a terminal would act on instead of showing them.
pub fn printable(text: &str) -> String {
    text.replace(char::is_control, "\u{fffd}")
}
