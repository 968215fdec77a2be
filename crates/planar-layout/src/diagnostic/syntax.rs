//! What is not valid TOML, and what to write instead.

use super::document::Document;
use super::excerpt;

/// Notes the syntax errors, the first of each line and none after an array that is left open: those only follow.
pub(super) fn report(document: &Document, errors: &[toml::de::Error]) {
    let text = document.source();
    let mut last_line = None;
    let mut errors: Vec<_> = errors.iter().map(|e| (e.span().unwrap_or_default(), e.message())).collect();
    errors.sort_by_key(|(span, _)| span.start);
    for (span, message) in errors {
        let before = text.get(..span.start).unwrap_or_default();
        let line = before.matches('\n').count();
        if last_line.replace(line) != Some(line) {
            let shown = excerpt(text.lines().nth(line).unwrap_or_default());
            let title = format!("`{shown}` is not valid TOML: {message}");
            document.report(&span, title, None, hint(message, document.text(&span)));
        }
        let begins_line = before.rsplit('\n').next().is_some_and(|start| start.trim().is_empty());
        if begins_line && message.contains(BETWEEN_ELEMENTS) {
            break;
        }
    }
}

/// In the parser's message, where an array does not go on as it should.
const BETWEEN_ELEMENTS: &str = "between array elements";

/// What to write instead of the text at an error, for the mistakes that people make most.
fn hint(message: &str, found: &str) -> Option<String> {
    let number = found.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    let hint = if message.contains("must be quoted") && number {
        "numbers stand alone, separated by commas, without units or formulas: `[0.5, 10]`"
    } else if message.contains("must be quoted") && found.starts_with(['“', '”', '„', '‘', '’', '`', '«']) {
        "text stands in straight quotes: `\"arm1\"`"
    } else if message.contains("must be quoted") {
        "text stands in quotes, `\"arm1\"`; formulas are not evaluated"
    } else if message.contains("duplicate key") {
        "each key is given once; every entry of a list, the first too, starts with `[[...]]`"
    } else if message.contains(BETWEEN_ELEMENTS) {
        "the elements of an array are separated by commas; or its `]` is missing on a line above"
    } else if message.contains("invalid basic string") || message.contains("invalid literal string") {
        "text ends with the quote that it starts with, on the same line: `\"arm1\"`"
    } else if message.contains("mantissa") || message.contains("fraction") {
        "write digits on both sides of the point: `0.5`, `5.0`"
    } else if message.contains("leading zero") {
        "write the number without the leading zero"
    } else if message.contains("unexpected key or value") {
        "write one `key = value` per line, and numbers with a decimal point: `1.5`"
    } else if message.contains("key with no value") || message.contains("invalid unquoted key") {
        "write `key = value`"
    } else if message.contains("expected key") {
        "write lines `key = value` and headers `[table]`"
    } else {
        return None;
    };
    Some(hint.to_owned())
}
