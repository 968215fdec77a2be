//! Reads `[[case]]`: the contact kinds of each variant of a capture.

use super::target::{NO_BOUNCE, NO_NORMAL, bounces_at_com, contact_kinds};
use crate::diagnostic::{Table, Value, every};
use crate::scenario::{Case, Detection, Target};

/// `names` are the targets', where they differ; `targets`, where they could be read, are in the same order.
pub(super) fn case<'a>(
    (index, table): (usize, &Table<'a>),
    names: Option<&[&'a str]>,
    targets: Option<&[Target]>,
    detection: Detection,
) -> Option<Case> {
    let name = table.file_name("name");
    let names = names?;
    let default = targets.map(|targets| Case::of_targets("", targets));
    let target_twists = of_targets(table, "target_twists", names, |i, value| match value {
        Some(value) => value.vector(),
        None => default.as_ref().map(|default| default.target_twists[i]),
    });
    let kinds = of_targets(table, "kinds", names, |i, value| match value {
        Some(value) => {
            let target = targets.map(|targets| &targets[i]);
            let kinds = contact_kinds(&value, target.map(|target| target.contacts.len()))?;
            if detection == Detection::Time && target.is_some_and(|target| bounces_at_com(target, &kinds)) {
                value.reject(NO_NORMAL);
                return None;
            }
            Some(kinds)
        }
        None => default.as_ref().map(|default| default.kinds[i].clone()),
    });
    let restitutions = of_targets(table, "restitutions", names, |i, value| match value {
        Some(value) => {
            let holds = kinds.as_ref().is_some_and(|kinds| !kinds[i].iter().flatten().any(|kind| kind.is_unilateral()));
            if holds {
                value.reject(NO_BOUNCE);
            }
            value.number().filter(|_| !holds)
        }
        None => default.as_ref().map(|default| default.restitutions[i]),
    });
    let printed_impulses = of_targets(table, "printed_impulses", names, |_, value| match value {
        Some(value) => value.number().map(Some),
        None => Some(None),
    });
    Some(Case {
        name: name?.to_owned(),
        index,
        target_twists: target_twists?,
        kinds: kinds?,
        restitutions: restitutions?,
        printed_impulses: printed_impulses?,
    })
}

/// The entry of each target in the table under `key`, whose keys are the targets' names.
fn of_targets<'a, R>(
    table: &Table<'a>,
    key: &str,
    names: &[&'a str],
    read: impl Fn(usize, Option<Value<'a>>) -> Option<R>,
) -> Option<Vec<R>> {
    let given = match table.get(key) {
        Some(value) => Some(value.by_name(names)?),
        None => None,
    };
    every(names.iter().enumerate().map(|(i, name)| read(i, given.as_ref().and_then(|given| given.get(name)))))
}
