//! Syntax errors of TOML, with hints.

use super::document::Document;
use super::excerpt;

/// Adds the first syntax error of each line; errors after an unclosed array are omitted as its consequences.
pub(super) fn report(document: &Document, errors: &[toml::de::Error]) {
    let text = document.source();
    let mut last_end = 0; // of the line of the error before
    let mut errors: Vec<_> = errors.iter().map(|e| (e.span().unwrap_or_default(), e.message())).collect();
    errors.sort_by_key(|(span, _)| span.start);
    for (span, message) in errors {
        let is_first = last_end == 0 || span.start > last_end;
        if !is_first && !message.contains(BETWEEN_ELEMENTS) {
            continue; // before its line is looked for: there may be an error for each of its characters
        }
        let start = text[..span.start].rfind('\n').map_or(0, |newline| newline + 1);
        if is_first {
            last_end = text[span.start..].find('\n').map_or(text.len(), |length| span.start + length);
            let shown = excerpt(text[start..last_end].trim_end_matches('\r'));
            let title = format!("`{shown}` is not valid TOML: {message}");
            document.report(&span, &title, None, hint(message, document.text(&span)).map(str::to_owned));
        }
        if text[start..span.start].trim().is_empty() && message.contains(BETWEEN_ELEMENTS) {
            break;
        }
    }
}

/// Part of the parser's message for an array without a separator or an end.
const BETWEEN_ELEMENTS: &str = "between array elements";

/// Parts of the parser's messages, and what to write instead; the first that matches counts.
const HINTS: [(&str, &str); 12] = [
    ("must be quoted", "text stands in quotes, `\"arm1\"`; formulas are not evaluated"),
    ("duplicate key", "each key is given once; every entry of a list, the first too, starts with `[[...]]`"),
    (BETWEEN_ELEMENTS, "the elements of an array are separated by commas; or its `]` is missing on a line above"),
    ("invalid basic string", CLOSING_QUOTE),
    ("invalid literal string", CLOSING_QUOTE),
    ("mantissa", DIGITS_AROUND_POINT),
    ("fraction", DIGITS_AROUND_POINT),
    ("leading zero", "write the number without the leading zero"),
    ("unexpected key or value", "write one `key = value` per line, and numbers with a decimal point: `1.5`"),
    ("key with no value", KEY_AND_VALUE),
    ("invalid unquoted key", KEY_AND_VALUE),
    ("expected key", "write lines `key = value` and headers `[table]`"),
];
const CLOSING_QUOTE: &str = "text ends with the quote that it starts with, on the same line: `\"arm1\"`";
const DIGITS_AROUND_POINT: &str = "write digits on both sides of the point: `0.5`, `5.0`";
const KEY_AND_VALUE: &str = "write `key = value`";

/// What to write instead of the text at an error, for the most frequent mistakes.
fn hint(message: &str, found: &str) -> Option<&'static str> {
    if message.contains("must be quoted") && found.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
        return Some("numbers stand alone, separated by commas, without units or formulas: `[0.5, 10]`");
    }
    if message.contains("must be quoted") && found.starts_with(['“', '”', '„', '‘', '’', '`', '«']) {
        return Some("text stands in straight quotes: `\"arm1\"`");
    }
    if message.contains("invalid unquoted key") && found.starts_with(|c: char| !c.is_ascii()) {
        return Some("a key with other letters than a to z stands in quotes: `\"größe\" = 1.0`");
    }
    HINTS.iter().find(|(part, _)| message.contains(part)).map(|(_, hint)| *hint)
}
