//! Tables and values of a TOML document: access by key with a problem for each missing, unknown or invalid one.

mod value;

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;

use toml::de::DeTable;

use super::document::{Document, table_name};
use super::number_rule::{NumberRule, form};
use super::{listing, nearest};
use value::did_you_mean;

pub use value::Value;

/// A table in a document, with the keys it may hold.
#[derive(Clone, Debug)]
pub struct Table<'a> {
    document: &'a Document,
    entries: &'a DeTable<'a>,
    span: Range<usize>,
    path: String,
    keys: Vec<&'a str>,
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
        keys: &[&'a str],
    ) -> Self {
        document.add_table(&path, keys);
        let mut table = Self { document, entries, span, path, keys: keys.to_vec(), misspelt: Vec::new() };
        table.misspelt = table.report_unknown_keys();
        table
    }

    /// The value of a key, if given.
    #[must_use]
    pub fn get(&self, key: &str) -> Option<Value<'a>> {
        self.entries.get(key).map(|value| Value::new(self.document, value, self.path_of(key)))
    }

    /// The value of a key; a problem if it is missing, unless an unknown key is a misspelling of it.
    #[must_use]
    pub fn require(&self, key: &str, wanted: &str) -> Option<Value<'a>> {
        let value = self.get(key);
        if value.is_none() && !self.is_misspelt(key) {
            let message = format!("missing key `{}`, expected {wanted}", self.path_of(key));
            let label = Some(format!("`{key}` is missing here"));
            self.document.report(&self.span, &message, label, None);
        }
        value
    }

    /// A number that must be given.
    #[must_use]
    pub fn number(&self, key: &str, quantity: &NumberRule) -> Option<f64> {
        self.require(key, &quantity.to_string())?.number(quantity)
    }

    /// A number, or the default where the key is not given.
    #[must_use]
    pub fn number_or(&self, key: &str, quantity: &NumberRule, default: f64) -> Option<f64> {
        self.get(key).map_or(Some(default), |value| value.number(quantity))
    }

    /// A string that must be given; `wanted` describes it.
    #[must_use]
    pub fn text(&self, key: &str, wanted: &str) -> Option<&'a str> {
        self.require(key, wanted)?.text(wanted)
    }

    /// A vector that must be given.
    #[must_use]
    pub fn vector<const N: usize>(&self, key: &str, components: &[NumberRule; N]) -> Option<[f64; N]> {
        self.require(key, &form(components))?.vector(components)
    }

    /// A vector, or the default where the key is not given.
    #[must_use]
    pub fn vector_or<const N: usize>(
        &self,
        key: &str,
        components: &[NumberRule; N],
        default: [f64; N],
    ) -> Option<[f64; N]> {
        self.get(key).map_or(Some(default), |value| value.vector(components))
    }

    /// A table that must be given, with the keys that it may hold.
    #[must_use]
    pub fn table(&self, key: &str, keys: &[&'a str]) -> Option<Table<'a>> {
        let wanted = format!("a table `[{}]` with {}", self.path_of(key), listing(keys, "and"));
        self.require(key, &wanted)?.table(keys)
    }

    /// An array of tables, `[[key]]`, with the keys that each may hold; empty where not given.
    #[must_use]
    pub fn tables(&self, key: &str, keys: &[&'a str]) -> Option<Vec<Table<'a>>> {
        self.get(key).map_or(Some(Vec::new()), |value| value.tables(keys))
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
            let value = Value::new(self.document, value, self.path_of(name));
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
        let bare = !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
        let key = if bare { key.to_owned() } else { format!("{key:?}") };
        if self.path.is_empty() { key } else { format!("{}.{key}", self.path) }
    }
}

/// All results, or `None` if one is `None`; unlike `collect`, it computes each of them first.
pub fn every<T>(results: impl IntoIterator<Item = Option<T>>) -> Option<Vec<T>> {
    results.into_iter().collect::<Vec<_>>().into_iter().collect()
}
