//! Splits the text of a JSON array into its elements, one at a time.

use super::StateError;
use std::io::{self, BufRead};

/// Largest size of an element, bytes.
const MAX_BYTES: usize = 1 << 24;

/// One element.
pub struct Element<'a> {
    /// Counted from 0.
    pub index: usize,
    /// The line that it starts on, counted from 1.
    pub line: usize,
    /// Without the space around it; not checked to be JSON.
    pub text: &'a [u8],
}

/// The elements of a text `[element, element, …]`.
pub struct Elements<R> {
    input: R,
    line: usize,
    /// Index of the next element.
    index: usize,
    state: ParserState,
    text: Vec<u8>,
}

/// The expected next token.
#[derive(Clone, Copy, PartialEq)]
enum ParserState {
    /// `[`.
    Start,
    /// An element or `]`.
    First,
    /// A comma or `]`.
    After,
    End,
}

impl<R: BufRead> Elements<R> {
    /// Reads nothing.
    pub fn new(input: R) -> Self {
        Self { input, line: 1, index: 0, state: ParserState::Start, text: Vec::new() }
    }

    /// The next element; `None` at the end of the text, which must follow the closing bracket.
    pub fn next_element(&mut self) -> Result<Option<Element<'_>>, StateError> {
        if self.state == ParserState::Start {
            match self.skip_space()? {
                Some(b'[') => self.input.consume(1),
                found => return Err(self.syntax_error("an array of states, `[{…}, …]`", found)),
            }
            self.state = ParserState::First;
        }
        match (self.state, self.skip_space()?) {
            (ParserState::First | ParserState::After, Some(b']')) => {
                self.input.consume(1);
                self.state = ParserState::End;
            }
            (ParserState::After, Some(b',')) => self.input.consume(1),
            (ParserState::After, found) => return Err(self.syntax_error("`,` or `]`", found)),
            _ => {}
        }
        let found = self.skip_space()?;
        if self.state == ParserState::End {
            return match found {
                None => Ok(None),
                found => Err(self.syntax_error("nothing after the array", found)),
            };
        }
        if matches!(found, None | Some(b',' | b']' | b'}')) {
            return Err(self.syntax_error("a state, `{…}`", found));
        }
        let line = self.line;
        self.read_text()?;
        self.state = ParserState::After;
        self.index += 1;
        Ok(Some(Element { index: self.index - 1, line, text: self.text.trim_ascii_end() }))
    }

    /// Reads the text of an element up to the comma or bracket that ends it.
    fn read_text(&mut self) -> Result<(), StateError> {
        self.text.clear();
        let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
        loop {
            let Some(byte) = self.peek()? else {
                return Err(self.syntax_error("the end of this state, then `,` or `]`", None));
            };
            match byte {
                _ if escaped => escaped = false,
                b'\\' if quoted => escaped = true,
                b'"' => quoted = !quoted,
                _ if quoted => {}
                b'[' | b'{' => depth += 1,
                b',' | b']' if depth == 0 => return Ok(()),
                b']' | b'}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if self.text.len() == MAX_BYTES {
                return Err(self.syntax_error("a state of at most 16 MiB", Some(byte)));
            }
            self.text.push(byte);
            self.take(byte);
        }
    }

    fn peek(&mut self) -> Result<Option<u8>, StateError> {
        loop {
            match self.input.fill_buf() {
                Ok(buffer) => return Ok(buffer.first().copied()),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    fn take(&mut self, byte: u8) {
        self.input.consume(1);
        self.line += usize::from(byte == b'\n');
    }

    fn skip_space(&mut self) -> Result<Option<u8>, StateError> {
        loop {
            match self.peek()? {
                Some(byte @ (b' ' | b'\t' | b'\r' | b'\n')) => self.take(byte),
                found => return Ok(found),
            }
        }
    }

    fn syntax_error(&self, wanted: &str, found: Option<u8>) -> StateError {
        let found = match found {
            None => "the text ends".to_owned(),
            Some(byte) if byte.is_ascii_graphic() => format!("found `{}`", char::from(byte)),
            Some(byte) => format!("found byte 0x{byte:02x}"),
        };
        let state = match self.state {
            ParserState::Start | ParserState::End => String::new(),
            ParserState::First | ParserState::After => format!("state {}: ", self.index),
        };
        StateError::Text { line: self.line, message: format!("{state}expected {wanted}, but {found}") }
    }
}

#[cfg(test)]
mod tests {
    use super::{Elements, MAX_BYTES};

    /// An element may have 16 MiB, and not a byte more.
    #[test]
    fn elements_are_as_long_as_they_may_be() {
        for (length, is_fine) in [(MAX_BYTES, true), (MAX_BYTES + 1, false)] {
            let text = format!("[\"{}\"]", "x".repeat(length - 2));
            let mut elements = Elements::new(text.as_bytes());
            match elements.next_element() {
                Ok(element) => assert!(is_fine && element.is_some_and(|element| element.text.len() == length)),
                Err(error) => assert!(!is_fine && error.to_string().contains("a state of at most 16 MiB"), "{error}"),
            }
        }
    }
}
