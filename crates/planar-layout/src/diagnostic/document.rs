//! The source text of one TOML document and the problems found in it.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use super::{Diagnostic, Report, Severity, Source, printable};

/// A source text, to which the spans of its tree refer, and the problems that its readers find.
#[derive(Debug)]
pub(super) struct Document {
    source: Arc<Source>,
    /// Of all problems.
    severity: Severity,
    problems: RefCell<Vec<Diagnostic>>,
    /// Path and keys of the tables read so far.
    tables: RefCell<Vec<(String, Vec<String>)>>,
    /// Their indices by their paths.
    places: RefCell<HashMap<String, usize>>,
    /// Indices of the problems that are unknown tables, with the tables' names.
    unknown_tables: RefCell<Vec<(usize, String)>>,
}

impl Document {
    /// A document without problems; `file` is its name in the report. A byte order mark is dropped.
    pub(super) fn new(text: &str, file: &str, severity: Severity) -> Self {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let source = Source { file: printable(file), text: text.to_owned() };
        Self {
            source: Arc::new(source),
            severity,
            problems: RefCell::default(),
            tables: RefCell::default(),
            places: RefCell::default(),
            unknown_tables: RefCell::default(),
        }
    }

    /// The whole source text.
    pub(super) fn source(&self) -> &str {
        &self.source.text
    }

    /// Whether no problem was found.
    pub(super) fn is_valid(&self) -> bool {
        self.problems.borrow().is_empty()
    }

    /// The source text of a span.
    pub(super) fn text(&self, span: &Range<usize>) -> &str {
        &self.source.text[span.clone()]
    }

    /// Adds a problem at a span.
    pub(super) fn report(&self, span: &Range<usize>, message: &str, label: Option<String>, help: Option<String>) {
        let place = Some((Arc::clone(&self.source), span.clone()));
        // names in them are the user's
        let (message, label, help) = (printable(message), label.map(|l| printable(&l)), help.map(|h| printable(&h)));
        self.problems.borrow_mut().push(Diagnostic { severity: self.severity, place, message, label, help });
    }

    /// Stores the path and keys of a table.
    pub(super) fn add_table(&self, path: &str, keys: &[&str]) {
        let keys = keys.iter().map(|&key| key.to_owned()).collect();
        let mut tables = self.tables.borrow_mut();
        self.places.borrow_mut().insert(path.to_owned(), tables.len());
        tables.push((path.to_owned(), keys));
    }

    /// Marks the last problem as an unknown table, which may belong to a table that is read later.
    pub(super) fn mark_unknown_table(&self, name: &str) {
        let index = self.problems.borrow().len() - 1;
        self.unknown_tables.borrow_mut().push((index, name.to_owned()));
    }

    /// Labels the unknown tables with the tables that they belong to, once all are known.
    fn label_unknown_tables(&self) {
        let (mut problems, tables) = (self.problems.borrow_mut(), self.tables.borrow());
        let mut owners: HashMap<&str, &str> = HashMap::new();
        for (path, keys) in tables.iter() {
            for key in keys {
                owners.entry(key).or_insert(path);
            }
        }
        for (index, name) in self.unknown_tables.borrow().iter() {
            let label = &mut problems[*index].label;
            if let (Some(owner), None) = (owners.get(name.as_str()), &label) {
                let (table, header) = (table_name(owner), without_indices(owner));
                *label = Some(format!("this belongs into {table}: write `[[{header}.{name}]]`"));
            }
        }
    }

    /// The innermost table around `path` that has this key.
    pub(super) fn owner_of(&self, key: &str, path: &str) -> Option<String> {
        let tables = self.tables.borrow();
        let mut outwards = path;
        while !outwards.is_empty() {
            outwards = outwards.rsplit_once('.').map_or("", |(outer, _)| outer);
            let has_key = |(path, keys): &&(String, Vec<String>)| path == outwards && keys.iter().any(|k| k == key);
            if self.places.borrow().get(outwards).and_then(|at| tables.get(*at)).as_ref().is_some_and(has_key) {
                return Some(table_name(outwards));
            }
        }
        None
    }

    /// Adds the problems of a file that the value at `span` names. Those without a place get this one, and a message that
    /// starts with `value`.
    pub(super) fn adopt(&self, span: &Range<usize>, value: &str, report: Report) {
        let here = (Arc::clone(&self.source), span.clone());
        let adopted = report.problems.into_iter().map(|problem| match problem.place {
            Some(_) => problem,
            None => Diagnostic {
                place: Some(here.clone()),
                message: format!("{value}, but {}", problem.message),
                ..problem
            },
        });
        self.problems.borrow_mut().extend(adopted);
    }

    /// The problems in the order of the source, those of other files last.
    pub(super) fn into_report(self) -> Report {
        self.label_unknown_tables();
        let mut problems = self.problems.into_inner();
        problems.sort_by_key(|problem| match &problem.place {
            Some((source, span)) if Arc::ptr_eq(source, &self.source) => (false, span.start),
            _ => (true, 0),
        });
        Report { problems }
    }
}

/// A table as named in a sentence.
pub(super) fn table_name(path: &str) -> String {
    if path.is_empty() { "the top level".to_owned() } else { format!("`{path}`") }
}

/// A path as in headers: `arm.link` of `arm[0].link[1]`.
pub(super) fn without_indices(path: &str) -> String {
    path.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest)).collect()
}
