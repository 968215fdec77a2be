//! Tables and values of a TOML document: access by key with a problem for each missing, unknown or invalid one.

mod value;

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

use toml::de::DeTable;

use super::document::{Document, table_name, without_indices};
use crate::format::{Default, Key, Shape, TableFormat};
use crate::names::{is_bare, listing, nearest};
use value::did_you_mean;

pub use value::Value;

/// The keys that a table may hold.
#[derive(Clone, Debug)]
pub(super) enum Keys<'a> {
    /// Those of a format.
    Of(&'static TableFormat),
    /// These, all with values of one shape, if that is known.
    Names(Vec<&'a str>, Option<&'static Shape>),
}

impl<'a> Keys<'a> {
    fn names(&self) -> Vec<&'a str> {
        match self {
            Self::Of(format) => format.names(),
            Self::Names(names, _) => names.clone(),
        }
    }
}

/// A table in a document, with the keys it may hold.
#[derive(Clone, Debug)]
pub struct Table<'a> {
    document: &'a Document,
    entries: &'a DeTable<'a>,
    span: Range<usize>,
    path: String,
    keys: Vec<&'a str>,
    format: Option<&'static TableFormat>,
    /// Of every value, where there is no format.
    shape: Option<&'static Shape>,
    /// Those that unknown keys are probably misspellings of.
    misspelt: Vec<&'a str>,
}

impl<'a> Table<'a> {
    /// The table; adds a problem for each key that it may not hold.
    pub(super) fn new(
        document: &'a Document,
        entries: &'a DeTable<'a>,
        span: Range<usize>,
        path: String,
        keys: &Keys<'a>,
    ) -> Self {
        let names = keys.names();
        let (format, shape) = match keys {
            Keys::Of(format) => (Some(*format), None),
            Keys::Names(_, shape) => (None, *shape),
        };
        document.add_table(&path, &names);
        let mut table = Self { document, entries, span, path, keys: names, format, shape, misspelt: Vec::new() };
        table.misspelt = table.report_unknown_keys();
        table
    }

    /// The value of a key, if given.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<Value<'a>> {
        let shape = self.format.and_then(|format| format.key(key)).map(|key| &key.shape).or(self.shape);
        self.value(key, shape)
    }

    /// The value of a key whose entry depends on a choice, if given.
    #[must_use]
    pub fn get_as(&self, key: &'static Key) -> Option<Value<'a>> {
        self.value(key.name, Some(&key.shape))
    }

    fn value(&self, key: &str, shape: Option<&'static Shape>) -> Option<Value<'a>> {
        self.entries.get(key).map(|value| Value::new(self.document, value, self.path_of(key), shape))
    }

    /// The entry of a key in the table's format.
    ///
    /// # Panics
    /// For a key that the format does not have.
    fn entry(&self, key: &str) -> &'static Key {
        self.format.and_then(|format| format.key(key)).expect("a key of the table's format")
    }

    /// The value of a key; a problem if it is missing, unless an unknown key is a misspelling of it.
    #[must_use]
    pub fn require(&self, key: &str) -> Option<Value<'a>> {
        let wanted = match self.entry(key).shape {
            Shape::Table(format) => {
                format!("a table `[{}]` with {}", self.path_of(key), listing(&format.names(), "and"))
            }
            Shape::Tables(_) => self.one_table(key),
            _ => self.wanted(key),
        };
        self.require_as(key, &wanted)
    }

    /// What the value of a key must be, as it reads after "expected".
    #[must_use]
    pub fn wanted(&self, key: &str) -> String {
        self.entry(key).shape.wanted()
    }

    /// As [`require`](Self::require), with words for what the value must be.
    #[must_use]
    pub fn require_as(&self, key: &str, wanted: &str) -> Option<Value<'a>> {
        let value = self.get(key);
        if value.is_none() && !self.is_misspelt(key) {
            let message = format!("missing key `{}`, expected {wanted}", self.path_of(key));
            let label = Some(format!("`{key}` is missing here"));
            self.document.report(&self.span, &message, label, None);
        }
        value
    }

    /// What `read` makes of the value of a key; the default where the key is not given.
    #[must_use]
    pub fn read_or<T>(&self, key: &str, default: T, read: impl FnOnce(&Value<'a>) -> Option<T>) -> Option<T> {
        self.get(key).map_or(Some(default), |value| read(&value))
    }

    /// A number, or its default.
    #[must_use]
    pub fn number(&self, key: &str) -> Option<f64> {
        match self.entry(key).default {
            Default::Number(default) => self.read_or(key, default, Value::number),
            _ => self.require(key)?.number(),
        }
    }

    /// A whole number, or its default.
    #[must_use]
    pub fn whole(&self, key: &str) -> Option<u64> {
        match self.entry(key).default {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it keeps the key's rule")]
            Default::Number(default) => self.read_or(key, default as u64, Value::whole),
            _ => self.require(key)?.whole(),
        }
    }

    /// A number, or nothing where it is not given.
    #[must_use]
    #[allow(clippy::option_option, reason = "None where it is invalid, Some(None) where it is not given")]
    pub fn optional_number(&self, key: &str) -> Option<Option<f64>> {
        self.read_or(key, None, |value| value.number().map(Some))
    }

    /// A text that must be given.
    #[must_use]
    pub fn text(&self, key: &str) -> Option<&'a str> {
        self.require(key)?.text()
    }

    /// A name that must be given and can be part of a file's name on any system, [`Shape::FILE_NAME`].
    #[must_use]
    pub fn file_name(&self, key: &str) -> Option<&'a str> {
        let value = self.require(key)?;
        let name = value.text()?;
        let allowed = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
        let is_valid = name.chars().all(allowed) && !name.starts_with('.') && name.len() <= 100;
        if !is_valid {
            value.expected(&format!("{}, at most 100 of them", value.wanted()), None);
        }
        is_valid.then_some(name)
    }

    /// A vector, or zeros where that is its default.
    #[must_use]
    pub fn vector<const N: usize>(&self, key: &str) -> Option<[f64; N]> {
        match self.entry(key).default {
            Default::Zeros => self.read_or(key, [0.0; N], Value::vector),
            _ => self.require(key)?.vector(),
        }
    }

    /// The choice that a text names, or the default one.
    #[must_use]
    pub fn choice<T: Copy>(&self, key: &str, choices: &[(&str, T)]) -> Option<T> {
        match (self.entry(key).default, self.get(key)) {
            (Default::Choice(default), None) => {
                choices.iter().find(|(name, _)| *name == default).map(|(_, choice)| *choice)
            }
            _ => self.require(key)?.choice(choices),
        }
    }

    /// A table that must be given.
    #[must_use]
    pub fn table(&self, key: &str) -> Option<Table<'a>> {
        self.require(key)?.table()
    }

    /// An array of tables, `[[key]]`: at least one if it must be given, else empty where it is not.
    #[must_use]
    pub fn tables(&self, key: &str) -> Option<Vec<Table<'a>>> {
        if self.entry(key).default != Default::Required {
            return self.read_or(key, Vec::new(), Value::tables);
        }
        let value = self.require(key)?;
        let tables = value.tables()?;
        if tables.is_empty() {
            value.expected(&self.one_table(key), None);
        }
        Some(tables)
    }

    /// "at least one `[[arm.link]]`".
    fn one_table(&self, key: &str) -> String {
        format!("at least one `[[{}]]`", without_indices(&self.path_of(key)))
    }

    /// Rejects each of the keys that is given.
    pub fn reject_keys(&self, keys: &[&str], why: &str) {
        for value in keys.iter().filter_map(|key| self.get(key)) {
            value.reject(why);
        }
    }

    /// Rejects each given key that its format has only with other choices of the key `selector`.
    pub fn reject_keys_without(&self, selector: &str, choice: &str, why: &str) {
        self.reject_keys(&self.keys_without(selector, choice), why);
    }

    /// The keys that its format has only with other choices of the key `selector`.
    #[must_use]
    pub fn keys_without(&self, selector: &str, choice: &str) -> Vec<&'static str> {
        self.format.map_or_else(Vec::new, |format| format.keys_without(selector, choice))
    }

    /// The entry of a key for this choice of the key `selector`.
    ///
    /// # Panics
    /// Where the format has none.
    #[must_use]
    pub fn entry_with(&self, key: &str, selector: &str, choice: &str) -> &'static Key {
        let entry = self.format.and_then(|format| format.variants(key).find(|key| key.is_with(selector, choice)));
        entry.expect("an entry of the table's format")
    }

    /// Adds a problem of the table as a whole.
    pub fn reject(&self, message: &str, label: &str) {
        self.document.report(&self.span, message, Some(label.to_owned()), None);
    }

    /// Adds a problem for every string under `key` of which the same is made, by `form`, as of that of an earlier table.
    pub fn reject_repeats(tables: &[Self], key: &str, form: impl Fn(&str) -> String, why: &str) {
        let mut first: HashMap<String, Value<'_>> = HashMap::new();
        for value in tables.iter().filter_map(|table| table.get(key)) {
            let Some(text) = value.as_str() else { continue };
            match first.entry(form(text)) {
                Entry::Occupied(first) => {
                    value.reject(&format!("the same as `{}`, but {why}", first.get().path()));
                }
                Entry::Vacant(place) => drop(place.insert(value)),
            }
        }
    }

    /// Whether an unknown key is probably a misspelling of this one.
    #[must_use]
    pub fn is_misspelt(&self, key: &str) -> bool {
        self.misspelt.contains(&key)
    }

    /// The key most similar to an unknown one, preferably one that is not given.
    fn similar_key(&self, unknown: &str) -> Option<&'a str> {
        let missing = self.keys.iter().copied().filter(|key| !self.entries.contains_key(*key));
        nearest(unknown, missing).or_else(|| nearest(unknown, self.keys.iter().copied()))
    }

    /// Adds a problem for each key that the table may not hold; returns those that are probably meant.
    fn report_unknown_keys(&self) -> Vec<&'a str> {
        let mut misspelt = Vec::new();
        for (key, value) in self.entries {
            let name = key.get_ref().as_ref();
            if self.keys.contains(&name) {
                continue;
            }
            let similar = self.similar_key(name);
            misspelt.extend(similar.filter(|similar| !misspelt.contains(similar)));
            let value = Value::new(self.document, value, self.path_of(name), None);
            let message = format!("unknown key `{}` ({})", value.path(), value.shown());
            let owner = self.document.owner_of(name, &self.path);
            let label = match owner {
                Some(owner) => Some(format!("this is a key of {owner}: write it further up")),
                None => similar.map(did_you_mean),
            };
            let help = format!("keys of {}: {}", table_name(&self.path), listing(&self.keys, "and"));
            self.document.report(&key.span(), &message, label, Some(help));
            if value.is_list_of_tables() {
                self.document.mark_unknown_table(name);
            }
        }
        misspelt
    }

    fn path_of(&self, key: &str) -> String {
        let key = if is_bare(key) { key.to_owned() } else { format!("{key:?}") };
        if self.path.is_empty() { key } else { format!("{}.{key}", self.path) }
    }
}

/// All results, or `None` if one is `None`; unlike `collect`, it computes each of them first.
pub fn every<T>(results: impl IntoIterator<Item = Option<T>>) -> Option<Vec<T>> {
    results.into_iter().collect::<Vec<_>>().into_iter().collect()
}

#[cfg(test)]
mod tests;
