//! Tables in braces over several lines, or with a comma at their end: the parser takes them, as TOML 1.1 does, but
//! editors, Python and other programs read TOML 1.0.

use super::document::Document;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Adds a problem for each of them.
pub(super) fn report(document: &Document, root: &DeTable<'_>) {
    for (_, value) in root {
        walk(document, value);
    }
}

fn walk(document: &Document, value: &Spanned<DeValue<'_>>) {
    match value.get_ref() {
        DeValue::Array(items) => items.iter().for_each(|item| walk(document, item)),
        DeValue::Table(table) => {
            if document.text(&value.span()).starts_with('{') {
                check(document, table, &value.span());
            }
            for (_, value) in table {
                walk(document, value);
            }
        }
        _ => {}
    }
}

/// Looks between the values of a table in braces.
fn check(document: &Document, table: &DeTable<'_>, span: &Range<usize>) {
    let mut values = Vec::new();
    collect(document, table, &mut values);
    values.sort_by_key(|value| value.start);
    let ends = values.iter().map(|value| value.end);
    let starts = values.iter().map(|value| value.start).chain([span.end]);
    let between = [span.start].into_iter().chain(ends).zip(starts).map(|(from, to)| document.text(&(from..to)));
    let between: Vec<_> = between.collect();
    let why = if between.iter().any(|text| text.contains('\n')) {
        "a table in braces stands on one line, as in TOML 1.0"
    } else if !values.is_empty() && between.last().is_some_and(|text| text.contains(',')) {
        "a table in braces has no comma at its end, as in TOML 1.0"
    } else {
        return;
    };
    let help = "write it on one line, or with a header `[...]` and a line for each key";
    document.report(span, &format!("{why}, which editors and other programs read"), None, Some(help.to_owned()));
}

/// The spans of a table's values, of those too whose keys have points.
fn collect(document: &Document, table: &DeTable<'_>, values: &mut Vec<Range<usize>>) {
    for (_, value) in table {
        match value.get_ref() {
            DeValue::Table(inner) if !document.text(&value.span()).starts_with('{') => collect(document, inner, values),
            _ => values.push(value.span()),
        }
    }
}
