//! Checking lists against the joints and arms of the layout.

use crate::diagnostic::{NumberRule, Table, Value};
use crate::layout::Layout;

/// The joints that lists are checked against; nothing is known of them where the layout is broken.
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

    /// A list with one number per joint; notes the first that is wrong.
    pub(super) fn numbers(&self, value: &Value<'_>, quantity: &NumberRule) -> Option<Vec<f64>> {
        let items = value.items(&self.one_each())?;
        check_length(value, items.len(), self.layout.map(Layout::joints), &self.one_each())?;
        items.iter().map(|item| item.number(quantity)).collect()
    }

    /// One number for all joints, or a list with one per joint.
    pub(super) fn one_or_each(&self, value: &Value<'_>, quantity: &NumberRule) -> Option<Vec<f64>> {
        if value.is_array() {
            return self.numbers(value, quantity);
        }
        value.number(quantity).map(|number| self.repeat(number))
    }

    /// The gain under a key, or the default for every joint.
    pub(super) fn gain(&self, table: &Table<'_>, key: &str, quantity: &NumberRule, default: f64) -> Option<Vec<f64>> {
        table.get(key).map_or_else(|| Some(self.repeat(default)), |value| self.one_or_each(&value, quantity))
    }

    /// The same number for every joint.
    pub(super) fn repeat(&self, number: f64) -> Vec<f64> {
        vec![number; self.layout.map_or(0, Layout::joints)]
    }
}

/// `None`, with a note, where a list has another length than the layout asks for.
pub(super) fn check_length(value: &Value<'_>, found: usize, right: Option<usize>, wanted: &str) -> Option<()> {
    if right.is_some_and(|right| right != found) {
        value.expected(&format!("{wanted}, found {found}"), None);
        return None;
    }
    Some(())
}
