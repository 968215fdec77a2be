//! Text of any of the formats as words, quoted strings, spaces and single characters.

use std::ops::Range;

/// The tokens of a text, which together are the text.
pub fn tokens(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || "_+-.".contains(c);
        let length = match first {
            '"' | '\'' => quoted(rest, first),
            '\n' => 1,
            c if is_word(c) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            c if c.is_whitespace() => rest.find(|c: char| !c.is_whitespace() || c == '\n').unwrap_or(rest.len()),
            c => c.len_utf8(),
        };
        let (token, after) = rest.split_at(length);
        found.push(token);
        rest = after;
    }
    found
}

/// The length of a quoted string on one line; of the quote alone where it does not end.
fn quoted(text: &str, quote: char) -> usize {
    let mut escaped = false;
    for (i, c) in text.char_indices().skip(1) {
        match c {
            '\n' => break,
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            c if c == quote => return i + 1,
            _ => {}
        }
    }
    1
}

/// What belongs to a token: from a bracket to the one that closes it, else its line.
pub fn group(tokens: &[&str], at: usize) -> Range<usize> {
    let mut depth = 0_i32;
    if matches!(tokens[at], "[" | "{" | "<") {
        for (i, token) in tokens.iter().enumerate().skip(at) {
            match *token {
                "[" | "{" | "<" => depth += 1,
                "]" | "}" | ">" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return at..i + 1;
            }
        }
    }
    let start = tokens[..at].iter().rposition(|token| *token == "\n").map_or(0, |newline| newline + 1);
    let end = tokens[at..].iter().position(|token| *token == "\n").map_or(tokens.len(), |newline| at + newline + 1);
    start..end
}
