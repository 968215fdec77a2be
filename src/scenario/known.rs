//! What scenarios can name: layouts, and control laws of a program of one's own.

use crate::format::NumberRule;
use std::ops::Index;

/// What the readers of scenarios know by name.
#[derive(Clone, Debug, Default)]
pub struct Known<'a> {
    /// (name, TOML text) of layouts.
    pub layouts: Vec<(&'a str, &'a str)>,
    /// Control laws beside the shipped ones.
    pub laws: LawFormats,
}

/// Control laws of a program's own, by the phase that they control.
#[derive(Clone, Debug, Default)]
pub struct LawFormats {
    /// Those that `approach.tracking` can name.
    pub tracking: Vec<LawFormat>,
    /// Those that `post_impact.control` can name.
    pub post_capture: Vec<LawFormat>,
}

/// A control law as scenarios name it, and the numbers of its table `law` in that of its phase.
#[derive(Clone, Copy, Debug)]
pub struct LawFormat {
    /// The value of `approach.tracking` or `post_impact.control`; not that of a shipped law.
    pub name: &'static str,
    /// What it does, for `list`.
    pub doc: &'static str,
    /// The keys of `[approach.law]` or `[post_impact.law]`.
    pub numbers: &'static [LawNumber],
}

/// A key of `[approach.law]` or `[post_impact.law]`.
#[derive(Clone, Copy, Debug)]
pub struct LawNumber {
    /// As in the scenario.
    pub key: &'static str,
    /// Its range and unit.
    pub rule: NumberRule,
    /// `None` where it must be given.
    pub default: Option<f64>,
}

/// The numbers that a law gets, one for each of its keys, given or default.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LawNumbers(pub(super) Vec<(&'static str, f64)>);

impl LawNumbers {
    /// Keys with their numbers, in the order of the law's.
    pub fn iter(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.0.iter().copied()
    }
}

impl Index<&str> for LawNumbers {
    type Output = f64;

    /// The number of a key.
    ///
    /// # Panics
    /// For a key that is not one of the law's.
    fn index(&self, key: &str) -> &f64 {
        let found = self.0.iter().find(|(known, _)| *known == key);
        found.map(|(_, number)| number).expect("a key of the law's numbers")
    }
}

impl<'a, S: AsRef<str>> From<&'a [(&'a str, S)]> for Known<'a> {
    fn from(layouts: &'a [(&'a str, S)]) -> Self {
        Self {
            layouts: layouts.iter().map(|(name, text)| (*name, text.as_ref())).collect(),
            laws: LawFormats::default(),
        }
    }
}

impl<'a, S: AsRef<str>, const N: usize> From<&'a [(&'a str, S); N]> for Known<'a> {
    fn from(layouts: &'a [(&'a str, S); N]) -> Self {
        (&layouts[..]).into()
    }
}

impl<'a, S: AsRef<str>> From<&'a Vec<(&'a str, S)>> for Known<'a> {
    fn from(layouts: &'a Vec<(&'a str, S)>) -> Self {
        (&layouts[..]).into()
    }
}

impl From<&Self> for Known<'_> {
    fn from(known: &Self) -> Self {
        known.clone()
    }
}
