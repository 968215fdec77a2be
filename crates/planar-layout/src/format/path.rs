//! Paths to a key of a file: `target."my.t".mass`, `arm.arm1.link[0].mass`, `approach.proportional_gain[2]`.

use super::{Count, Key, NumberRule, Shape, TableFormat};
use crate::names::{is_bare, is_bare_letter, listing, nearest};
use std::fmt;
use toml::de::DeTable;

/// A key's place in a file, by its format alone: whether a table of that name or index is there is not looked at.
#[derive(Clone, Debug)]
pub struct Place {
    /// The steps from the file's root.
    pub steps: Vec<Step>,
    /// The entries of the last key that the path names: several where they depend on a choice of another key.
    pub keys: Vec<&'static Key>,
    /// What the value at the path is; of several entries that of the first, which differs from the others in range, unit
    /// and default alone.
    pub shape: ShapeAt,
}

/// What is at the end of a path.
#[derive(Clone, Copy, Debug)]
pub enum ShapeAt {
    /// A value with a shape of its own.
    Whole(&'static Shape),
    /// A component of a vector.
    Component(&'static NumberRule),
}

/// A step of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// To the value of a key.
    Key(String),
    /// To the table of an array whose key `name` has this value.
    Named(String),
    /// To an element of an array, from 0.
    Index(usize),
}

/// Why a path leads to no key.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{path}`: {why}")]
pub struct NoKey {
    /// The path, as given.
    pub path: String,
    /// What is wrong, and what would be right.
    pub why: String,
    /// The path with the most similar key, where there is one.
    pub nearest: Option<String>,
}

impl Place {
    /// The rule of the number at the path; `None` where there is no single number. One number that holds for all elements
    /// of a list is single.
    #[must_use]
    pub fn number(&self) -> Option<&'static NumberRule> {
        match self.shape {
            ShapeAt::Whole(shape) => shape.rule(),
            ShapeAt::Component(rule) => Some(rule),
        }
    }
}

/// The place of a path in a file of this format.
///
/// Keys are joined by points; names that are not of letters, digits, `-` and `_` are quoted as in TOML. Tables of an array
/// are given by their `name`, or where they have none by their index from 0, and so are elements of lists.
///
/// # Errors
/// [`NoKey`] with the nearest path, where there is one.
pub fn find(root: &'static TableFormat, path: &str) -> Result<Place, NoKey> {
    let fail = |why: String| NoKey { path: path.to_owned(), why, nearest: None };
    let mut walk = Walk { path, tokens: tokens(path).map_err(fail)?, next: 0, steps: Vec::new() };
    walk.table(root)
}

/// As [`find`], of a path that starts with the key `first`, which is no part of the file: its keys are counted, and shown,
/// from there. `None` where it does not start so, or ends there.
///
/// # Errors
/// Those of [`find`].
#[must_use]
pub fn find_below(first: &str, root: &'static TableFormat, path: &str) -> Option<Result<Place, NoKey>> {
    let tokens = tokens(path).ok()?;
    let is_below = tokens.len() > 1 && matches!(&tokens[0].part, Part::Name(name) if name == first);
    is_below.then(|| Walk { path, tokens, next: 1, steps: Vec::new() }.table(root))
}

/// A part of a path with its end in the text.
struct Token {
    part: Part,
    end: usize,
}

enum Part {
    Name(String),
    Index(usize),
}

struct Walk<'a> {
    path: &'a str,
    tokens: Vec<Token>,
    /// The index of the next token.
    next: usize,
    steps: Vec<Step>,
}

impl Walk<'_> {
    /// From a table, over one of its keys.
    fn table(&mut self, format: &'static TableFormat) -> Result<Place, NoKey> {
        let names = format.names();
        let Some(Part::Name(name)) = self.part() else {
            return Err(self.fail(&format!("expected a key of it: {}", listing(&names, "or"))));
        };
        let name = name.clone();
        let keys: Vec<_> = format.variants(&name).collect();
        let Some(first) = keys.first() else { return Err(self.unknown(&name, &names)) };
        self.next += 1;
        self.steps.push(Step::Key(name));
        self.value(&first.shape, &keys)
    }

    /// From the value of a key, over what follows.
    fn value(&mut self, shape: &'static Shape, keys: &[&'static Key]) -> Result<Place, NoKey> {
        let Some(part) = self.part() else {
            let shape = ShapeAt::Whole(shape);
            return Ok(Place { steps: std::mem::take(&mut self.steps), keys: keys.to_vec(), shape });
        };
        match (shape, part) {
            (Shape::Table(format), _) => self.table(format),
            (Shape::Tables(format), _) => {
                let step = match (format.key("name"), part) {
                    (Some(_), Part::Name(name)) => Step::Named(name.clone()),
                    (None, Part::Index(index)) => Step::Index(*index),
                    (Some(_), Part::Index(_)) => return Err(self.fail("these tables have names, expected one of them")),
                    (None, Part::Name(_)) => {
                        return Err(self.fail("these tables have no names, expected an index from 0, `[0]`"));
                    }
                };
                self.step(step);
                if self.part().is_some() { self.table(format) } else { self.value(shape, keys) }
            }
            (Shape::ByName(item, _), Part::Name(name)) => {
                let step = Step::Key(name.clone());
                self.step(step);
                self.value(item, keys)
            }
            (Shape::List(item, count) | Shape::OneOrList(item, count), Part::Index(index)) => {
                let index = *index;
                if let Count::Exactly(length) = count
                    && index >= *length
                {
                    return Err(self.fail(&format!("it has {length} elements, expected an index less than that")));
                }
                // one vector for all of a list: the index may be that of a component
                let is_last = self.tokens.len() == self.next + 1;
                if let (Shape::OneOrList(..), Some(components), true) = (shape, longest(item), is_last) {
                    return self.component(components, index, keys);
                }
                self.step(Step::Index(index));
                self.value(item, keys)
            }
            (Shape::Vector(_) | Shape::OneOf(_), Part::Index(index)) => {
                let index = *index;
                self.component(longest(shape).unwrap_or_default(), index, keys)
            }
            (_, part) => {
                let why = match part {
                    Part::Index(_) => format!("it is {}, which has no elements", shape.wanted()),
                    Part::Name(_) => format!("it is {}, which has no keys", shape.wanted()),
                };
                Err(self.fail(&why))
            }
        }
    }

    fn component(
        &mut self,
        components: &'static [NumberRule],
        index: usize,
        keys: &[&'static Key],
    ) -> Result<Place, NoKey> {
        let Some(rule) = components.get(index) else {
            let wanted = Shape::Vector(components).wanted();
            return Err(self.fail(&format!("it is {wanted}, expected an index less than {}", components.len())));
        };
        self.step(Step::Index(index));
        if self.part().is_some() {
            return Err(self.fail("it is a number, expected the end of the path"));
        }
        Ok(Place { steps: std::mem::take(&mut self.steps), keys: keys.to_vec(), shape: ShapeAt::Component(rule) })
    }

    fn part(&self) -> Option<&Part> {
        self.tokens.get(self.next).map(|token| &token.part)
    }

    fn step(&mut self, step: Step) {
        self.steps.push(step);
        self.next += 1;
    }

    /// The path up to the next token.
    fn before(&self) -> &str {
        &self.path[..self.next.checked_sub(1).map_or(0, |last| self.tokens[last].end)]
    }

    fn fail(&self, why: &str) -> NoKey {
        let before = self.before();
        let why = if before.is_empty() { why.to_owned() } else { format!("at `{before}`: {why}") };
        NoKey { path: self.path.to_owned(), why, nearest: None }
    }

    fn unknown(&self, name: &str, names: &[&str]) -> NoKey {
        let before = self.before();
        let of = if before.is_empty() { "the top level".to_owned() } else { format!("`{before}`") };
        let near = nearest(name, names.iter().copied());
        let joint = if before.is_empty() { "" } else { "." };
        let rest = &self.path[self.tokens[self.next].end..];
        let nearest = near.map(|near| format!("{before}{joint}{near}{rest}"));
        let right = match &nearest {
            Some(path) => format!("; did you mean `{path}`?"),
            None => format!(", expected {}", listing(names, "or")),
        };
        let why = format!("{of} has no key `{name}`{right}");
        NoKey { path: self.path.to_owned(), why, nearest }
    }
}

/// The components of a vector, of several the longest.
fn longest(shape: &'static Shape) -> Option<&'static [NumberRule]> {
    match shape {
        Shape::Vector(components) => Some(components),
        Shape::OneOf(vectors) => vectors.iter().copied().max_by_key(|vector| vector.len()),
        _ => None,
    }
}

/// A key as it is written in a path: quoted where it needs to be.
#[must_use]
pub fn quoted_key(name: &str) -> String {
    if is_bare(name) { name.to_owned() } else { toml::Value::from(name).to_string() }
}

/// The parts of a path.
fn tokens(path: &str) -> Result<Vec<Token>, String> {
    let mut tokens: Vec<Token> = Vec::new();
    let mut at = 0;
    while at < path.len() || tokens.is_empty() {
        let rest = &path[at..];
        if let Some(index) = rest.strip_prefix('[').filter(|_| !tokens.is_empty()) {
            let digits = index.find(']').map(|end| &index[..end]);
            let number = digits.filter(|digits| digits.chars().all(|c| c.is_ascii_digit()));
            let number = number.and_then(|digits| digits.parse().ok());
            let (Some(digits), Some(number)) = (digits, number) else {
                return Err(format!("`{rest}` is no index, expected `[0]`, `[1]` …"));
            };
            at += digits.len() + 2;
            tokens.push(Token { part: Part::Index(number), end: at });
            continue;
        }
        let rest = if tokens.is_empty() {
            rest
        } else {
            at += 1;
            rest.strip_prefix('.').ok_or_else(|| format!("expected `.` or `[` before `{rest}`"))?
        };
        let length = key_length(rest).filter(|length| *length > 0);
        let name = length.and_then(|length| name(&rest[..length]));
        let (Some(length), Some(name)) = (length, name) else {
            return Err(format!("expected a key at `{rest}`, in quotes unless it is of letters, digits, `-` and `_`"));
        };
        at += length;
        tokens.push(Token { part: Part::Name(name), end: at });
    }
    Ok(tokens)
}

/// The length of the key at the start of a text.
fn key_length(text: &str) -> Option<usize> {
    let Some(quote) = text.chars().next().filter(|c| matches!(c, '"' | '\'')) else {
        return Some(text.find(|c| !is_bare_letter(c)).unwrap_or(text.len()));
    };
    let mut is_escaped = false;
    let end = text.char_indices().skip(1).find(|(_, c)| {
        let ends = *c == quote && !is_escaped;
        is_escaped = quote == '"' && *c == '\\' && !is_escaped;
        ends
    });
    end.map(|(at, _)| at + 1)
}

/// The name that a key, quoted or not, stands for.
fn name(key: &str) -> Option<String> {
    if is_bare(key) {
        return Some(key.to_owned());
    }
    let text = format!("{key} = 0");
    let table = DeTable::parse(&text).ok()?;
    table.get_ref().keys().next().map(|key| key.get_ref().to_string())
}

impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key(name) | Self::Named(name) => f.write_str(&quoted_key(name)),
            Self::Index(index) => write!(f, "[{index}]"),
        }
    }
}

#[cfg(test)]
mod tests;
