//! Notes and warnings of an import.

use crate::diagnostic::printable;
use std::fmt::{self, Display, Formatter};

/// Something that the user of an imported layout should know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Whether it changes the motion.
    pub is_warning: bool,
    /// The text, one line.
    pub text: String,
}

impl Remark {
    pub(super) fn note(text: &str) -> Self {
        Self { is_warning: false, text: printable(text) }
    }

    pub(super) fn warning(text: &str) -> Self {
        Self { is_warning: true, text: printable(text) }
    }

    /// A fact and the items that it is true of; `None` without items.
    pub(super) fn of_items(
        make: fn(&str) -> Self,
        fact: &str,
        separator: &str,
        items: impl Iterator<Item = String>,
    ) -> Option<Self> {
        let items: Vec<String> = items.collect();
        (!items.is_empty()).then(|| make(&format!("{fact}: {}", items.join(separator))))
    }
}

impl Display for Remark {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", if self.is_warning { "warning" } else { "note" }, self.text)
    }
}
