//! Values of a TOML document: every accessor returns `None` and adds a problem where the value is not valid.

use std::ops::Range;

use toml::Spanned;
use toml::de::DeValue;

use super::{Keys, Table, every};
use crate::diagnostic::document::Document;
use crate::diagnostic::{Report, excerpt, is_hidden};
use crate::format::{NumberRule, Refusal, Shape, form, quoted_key};
use crate::names::{listing, nearest};

/// A value in a document, with its path from the root: `arm[1].link[0].mass`.
#[derive(Clone, Debug)]
pub struct Value<'a> {
    document: &'a Document,
    tree: &'a DeValue<'a>,
    span: Range<usize>,
    path: String,
    /// What it is by the format of its file; `None` for the value of an unknown key.
    shape: Option<&'static Shape>,
}

/// The panic of a reader that asks for what the format of its file does not have.
const OTHER_SHAPE: &str = "a value of the shape that its format has";

impl<'a> Value<'a> {
    pub(in crate::diagnostic) fn new(
        document: &'a Document,
        value: &'a Spanned<DeValue<'a>>,
        path: String,
        shape: Option<&'static Shape>,
    ) -> Self {
        Self { document, tree: value.get_ref(), span: value.span(), path, shape }
    }

    /// The path from the root of the document.
    #[must_use]
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The text, if this is a string; adds no problem.
    #[must_use]
    pub fn as_str(&self) -> Option<&'a str> {
        self.tree.as_str()
    }

    /// `true` or `false`, if this is one; adds no problem.
    #[must_use]
    pub fn as_bool(&self) -> Option<bool> {
        self.tree.as_bool()
    }

    /// Whether this is an array.
    #[must_use]
    pub fn is_array(&self) -> bool {
        self.tree.is_array()
    }

    /// Whether this is a table.
    #[must_use]
    pub fn is_table(&self) -> bool {
        self.tree.is_table()
    }

    /// What the value must be by the format of its file, as it reads after "expected".
    ///
    /// # Panics
    /// Where the format has no such key; so the accessors below, where it has another kind of value here.
    #[must_use]
    pub fn wanted(&self) -> String {
        self.shape.expect(OTHER_SHAPE).wanted()
    }

    /// Adds a problem: the value is not what is wanted.
    pub fn expected(&self, wanted: &str, help: Option<String>) {
        let message = format!("`{}` is {}, expected {wanted}", self.path, self.shown());
        self.document.report(&self.span, &message, None, help);
    }

    /// Adds a problem: the value is none of the names; it shows the most similar one.
    pub fn expected_one_of(&self, names: &[&str], help: Option<&str>) {
        let (path, shown, wanted) = (&self.path, self.shown(), listing(names, "or"));
        let message = format!("`{path}` is {shown}, expected {wanted}");
        let near = self.as_str().and_then(|text| nearest(text, names.iter().copied()));
        let (label, help) = (near.map(did_you_mean), help.map(str::to_owned));
        self.document.report(&self.span, &message, label, help);
    }

    /// Adds a problem with the reason for which the value is not valid.
    pub fn reject(&self, why: &str) {
        let message = format!("`{}` is {}: {why}", self.path, self.shown());
        self.document.report(&self.span, &message, None, None);
    }

    /// Adds the problems of a file that this value names.
    pub fn adopt(&self, report: Report) {
        let value = format!("`{}` is {}", self.path, self.shown());
        self.document.adopt(&self.span, &value, report);
    }

    /// The value as in the source, or the kind of a table with a header.
    pub(in crate::diagnostic) fn shown(&self) -> String {
        match (self.tree, self.document.text(&self.span)) {
            _ if self.has_header() => "a table".to_owned(),
            (DeValue::Array(_), _) if self.is_list_of_tables() => "a list of tables".to_owned(),
            (_, text) => excerpt(text),
        }
    }

    /// Whether the value is a table that is not written in braces.
    pub(in crate::diagnostic) fn has_header(&self) -> bool {
        matches!(self.tree, DeValue::Table(_)) && !self.document.text(&self.span).starts_with('{')
    }

    /// Whether the value is written `[[key]]`.
    pub(super) fn is_list_of_tables(&self) -> bool {
        let DeValue::Array(items) = self.tree else { return false };
        items.first().is_some_and(|item| item.span() == self.span)
    }

    /// A number, integer or not, in the range of its quantity.
    ///
    /// # Panics
    /// See [`wanted`](Self::wanted).
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        self.number_of(self.shape.and_then(Shape::rule).expect(OTHER_SHAPE))
    }

    /// A number that can only be whole and is not negative.
    ///
    /// # Panics
    /// See [`wanted`](Self::wanted).
    #[must_use]
    pub fn whole(&self) -> Option<u64> {
        let rule = self.shape.and_then(Shape::rule).filter(|rule| rule.is_whole()).expect(OTHER_SHAPE);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers are not negative")]
        self.number_of(rule).map(|number| number as u64)
    }

    /// A number in a range that the file's format does not have: that of a table with any keys.
    #[must_use]
    pub fn number_by(&self, rule: &NumberRule) -> Option<f64> {
        self.number_of(rule)
    }

    fn number_of(&self, quantity: &NumberRule) -> Option<f64> {
        let number = match self.tree {
            DeValue::Float(float) => float.as_str().parse().ok(),
            DeValue::Integer(integer) if integer.radix() == 10 => integer.as_str().parse().ok(),
            DeValue::Integer(integer) => u32::from_str_radix(integer.as_str(), integer.radix()).ok().map(f64::from),
            _ => None,
        };
        let is_quoted = || self.as_str().is_some_and(|text| text.trim().parse::<f64>().is_ok());
        let outcome = match number {
            Some(number) => quantity.check(number).map(|()| number),
            None => Err(Refusal::Hint(is_quoted().then(|| "write the number without quotes".to_owned()))),
        };
        let refuse = |refusal| match refusal {
            Refusal::Hint(help) => self.expected(&quantity.to_string(), help),
            Refusal::Reason(why) => self.reject(&why),
        };
        outcome.map_err(refuse).ok()
    }

    /// The elements of an array; `wanted` describes the array.
    #[must_use]
    pub fn items(&self, wanted: &str) -> Option<Vec<Self>> {
        let DeValue::Array(items) = self.tree else {
            self.expected(wanted, None);
            return None;
        };
        let shape = self.shape.and_then(|shape| match shape {
            Shape::List(item, _) | Shape::OneOrList(item, _) => Some(*item),
            _ => None,
        });
        let item = |(index, value)| Self::new(self.document, value, format!("{}[{index}]", self.path), shape);
        Some(items.iter().enumerate().map(item).collect())
    }

    /// An array with one number for each component, `[x, y]`.
    ///
    /// # Panics
    /// See [`wanted`](Self::wanted).
    #[must_use]
    pub fn vector<const N: usize>(&self) -> Option<[f64; N]> {
        let components = self.shape.and_then(|shape| shape.components(N)).expect(OTHER_SHAPE);
        let items = self.items(&form(components))?;
        if items.len() != N {
            self.expected(&form(components), None);
            return None;
        }
        let pairs = items.iter().zip(components);
        let numbers: Option<Vec<_>> = pairs.map(|(item, component)| item.number_of(component)).collect();
        numbers?.try_into().ok()
    }

    /// A string of one line that is not blank and has no hidden characters, see [`is_hidden`].
    #[must_use]
    pub fn text(&self) -> Option<&'a str> {
        self.text_as(&self.wanted())
    }

    /// As [`text`](Self::text), with words for what it must be.
    #[must_use]
    pub fn text_as(&self, wanted: &str) -> Option<&'a str> {
        let text = self.as_str().filter(|text| !text.trim().is_empty() && !text.contains(is_hidden));
        if text.is_none() {
            let wanted = format!("{wanted}: text in quotes, on one line, not blank, without hidden characters");
            self.expected(&wanted, None);
        }
        text
    }

    /// The choice that a string names.
    #[must_use]
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Option<T> {
        let chosen = choices.iter().find(|(name, _)| self.as_str() == Some(name));
        if chosen.is_none() {
            let names: Vec<_> = choices.iter().map(|(name, _)| *name).collect();
            self.expected_one_of(&names, None);
        }
        chosen.map(|(_, choice)| *choice)
    }

    /// A table with the keys of its format.
    #[must_use]
    pub fn table(&self) -> Option<Table<'a>> {
        match self.shape {
            Some(Shape::Table(format) | Shape::Tables(format)) => self.table_with(&Keys::Of(format)),
            _ => unreachable!("{OTHER_SHAPE}"),
        }
    }

    /// A table with these names as keys.
    #[must_use]
    pub fn by_name(&self, names: &[&'a str]) -> Option<Table<'a>> {
        let shape = self.shape.and_then(|shape| match shape {
            Shape::ByName(item, _) => Some(*item),
            _ => None,
        });
        self.table_with(&Keys::Names(names.to_vec(), shape))
    }

    /// The keys of a table that may have any, with their values, sorted.
    ///
    /// # Panics
    /// See [`wanted`](Self::wanted).
    #[must_use]
    pub fn entries(&self) -> Option<Vec<(String, Self)>> {
        let Some(Shape::ByName(item, _)) = self.shape else { unreachable!("{OTHER_SHAPE}") };
        let DeValue::Table(entries) = self.tree else {
            self.expected(&self.wanted(), None);
            return None;
        };
        let mut all: Vec<_> = entries
            .iter()
            .map(|(key, value)| {
                let key = key.get_ref().to_string();
                let path = format!("{}.{}", self.path, quoted_key(&key));
                (key, Self::new(self.document, value, path, Some(item)))
            })
            .collect();
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        Some(all)
    }

    fn table_with(&self, keys: &Keys<'a>) -> Option<Table<'a>> {
        let DeValue::Table(entries) = self.tree else {
            let header = (!self.path.contains('[')).then(|| format!("write `[{}]`", self.path));
            self.expected(&format!("a table with {}", listing(&keys.names(), "and")), header);
            return None;
        };
        let (path, span) = (self.path.clone(), self.span.clone());
        Some(Table::new(self.document, entries, span, path, keys))
    }

    /// An array of tables, `[[path]]`.
    #[must_use]
    pub fn tables(&self) -> Option<Vec<Table<'a>>> {
        if self.tree.is_table() {
            let header = self.document.text(&self.span);
            let path = &self.path;
            let message = format!("`{path}` is a single table, expected a list of tables");
            let label = match header.strip_prefix('[') {
                Some(header) => format!("write `[[{}]]`", header.trim_end_matches(']')),
                // a table without a header: it has inner ones, such as `[[arm.link]]`
                None => format!("write `[[{path}]]` further up"),
            };
            self.document.report(&self.span, &message, Some(label), None);
            return None;
        }
        let items = self.items(&self.wanted())?;
        every(items.into_iter().map(|item| Self { shape: self.shape, ..item }.table()))
    }
}

/// A label for something misspelt.
pub(super) fn did_you_mean(name: &str) -> String {
    format!("did you mean `{name}`?")
}
