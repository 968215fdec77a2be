//! Places of the values in a JSON text, as a tree of keys and indices: linear in time and memory, whatever the keys.

use std::borrow::Cow;
use std::collections::HashSet;

/// Largest depth of nested values, more than that of a state.
const MAX_DEPTH: usize = 16;

/// A value.
struct Place<'a> {
    /// Index of the value that it is in; the first has none, and refers to itself.
    within: usize,
    step: Step<'a>,
    offset: usize,
}

/// How a value is reached from the one that it is in.
#[derive(PartialEq, Eq, Hash)]
enum Step<'a> {
    Root,
    Key(Cow<'a, str>),
    Index(usize),
}

/// All values of a text in order, up to the first syntax error.
pub struct Places<'a>(Vec<Place<'a>>);

impl<'a> Places<'a> {
    /// The values of a text.
    pub fn of(text: &'a [u8]) -> Self {
        let mut scanner = Scanner { text, at: 0, found: Vec::new() };
        scanner.value(0, Step::Root, 0);
        Self(scanner.found)
    }

    /// Offset of the value at a path, such as `targets[1].mass`; of the last one, where a key is repeated.
    pub fn offset(&self, path: &str) -> Option<usize> {
        // how much of the path leads to each value, if it leads there
        let mut passed: Vec<Option<usize>> = Vec::with_capacity(self.0.len());
        for (index, place) in self.0.iter().enumerate() {
            let before = if index == 0 { Some(0) } else { passed[place.within] };
            passed
                .push(before.and_then(|passed| Some(passed + place.step.length_in(path.get(passed..)?, passed == 0)?)));
        }
        let found = passed.iter().rposition(|passed| *passed == Some(path.len()))?;
        Some(self.0[found].offset)
    }

    /// Path and offset of the last value before an offset.
    pub fn last_before(&self, offset: usize) -> Option<(String, usize)> {
        let index = self.0.partition_point(|place| place.offset < offset).checked_sub(1)?;
        Some((self.path(index), self.0[index].offset))
    }

    /// Path and offset of the first value whose key was there before in the same object.
    pub fn repeated(&self) -> Option<(String, usize)> {
        let mut seen = HashSet::new();
        let mut places = self.0.iter().enumerate();
        let (index, place) = places.find(|(_, place)| !seen.insert((place.within, &place.step)))?;
        Some((self.path(index), place.offset))
    }

    /// The path of a value.
    fn path(&self, index: usize) -> String {
        let mut steps = Vec::new();
        let mut index = index;
        while index != 0 {
            steps.push(&self.0[index].step);
            index = self.0[index].within;
        }
        let mut path = String::new();
        for step in steps.into_iter().rev() {
            match step {
                Step::Root => {}
                Step::Key(key) if path.is_empty() => path.push_str(key),
                Step::Key(key) => path.extend([".", key]),
                Step::Index(index) => path.extend(["[", &index.to_string(), "]"]),
            }
        }
        path
    }
}

impl Step<'_> {
    /// The length of its text where the rest of a path begins with it.
    fn length_in(&self, rest: &str, is_first: bool) -> Option<usize> {
        match self {
            Self::Root => Some(0),
            Self::Key(key) => {
                let dot = usize::from(!is_first);
                let after = if is_first { rest } else { rest.strip_prefix('.')? };
                after.starts_with(&**key).then_some(dot + key.len())
            }
            Self::Index(index) => {
                let text = format!("[{index}]");
                rest.starts_with(&text).then_some(text.len())
            }
        }
    }
}

struct Scanner<'a> {
    text: &'a [u8],
    at: usize,
    found: Vec<Place<'a>>,
}

impl<'a> Scanner<'a> {
    /// Scans a value; `None` at the end of the text or at a syntax error.
    fn value(&mut self, within: usize, step: Step<'a>, depth: usize) -> Option<()> {
        let first = self.skip_space()?;
        let own = self.found.len();
        self.found.push(Place { within, step, offset: self.at });
        match first {
            b'{' | b'[' if depth == MAX_DEPTH => None,
            b'{' => self.members(b'}', |scanner| {
                let key = scanner.string()?;
                (scanner.skip_space()? == b':').then_some(())?;
                scanner.at += 1;
                scanner.value(own, Step::Key(key), depth + 1)
            }),
            b'[' => {
                let mut index = 0;
                self.members(b']', |scanner| {
                    index += 1;
                    scanner.value(own, Step::Index(index - 1), depth + 1)
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

    /// Scans a string and returns its text; as it is written where its escape sequences are not valid.
    fn string(&mut self) -> Option<Cow<'a, str>> {
        (self.skip_space()? == b'"').then_some(())?;
        let start = self.at;
        self.at += 1;
        loop {
            match self.text.get(self.at)? {
                b'\\' => self.at += 2,
                b'"' => break,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        let quoted = self.text.get(start..self.at)?;
        let inside = quoted.get(1..quoted.len() - 1)?;
        if !inside.contains(&b'\\') {
            return Some(String::from_utf8_lossy(inside));
        }
        let text: Option<String> = serde_json::from_slice(quoted).ok();
        Some(text.map_or_else(|| String::from_utf8_lossy(inside), Cow::Owned))
    }

    fn skip_space(&mut self) -> Option<u8> {
        while self.text.get(self.at)?.is_ascii_whitespace() {
            self.at += 1;
        }
        self.text.get(self.at).copied()
    }
}
