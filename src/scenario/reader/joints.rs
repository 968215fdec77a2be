//! Lists with one entry per joint or arm, checked against the layout.

use crate::diagnostic::{Table, Value};
use crate::format::{Default, Key};
use crate::layout::Layout;

/// The joints and arms that lists are checked against; not checked where the layout could not be read.
pub(super) struct Joints<'a> {
    pub(super) layout: Option<&'a Layout>,
}

impl Joints<'_> {
    /// What a list must hold: "6 numbers, one per joint (arm1: 3, arm2: 3)".
    pub(super) fn one_each(&self) -> String {
        let Some(layout) = self.layout else {
            return "one number per joint".to_owned();
        };
        let arms: Vec<_> = layout.arms.iter().map(|arm| format!("{}: {}", arm.name, arm.links.len())).collect();
        format!("{} numbers, one per joint ({})", layout.joints(), arms.join(", "))
    }

    /// Rejects a list that has not one entry per joint.
    pub(super) fn check_length(&self, value: &Value<'_>, found: usize, expected: &str) -> Option<()> {
        check_length(value, found, self.layout.map(Layout::joints), expected)
    }

    /// A list with one number per joint; the first that is wrong is noted.
    pub(super) fn numbers(&self, value: &Value<'_>) -> Option<Vec<f64>> {
        let items = value.items(&self.one_each())?;
        self.check_length(value, items.len(), &self.one_each())?;
        items.iter().map(Value::number).collect()
    }

    /// One number for all joints, or a list with one per joint.
    pub(super) fn one_or_each(&self, value: &Value<'_>) -> Option<Vec<f64>> {
        if value.is_array() {
            return self.numbers(value);
        }
        value.number().map(|number| self.repeat(number))
    }

    /// The gain of a law, of which the table's format has a default.
    pub(super) fn gain(&self, table: &Table<'_>, key: &'static Key) -> Option<Vec<f64>> {
        match (table.get_as(key), key.default) {
            (Some(value), _) => self.one_or_each(&value),
            (None, Default::Number(default)) => Some(self.repeat(default)),
            (None, _) => None,
        }
    }

    /// The same entry for every joint.
    pub(super) fn repeat<T: Clone>(&self, entry: T) -> Vec<T> {
        vec![entry; self.layout.map_or(0, Layout::joints)]
    }
}

/// Rejects a list of another length than the expected one, where that is known.
pub(super) fn check_length(value: &Value<'_>, found: usize, length: Option<usize>, expected: &str) -> Option<()> {
    if length.is_some_and(|length| length != found) {
        value.expected(&format!("{expected}, found {found}"), None);
        return None;
    }
    Some(())
}
