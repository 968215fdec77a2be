//! The elements of a JSON array as text, one at a time.

use super::StateError;
use std::io::{self, BufRead};

/// No state comes near this size, in bytes.
const LARGEST: usize = 1 << 24;

/// One element.
pub struct Element<'a> {
    /// Counted from 0.
    pub index: usize,
    /// The line that it starts on, counted from 1.
    pub line: usize,
    /// Without the space around it; whether it is JSON is not known yet.
    pub text: &'a [u8],
}

/// Splits a text `[element, element, …]`.
pub struct Elements<R> {
    input: R,
    line: usize,
    /// Number of elements met so far.
    count: usize,
    place: Place,
    text: Vec<u8>,
}

/// What comes next.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// `[`.
    Start,
    /// An element or `]`.
    First,
    /// A comma or `]`.
    After,
    End,
}

impl<R: BufRead> Elements<R> {
    /// Nothing is read yet.
    pub fn new(input: R) -> Self {
        Self { input, line: 1, count: 0, place: Place::Start, text: Vec::new() }
    }

    /// The next element; `None` after the closing bracket and nothing but space.
    pub fn next_element(&mut self) -> Result<Option<Element<'_>>, StateError> {
        if self.place == Place::Start {
            match self.skip_space()? {
                Some(b'[') => self.input.consume(1),
                found => return Err(self.wrong("an array of states, `[{…}, …]`", found)),
            }
            self.place = Place::First;
        }
        match (self.place, self.skip_space()?) {
            (Place::First | Place::After, Some(b']')) => {
                self.input.consume(1);
                self.place = Place::End;
            }
            (Place::After, Some(b',')) => self.input.consume(1),
            (Place::After, found) => return Err(self.wrong("`,` or `]`", found)),
            _ => {}
        }
        let found = self.skip_space()?;
        if self.place == Place::End {
            return match found {
                None => Ok(None),
                found => Err(self.wrong("nothing after the array", found)),
            };
        }
        if matches!(found, None | Some(b',' | b']' | b'}')) {
            return Err(self.wrong("a state, `{…}`", found));
        }
        let line = self.line;
        self.read_text()?;
        self.place = Place::After;
        self.count += 1;
        Ok(Some(Element { index: self.count - 1, line, text: self.text.trim_ascii_end() }))
    }

    /// Takes the text up to the comma or bracket that ends it.
    fn read_text(&mut self) -> Result<(), StateError> {
        self.text.clear();
        let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
        loop {
            let Some(byte) = self.peek()? else {
                return Err(self.wrong("the end of this state, then `,` or `]`", None));
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
            if self.text.len() == LARGEST {
                return Err(self.wrong("a state of at most 16 MiB", Some(byte)));
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

    fn wrong(&self, wanted: &str, found: Option<u8>) -> StateError {
        let found = match found {
            None => "the text ends".to_owned(),
            Some(byte) if byte.is_ascii_graphic() => format!("found `{}`", char::from(byte)),
            Some(byte) => format!("found byte 0x{byte:02x}"),
        };
        let state = match self.place {
            Place::Start | Place::End => String::new(),
            Place::First | Place::After => format!("state {}: ", self.count),
        };
        StateError::Text { line: self.line, message: format!("{state}expected {wanted}, but {found}") }
    }
}
