//! One TOML document and the problems met while reading it.

use std::cell::RefCell;
use std::ops::Range;
use std::sync::Arc;

use toml::de::DeTable;

use super::table::{Table, place};
use super::{Problem, Report, Source, excerpt, printable};

/// The source that a tree's spans point into, and where its readers leave what they find wrong.
#[derive(Debug)]
pub(super) struct Document {
    source: Arc<Source>,
    problems: RefCell<Vec<Problem>>,
    /// Path and keys of the tables met so far.
    tables: RefCell<Vec<(String, Vec<String>)>>,
}

impl Document {
    /// The source text of a span.
    pub(super) fn text(&self, span: &Range<usize>) -> &str {
        self.source.text.get(span.clone()).unwrap_or_default()
    }

    /// Notes a problem at a span.
    pub(super) fn report(&self, span: &Range<usize>, message: String, label: Option<String>, help: Option<String>) {
        let place = Some((Arc::clone(&self.source), span.clone()));
        self.problems.borrow_mut().push(Problem { place, message, label, help });
    }

    /// Remembers the keys of a table.
    pub(super) fn open(&self, path: &str, keys: &[&str]) {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        self.tables.borrow_mut().push((path.to_owned(), keys));
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

    /// Notes the syntax errors, the first of each line: the others only follow from it.
    fn report_syntax(&self, errors: &[toml::de::Error]) {
        let text = &self.source.text;
        let mut last_line = None;
        let mut errors: Vec<_> = errors.iter().map(|e| (e.span().unwrap_or_default(), e.message())).collect();
        errors.sort_by_key(|(span, _)| span.start);
        for (span, message) in errors {
            let before = text.get(..span.start).unwrap_or_default();
            let line = before.matches('\n').count();
            if last_line.replace(line) != Some(line) {
                let shown = excerpt(text.lines().nth(line).unwrap_or_default());
                let title = format!("`{shown}` is not valid TOML: {message}");
                self.report(&span, title, None, syntax_hint(message, self.text(&span)));
            }
        }
    }

    /// The problems in the order of the source, those of other files last.
    fn into_report(self) -> Report {
        let mut problems = self.problems.into_inner();
        problems.sort_by_key(|problem| match &problem.place {
            Some((source, span)) if Arc::ptr_eq(source, &self.source) => span.start,
            _ => usize::MAX,
        });
        Report { problems }
    }
}

/// What to write instead of the text at an error, for the mistakes that people make most.
fn syntax_hint(message: &str, found: &str) -> Option<String> {
    let number = found.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let hint = if message.contains("must be quoted") && number {
        "numbers stand alone, separated by commas, without units or formulas: `[0.5, 10]`"
    } else if message.contains("must be quoted") {
        "text stands in quotes, `\"arm1\"`; formulas are not evaluated"
    } else if message.contains("duplicate key") {
        "each key is given once; a further entry of a list starts with `[[...]]`"
    } else if message.contains("mantissa") || message.contains("fraction") {
        "write digits on both sides of the point: `0.5`, `5.0`"
    } else if message.contains("leading zero") {
        "write the number without the leading zero"
    } else if message.contains("unexpected key or value") {
        "write one `key = value` per line, and numbers with a decimal point: `1.5`"
    } else if message.contains("key with no value") {
        "write `key = value`"
    } else {
        return None;
    };
    Some(hint.to_owned())
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
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = Source { file: printable(file), text: text.to_owned() };
    let document = Document { source: Arc::new(source), problems: RefCell::default(), tables: RefCell::default() };
    let (tree, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        document.report_syntax(&errors);
        return Err(document.into_report());
    }
    let content = read(&Table::new(&document, tree.get_ref(), 0..0, String::new(), keys));
    match content {
        Some(content) if document.problems.borrow().is_empty() => Ok(content),
        _ => Err(document.into_report()),
    }
}
