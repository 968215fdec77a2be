//! Offsets of the values in a JSON text.

/// Largest depth of nested values, more than that of a state.
const MAX_DEPTH: usize = 16;

/// (path, such as `targets[1].mass`; offset) of every value in order, up to the first syntax error.
pub fn offsets(text: &[u8]) -> Vec<(String, usize)> {
    let mut scanner = Scanner { text, at: 0, found: Vec::new() };
    scanner.value("", 0);
    scanner.found
}

struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
    found: Vec<(String, usize)>,
}

impl Scanner<'_> {
    /// Scans a value; `None` at the end of the text or at a syntax error.
    fn value(&mut self, path: &str, depth: usize) -> Option<()> {
        let first = self.skip_space()?;
        self.found.push((path.to_owned(), self.at));
        match first {
            b'{' | b'[' if depth == MAX_DEPTH => None,
            b'{' => self.members(b'}', |scanner| {
                let key = scanner.string()?;
                (scanner.skip_space()? == b':').then_some(())?;
                scanner.at += 1;
                let path = if path.is_empty() { key } else { format!("{path}.{key}") };
                scanner.value(&path, depth + 1)
            }),
            b'[' => {
                let mut index = 0;
                self.members(b']', |scanner| {
                    index += 1;
                    scanner.value(&format!("{path}[{}]", index - 1), depth + 1)
                })
            }
            b'"' => self.string().map(drop),
            _ => {
                let rest = self.text.get(self.at..)?;
                let length = rest.iter().position(|b| b",]}:\" \t\r\n".contains(b)).unwrap_or(rest.len());
                self.at += length;
                (length > 0).then_some(())
            }
        }
    }

    /// Scans the members between brackets, from the opening one.
    fn members(&mut self, close: u8, mut member: impl FnMut(&mut Self) -> Option<()>) -> Option<()> {
        self.at += 1;
        while self.skip_space()? != close {
            member(self)?;
            match self.skip_space()? {
                b',' => self.at += 1,
                byte if byte == close => {}
                _ => return None,
            }
        }
        self.at += 1;
        Some(())
    }

    /// Scans a string and returns its text, with its escape sequences.
    fn string(&mut self) -> Option<String> {
        (self.skip_space()? == b'"').then_some(())?;
        let start = self.at + 1;
        self.at = start;
        loop {
            match self.text.get(self.at)? {
                b'\\' => self.at += 2,
                b'"' => break,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        Some(String::from_utf8_lossy(self.text.get(start..self.at - 1)?).into_owned())
    }

    fn skip_space(&mut self) -> Option<u8> {
        while self.text.get(self.at)?.is_ascii_whitespace() {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }
}
