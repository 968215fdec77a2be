//! One TOML document and the problems met while reading it.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use toml::de::DeTable;

use super::table::{Table, place};
use super::{Problem, Report, Severity, Source, printable, syntax};

/// The source that a tree's spans point into, and where its readers leave what they find wrong.
#[derive(Debug)]
pub(super) struct Document {
    source: Arc<Source>,
    problems: RefCell<Vec<Problem>>,
    /// Path and keys of the tables met so far.
    tables: RefCell<Vec<(String, Vec<String>)>>,
    /// Problems, by index, that are unknown tables, and the tables' names.
    strays: RefCell<Vec<(usize, String)>>,
}

impl Document {
    /// A document without problems; `file` is the name that they are shown under.
    pub(super) fn new(text: &str, file: &str) -> Self {
        let source = Source { file: printable(file), text: text.to_owned() };
        Self {
            source: Arc::new(source),
            problems: RefCell::default(),
            tables: RefCell::default(),
            strays: RefCell::default(),
        }
    }

    /// The whole source text.
    pub(super) fn source(&self) -> &str {
        &self.source.text
    }

    /// The source text of a span.
    pub(super) fn text(&self, span: &Range<usize>) -> &str {
        self.source.text.get(span.clone()).unwrap_or_default()
    }

    /// Notes a problem at a span.
    pub(super) fn report(&self, span: &Range<usize>, message: String, label: Option<String>, help: Option<String>) {
        self.note(Severity::Error, span, message, label, help);
    }

    /// Notes what is wrong or odd at a span.
    pub(super) fn note(
        &self,
        severity: Severity,
        span: &Range<usize>,
        message: String,
        label: Option<String>,
        help: Option<String>,
    ) {
        let place = Some((Arc::clone(&self.source), span.clone()));
        self.problems.borrow_mut().push(Problem { severity, place, message, label, help });
    }

    /// Remembers the keys of a table.
    pub(super) fn open(&self, path: &str, keys: &[&str]) {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        self.tables.borrow_mut().push((path.to_owned(), keys));
    }

    /// Remembers that the last problem is an unknown table, which may belong into another that comes later.
    pub(super) fn remember_stray(&self, name: &str) {
        let index = self.problems.borrow().len().saturating_sub(1);
        self.strays.borrow_mut().push((index, name.to_owned()));
    }

    /// Says of the unknown tables where they belong, now that all tables are known.
    fn place_strays(&self) {
        let (mut problems, tables) = (self.problems.borrow_mut(), self.tables.borrow());
        for (index, name) in self.strays.borrow().iter() {
            let owner = tables.iter().find(|(_, keys)| keys.contains(name));
            if let (Some((owner, _)), Some(Problem { label: label @ None, .. })) = (owner, problems.get_mut(*index)) {
                *label =
                    Some(format!("this belongs into {}: write `[[{}.{name}]]`", place(owner), without_indices(owner)));
            }
        }
    }

    /// The innermost table around `path` that has this key.
    pub(super) fn owner_of(&self, key: &str, path: &str) -> Option<String> {
        let tables = self.tables.borrow();
        let mut outwards = tables.iter().rev();
        let owner = outwards.find(|(outer, keys)| {
            let inside = path.strip_prefix(outer.as_str());
            let inside = inside.is_some_and(|rest| outer.is_empty() || rest.starts_with('.'));
            inside && keys.iter().any(|known| known == key)
        });
        owner.map(|(outer, _)| place(outer))
    }

    /// Takes over the problems of a file that the value at `span` names. Those without a place get
    /// this one, and a message that starts with `value`.
    pub(super) fn adopt(&self, span: &Range<usize>, value: &str, report: Report) {
        let here = (Arc::clone(&self.source), span.clone());
        let adopted = report.problems.into_iter().map(|problem| match problem.place {
            Some(_) => problem,
            None => {
                Problem { place: Some(here.clone()), message: format!("{value}, but {}", problem.message), ..problem }
            }
        });
        self.problems.borrow_mut().extend(adopted);
    }

    /// The problems in the order of the source, those of other files last.
    pub(super) fn into_report(self) -> Report {
        self.place_strays();
        let mut problems = self.problems.into_inner();
        problems.sort_by_key(|problem| match &problem.place {
            Some((source, span)) if Arc::ptr_eq(source, &self.source) => span.start,
            _ => usize::MAX,
        });
        Report { problems }
    }
}

/// Parses `text` and reads its root table, which may hold `keys` and no others, with `read`.
///
/// `read` returns `None` where it has noted problems; it should look at all it can before it does.
///
/// # Errors
/// The syntax errors (one per line; the content is then not looked at), or all problems noted.
pub fn read_document<T>(
    text: &str,
    file: &str,
    keys: &[&str],
    read: impl FnOnce(&Table<'_>) -> Option<T>,
) -> Result<T, Report> {
    let text = without_mark(text);
    let document = Document::new(text, file);
    let (tree, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        syntax::report(&document, &errors);
        return Err(document.into_report());
    }
    let content = read(&Table::new(&document, tree.get_ref(), 0..0, String::new(), keys));
    match content {
        Some(content) if document.problems.borrow().is_empty() => Ok(content),
        _ => Err(document.into_report()),
    }
}

/// A path as headers have it: `arm.link` of `arm[0].link[1]`.
fn without_indices(path: &str) -> String {
    path.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect()
}

/// The text without the byte order mark that some editors put first.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}
