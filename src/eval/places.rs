//! Where in a JSON text each value stands.

/// Deeper than any state.
const DEEPEST: usize = 16;

/// (path, offset) of every value in order, as far as the text is JSON: `targets[1].mass`.
pub fn places(text: &[u8]) -> Vec<(String, usize)> {
    let mut walk = Walk { text, at: 0, found: Vec::new() };
    walk.value("", 0);
    walk.found
}

struct Walk<'a> {
    text: &'a [u8],
    at: usize,
    found: Vec<(String, usize)>,
}

impl Walk<'_> {
    /// Walks over one value; `None` where the text ends or is no JSON.
    fn value(&mut self, path: &str, depth: usize) -> Option<()> {
        let first = self.skip_space()?;
        self.found.push((path.to_owned(), self.at));
        match first {
            b'{' | b'[' if depth == DEEPEST => None,
            b'{' => self.members(b'}', |walk| {
                let key = walk.string()?;
                (walk.skip_space()? == b':').then_some(())?;
                walk.at += 1;
                let path = if path.is_empty() { key } else { format!("{path}.{key}") };
                walk.value(&path, depth + 1)
            }),
            b'[' => {
                let mut index = 0;
                self.members(b']', |walk| {
                    index += 1;
                    walk.value(&format!("{path}[{}]", index - 1), depth + 1)
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

    /// Walks over what stands between brackets, the opening one being next.
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

    /// Walks over a string, and returns it as it is written.
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
