//! A table of keys, and what the value of a key is, which may be a table again.

use super::number_rule::form;
use super::{Choice, Count, Default, Example, NumberRule, With};
use crate::names::listing;

/// What a table of a file may hold.
#[derive(Debug)]
pub struct TableFormat {
    /// What it describes: a sentence in Markdown.
    pub doc: &'static str,
    /// Its keys, in the order in which they are written.
    pub keys: &'static [Key],
    /// Exactly one of these keys is given; empty where there is no such rule.
    pub one_of: &'static [&'static str],
}

/// A key that a table may hold.
///
/// A key whose unit or default depends on a choice has an entry for each of them, see [`With`].
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// As it is written.
    pub name: &'static str,
    /// What its value is.
    pub shape: Shape,
    /// What holds where it is not given.
    pub default: Default,
    /// What it means: a phrase in lower case without a stop, in Markdown.
    pub doc: &'static str,
    /// Where alone it may be given.
    pub with: Option<With>,
    /// Its value in a file to start from.
    pub example: Example,
}

/// What a value is, from one text to a list of tables.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    /// Text of one line; what it is, "a name".
    Text(&'static str),
    /// One of these texts.
    Choice(fn() -> Vec<Choice>),
    /// A number.
    Number(NumberRule),
    /// A number, or `[]` for none.
    NumberOrNone(NumberRule),
    /// A number, a text, or `true` or `false`; with the rule of the number.
    Scalar(NumberRule),
    /// A list with one number for each component, `[x, y]`.
    Vector(&'static [NumberRule]),
    /// One of several such lists, by their lengths; one without components is `[]`.
    OneOf(&'static [&'static [NumberRule]]),
    /// A list.
    List(&'static Shape, Count),
    /// One for all, or a list.
    OneOrList(&'static Shape, Count),
    /// A table whose keys are the names of something, "target".
    ByName(&'static Shape, &'static str),
    /// A table.
    Table(&'static TableFormat),
    /// A list of tables.
    Tables(&'static TableFormat),
}

impl TableFormat {
    /// The names of its keys, each once.
    #[must_use]
    pub fn names(&self) -> Vec<&'static str> {
        let mut names: Vec<_> = self.keys.iter().map(|key| key.name).collect();
        names.dedup();
        names
    }

    /// The entries of a key: none for an unknown one, several where they depend on a choice.
    pub fn variants(&'static self, name: &str) -> impl Iterator<Item = &'static Key> {
        self.keys.iter().filter(move |key| key.name == name)
    }

    /// The first entry of a key.
    #[must_use]
    pub fn key(&'static self, name: &str) -> Option<&'static Key> {
        self.variants(name).next()
    }

    /// The names of its keys that may not be given with this choice of the key `selector`.
    #[must_use]
    pub fn keys_without(&'static self, selector: &str, choice: &str) -> Vec<&'static str> {
        let mut names = self.names();
        names.retain(|name| !self.variants(name).any(|key| key.is_with(selector, choice)));
        names
    }
}

impl Key {
    /// One that must be given.
    #[must_use]
    pub const fn required(name: &'static str, shape: Shape, doc: &'static str) -> Self {
        Self::optional(name, shape, Default::Required, doc)
    }

    /// One that need not be given.
    #[must_use]
    pub const fn optional(name: &'static str, shape: Shape, default: Default, doc: &'static str) -> Self {
        Self { name, shape, default, doc, with: None, example: Example::Default }
    }

    /// Only with these choices of another key.
    #[must_use]
    pub const fn with(self, key: &'static str, choices: &'static [&'static str]) -> Self {
        Self { with: Some(With::Choice(key, choices)), ..self }
    }

    /// Only beside one of these keys.
    #[must_use]
    pub const fn beside(self, keys: &'static [&'static str]) -> Self {
        Self { with: Some(With::Key(keys)), ..self }
    }

    /// With this value in a file to start from.
    #[must_use]
    pub const fn start(self, toml: &'static str) -> Self {
        Self { example: Example::Start(toml), ..self }
    }

    /// With so many tables in a file to start from.
    #[must_use]
    pub const fn entries(self, count: usize) -> Self {
        Self { example: Example::Entries(count), ..self }
    }

    /// With this value, as a comment, in a file to start from.
    #[must_use]
    pub const fn example(self, toml: &'static str) -> Self {
        Self { example: Example::Comment(toml), ..self }
    }

    /// Whether it may be given with this choice of another key.
    #[must_use]
    pub fn is_with(&self, selector: &str, choice: &str) -> bool {
        match self.with {
            Some(With::Choice(key, choices)) if key == selector => choices.contains(&choice),
            _ => true,
        }
    }
}

impl Shape {
    /// A name that can be part of a file's name on any system.
    pub const FILE_NAME: Self =
        Self::Text("a name that files can have (ASCII letters, digits, `-`, `_` and `.`, not `.` first)");

    /// A description for messages, as it reads after "expected".
    #[must_use]
    pub fn wanted(&self) -> String {
        match self {
            Self::Text(what) => (*what).to_owned(),
            Self::Choice(choices) => listing(&names(*choices), "or"),
            Self::Number(rule) => rule.to_string(),
            Self::NumberOrNone(rule) => format!("{rule}, or []"),
            Self::Scalar(rule) => format!("{rule}, a text, or `true` or `false`"),
            Self::Vector(components) => form(components),
            Self::OneOf(vectors) => {
                let forms: Vec<_> = vectors.iter().map(|vector| form(vector)).collect();
                forms.join(" or ")
            }
            Self::List(item, count) => format!("a list: {}, {}", item.wanted(), count.words()),
            Self::OneOrList(item, count) => format!("{}, or a list, {}", item.wanted(), count.words()),
            Self::ByName(item, of) => format!("a table with the name of a {of} for a key, and {}", item.wanted()),
            Self::Table(format) => format!("a table with {}", listing(&format.names(), "and")),
            Self::Tables(format) => format!("a list of tables with {}", listing(&format.names(), "and")),
        }
    }

    /// What can be chosen, also for each element of a list; `None` where it is no choice.
    #[must_use]
    pub fn choices(&self) -> Option<Vec<Choice>> {
        match self {
            Self::Choice(choices) => Some(choices()),
            Self::List(item, _) | Self::OneOrList(item, _) => item.choices(),
            _ => None,
        }
    }

    /// Whether one scalar, not a list or a table, is a value of it.
    #[must_use]
    pub fn is_scalar(&self) -> bool {
        match self {
            Self::Text(_) | Self::Choice(_) | Self::Number(_) | Self::NumberOrNone(_) | Self::Scalar(_) => true,
            Self::OneOrList(item, _) => item.is_scalar(),
            _ => false,
        }
    }

    /// The rule of a number, also of one that holds for all elements of a list.
    #[must_use]
    pub fn rule(&self) -> Option<&NumberRule> {
        match self {
            Self::Number(rule) | Self::NumberOrNone(rule) | Self::Scalar(rule) => Some(rule),
            Self::OneOrList(item, _) => item.rule(),
            _ => None,
        }
    }

    /// The components of a vector of this length, also of one that holds for all elements of a list.
    #[must_use]
    pub fn components(&self, length: usize) -> Option<&'static [NumberRule]> {
        match self {
            Self::Vector(components) => Some(components),
            Self::OneOf(vectors) => vectors.iter().copied().find(|components| components.len() == length),
            Self::OneOrList(item, _) => item.components(length),
            _ => None,
        }
    }
}

/// The names of choices.
fn names(choices: fn() -> Vec<Choice>) -> Vec<&'static str> {
    choices().iter().map(|choice| choice.name).collect()
}
