//! `[[case]]`: variants of a capture.

use super::target::{NO_BOUNCE, NO_NORMAL, contact_kinds, restitution};
use super::{FILE_NAME, TWIST, file_name};
use crate::contact::ContactKind;
use crate::diagnostic::{NumberRule, Table, Value, every};
use crate::scenario::{Case, Detection, Target};

const IMPULSE: NumberRule = NumberRule::non_negative("an impulse magnitude", "N s");

impl Case {
    pub(super) const KEYS: [&'static str; 5] = ["name", "target_twists", "kinds", "restitutions", "printed_impulses"];

    /// The only one of a scenario that names none.
    pub(super) fn only(name: &str, targets: &[Target]) -> Self {
        Self {
            name: name.to_owned(),
            target_twists: targets.iter().map(|target| target.twist).collect(),
            kinds: targets.iter().map(|target| target.touches.iter().map(|touch| touch.kind).collect()).collect(),
            restitutions: targets.iter().map(|target| target.restitution).collect(),
            printed_impulses: vec![None; targets.len()],
        }
    }

    /// `names` are the targets', where each has one of its own; `targets` those that could be read.
    pub(super) fn from_table<'a>(
        table: &Table<'a>,
        names: Option<&[&'a str]>,
        targets: &[Target],
        detection: Detection,
    ) -> Option<Self> {
        let name = table.require("name", FILE_NAME).and_then(|value| file_name(&value));
        let names = names?;
        let default = Self::only("", targets);
        let target = |i: usize| targets.get(i).filter(|_| targets.len() == names.len());
        let target_twists = of_targets(table, "target_twists", names, |i, value| match value {
            Some(value) => value.vector(&TWIST),
            None => Some(default.target_twists.get(i).copied().unwrap_or_default()),
        });
        let kinds = of_targets(table, "kinds", names, |i, value| match value {
            Some(value) => {
                let kinds = contact_kinds(&value, target(i).map(|target| target.touches.len()))?;
                if detection == Detection::Time && target(i).is_some_and(|target| target.bounces_at_its_com(&kinds)) {
                    value.reject(NO_NORMAL);
                    return None;
                }
                Some(kinds)
            }
            None => Some(default.kinds.get(i).cloned().unwrap_or_default()),
        });
        let restitutions = of_targets(table, "restitutions", names, |i, value| match value {
            Some(value) => {
                let idle = kinds
                    .as_ref()
                    .and_then(|kinds| kinds.get(i))
                    .is_some_and(|k| !k.contains(&Some(ContactKind::Bounce)));
                if idle {
                    value.reject(NO_BOUNCE);
                }
                restitution(&value).filter(|_| !idle)
            }
            None => Some(default.restitutions.get(i).copied().unwrap_or_default()),
        });
        let printed_impulses = of_targets(table, "printed_impulses", names, |_, value| match value {
            Some(value) => value.number(&IMPULSE).map(Some),
            None => Some(None),
        });
        Some(Self {
            name: name?,
            target_twists: target_twists?,
            kinds: kinds?,
            restitutions: restitutions?,
            printed_impulses: printed_impulses?,
        })
    }
}

/// What a table under `key`, with targets' names as its keys, says of each target.
fn of_targets<'a, R>(
    table: &Table<'a>,
    key: &str,
    names: &[&'a str],
    read: impl Fn(usize, Option<Value<'a>>) -> Option<R>,
) -> Option<Vec<R>> {
    let given = match table.get(key) {
        Some(value) => Some(value.table(names)?),
        None => None,
    };
    every(names.iter().enumerate().map(|(i, name)| read(i, given.as_ref().and_then(|given| given.get(name)))))
}
