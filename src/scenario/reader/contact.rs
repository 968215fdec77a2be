//! `[contact]`: how contacts come about and how long they last.

use crate::diagnostic::{NumberRule, Table};
use crate::scenario::{ContactRules, Detection};

const DURATION: NumberRule = NumberRule::positive("the duration of a contact", "s");

impl ContactRules {
    pub(super) const KEYS: [&'static str; 2] = ["detection", "duration"];

    pub(super) fn from_table(table: &Table<'_>) -> Option<Self> {
        let detection = match table.get("detection") {
            Some(value) => value.choice(&[("time", Detection::Time), ("event", Detection::Event)]),
            None => Some(Detection::Time),
        };
        let duration = match table.get("duration") {
            Some(value) => value.number(&DURATION).map(Some),
            None => Some(None),
        };
        Some(Self { detection: detection?, duration: duration? })
    }
}
