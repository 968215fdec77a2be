//! `[[target]]`, `[contact]`, `[[case]]` and `[post_impact]` together: what is captured, in which variants, and what
//! follows.

use super::joints::Joints;
use super::target::NO_BOUNCE;
use crate::contact::ContactKind;
use crate::diagnostic::{Table, every};
use crate::layout::Layout;
use crate::scenario::{Case, ContactRules, Detection, PostImpact, Target};
use std::collections::HashSet;

/// What the tables say.
pub(super) struct Capture {
    pub(super) targets: Vec<Target>,
    pub(super) contact: ContactRules,
    pub(super) cases: Vec<Case>,
    pub(super) post_impact: Option<PostImpact>,
}

/// Reads the tables; `name` is the scenario's.
pub(super) fn read(root: &Table<'_>, layout: Option<&Layout>, name: Option<&str>) -> Option<Capture> {
    let contact = match root.get("contact") {
        Some(value) => value.table(&ContactRules::KEYS).and_then(|table| ContactRules::from_table(&table)),
        None => Some(ContactRules::default()),
    };
    let detection = contact.unwrap_or_default().detection;
    let tables = root.tables("target", &Target::KEYS)?;
    let alone = tables.is_empty();
    Table::reject_repeats(&tables, "name", str::eq, "target names must differ");
    Table::reject_repeats(&tables, "arm", str::eq, "an arm captures at most one target");
    let targets = every(tables.iter().map(|table| Target::from_table(table, layout, detection)));
    if let (Some(targets), Some(layout)) = (&targets, layout) {
        reject_shared_arms(targets, &tables, layout);
    }

    // what the cases say of the targets can be looked at only where each of these has a name of its own
    let target_names = every(tables.iter().map(|table| table.get("name")?.as_str()))
        .filter(|names| names.iter().collect::<HashSet<_>>().len() == names.len());
    let known = targets.as_deref().unwrap_or_default();
    let cases = root.tables("case", &Case::KEYS).and_then(|tables| {
        if let (true, Some(table)) = (alone, tables.first()) {
            let message = "`case[0]` is a table, expected no `[[case]]` without a `[[target]]`";
            table.reject(message.to_owned(), "there is nothing to capture");
        }
        let why = "case names must differ by more than upper and lower case: they are the names of files";
        Table::reject_repeats(&tables, "name", str::eq_ignore_ascii_case, why);
        every(tables.iter().map(|table| Case::from_table(table, target_names.as_deref(), known, detection)))
    });

    let after = if alone { None } else { root.table("post_impact", &PostImpact::KEYS) };
    let post_impact = if alone {
        for value in ["contact", "post_impact"].iter().filter_map(|key| root.get(key)) {
            value.reject("there is nothing to capture, expected a `[[target]]` with it");
        }
        Some(None)
    } else {
        after.as_ref().and_then(|table| PostImpact::from_table(table, &Joints { layout })).map(Some)
    };

    let (mut cases, targets) = (cases?, targets?);
    if cases.is_empty() {
        cases.push(Case::only(name?, &targets));
    }
    reject_idle_restitutions(&tables, &cases);
    if let Some(value) = after.and_then(|table| table.get("coordinates"))
        && value.as_str() == Some("reduced")
        && !merges_all(&targets, &cases, detection)
    {
        value.reject("they are for a robot alone, but not every target becomes part of a link, expected `full`");
    }
    Some(Capture { targets, contact: contact?, cases, post_impact: post_impact? })
}

/// Notes each target with an arm of an earlier one, where one of the two names several arms: single names are told
/// apart as they stand.
fn reject_shared_arms(targets: &[Target], tables: &[Table<'_>], layout: &Layout) {
    let values: Vec<_> = tables.iter().map(|table| table.get("arm")).collect();
    for (i, (target, value)) in targets.iter().zip(&values).enumerate() {
        let touches = |arm: usize| target.touches.iter().any(|touch| touch.arm == arm);
        for (earlier, first) in targets.iter().zip(&values).take(i) {
            let shared = earlier.touches.iter().find(|touch| touches(touch.arm));
            let arm = shared.and_then(|touch| layout.arms.get(touch.arm));
            if let (Some(arm), Some(first), Some(value)) = (arm, first, value)
                && (first.is_array() || value.is_array())
            {
                let (name, path) = (&arm.name, first.path());
                value.reject(&format!("`{name}` is in `{path}` too, but an arm captures at most one target"));
            }
        }
    }
}

/// Whether every case makes every target one with a link, in one instant.
fn merges_all(targets: &[Target], cases: &[Case], detection: Detection) -> bool {
    let one_arm_each = targets.iter().all(|target| target.touches.len() == 1);
    let at_once = detection == Detection::Time || targets.len() == 1;
    let rigid = cases.iter().flat_map(|case| &case.kinds).flatten().all(|kind| *kind == Some(ContactKind::Rigid));
    one_arm_each && at_once && rigid
}

/// Notes restitutions of targets that nothing bounces off in any case.
fn reject_idle_restitutions(tables: &[Table<'_>], cases: &[Case]) {
    let bounces =
        |i: usize| cases.iter().any(|case| case.kinds.get(i).is_some_and(|k| k.contains(&Some(ContactKind::Bounce))));
    for (_, table) in tables.iter().enumerate().filter(|(i, _)| !bounces(*i)) {
        if let Some(value) = table.get("restitution") {
            value.reject(NO_BOUNCE);
        }
    }
}
