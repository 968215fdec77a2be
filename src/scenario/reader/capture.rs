//! `[[target]]`, `[contact]`, `[[case]]` and `[post_impact]`, and the rules between them.

use super::case::case;
use super::case_set::{CaseSet, case_set};
use super::joints::Joints;
use super::post_impact::post_impact;
use super::target::{NO_BOUNCE, target};
use crate::contact::ContactKind;
use crate::diagnostic::{Table, every};
use crate::layout::Layout;
use crate::scenario::{Case, ContactRules, Detection, LawFormat, PostImpact, Target};
use std::collections::HashSet;

/// The contents of the tables.
pub(super) struct Capture<'a> {
    pub(super) targets: Vec<Target>,
    pub(super) contact: ContactRules,
    /// All of them.
    pub(super) cases: Vec<Case>,
    /// What some of them set.
    pub(super) sets: Vec<CaseSet<'a>>,
    pub(super) post_impact: Option<PostImpact>,
}

/// Reads the tables; `name` is the scenario's, `own` are laws that `post_impact.control` may name beside the shipped ones.
pub(super) fn capture<'a>(
    root: &Table<'a>,
    layout: Option<&Layout>,
    name: Option<&str>,
    own: &[LawFormat],
) -> Option<Capture<'a>> {
    let contact = root.read_or("contact", ContactRules::default(), |value| contact_rules(&value.table()?));
    let detection = contact.unwrap_or_default().detection;
    let tables = root.tables("target")?;
    let no_targets = tables.is_empty();
    Table::reject_repeats(&tables, "name", str::to_owned, "target names must differ");
    Table::reject_repeats(&tables, "arm", str::to_owned, "an arm captures at most one target");
    let targets = every(tables.iter().map(|table| target(table, layout, detection)));
    if let (Some(targets), Some(layout)) = (&targets, layout) {
        reject_shared_arms(targets, &tables, layout);
    }

    // cases name targets, which they can only where the names differ
    let target_names = every(tables.iter().map(|table| table.get("name")?.as_str()))
        .filter(|names| names.iter().collect::<HashSet<_>>().len() == names.len());
    let cases = root.tables("case").and_then(|tables| {
        if let (true, Some(table)) = (no_targets, tables.first()) {
            let message = "`case[0]` is a table, expected no `[[case]]` without a `[[target]]`";
            table.reject(message, "there is nothing to capture");
        }
        let why = "case names must differ by more than upper and lower case: they are the names of files";
        Table::reject_repeats(&tables, "name", str::to_ascii_lowercase, why);
        let sets = every(tables.iter().enumerate().map(|(i, table)| case_set(table, i)));
        let tables = tables.iter().enumerate();
        let cases = every(tables.map(|table| case(table, target_names.as_deref(), targets.as_deref(), detection)));
        Some((cases?, sets?.into_iter().flatten().collect::<Vec<_>>()))
    });

    let after = if no_targets { None } else { root.table("post_impact") };
    let post_impact = if no_targets {
        root.reject_keys(&["contact", "post_impact"], "there is nothing to capture, expected a `[[target]]` with it");
        Some(None)
    } else {
        after.as_ref().and_then(|table| post_impact(table, &Joints { layout }, own)).map(Some)
    };

    let ((mut cases, sets), targets) = (cases?, targets?);
    if cases.is_empty() {
        cases.push(Case::of_targets(name?, &targets));
    }
    reject_idle_restitutions(&tables, &cases);
    if let Some(value) = after.and_then(|table| table.get("coordinates"))
        && value.as_str() == Some("reduced")
        && !merges_all(&targets, &cases, detection)
    {
        value.reject("they are for a robot alone, but not every target becomes part of a link, expected `full`");
    }
    Some(Capture { targets, contact: contact?, cases, sets, post_impact: post_impact? })
}

fn contact_rules(table: &Table<'_>) -> Option<ContactRules> {
    let detection = table.choice("detection", &Detection::ALL);
    let duration = table.optional_number("duration");
    Some(ContactRules { detection: detection?, duration: duration? })
}

/// Rejects each target that names an arm of an earlier one, where one of the two names several arms. Repeated single
/// names are rejected before.
fn reject_shared_arms(targets: &[Target], tables: &[Table<'_>], layout: &Layout) {
    let all: Vec<_> =
        targets.iter().zip(tables).filter_map(|(target, table)| Some((target, table.get("arm")?))).collect();
    for (i, (target, value)) in all.iter().enumerate() {
        let touches = |arm: usize| target.contacts.iter().any(|contact| contact.arm == arm);
        for (earlier, first) in &all[..i] {
            let shared = earlier.contacts.iter().find(|contact| touches(contact.arm));
            if let Some(contact) = shared.filter(|_| first.is_array() || value.is_array()) {
                let (name, path) = (&layout.arms[contact.arm].name, first.path());
                value.reject(&format!("`{name}` is in `{path}` too, but an arm captures at most one target"));
            }
        }
    }
}

/// Whether every case merges every target into a link, all at once.
fn merges_all(targets: &[Target], cases: &[Case], detection: Detection) -> bool {
    let one_arm_each = targets.iter().all(|target| target.contacts.len() == 1);
    let at_once = detection == Detection::Time || targets.len() == 1;
    let rigid =
        cases.iter().flat_map(|case| &case.kinds).flatten().all(|kind| kind.is_some_and(ContactKind::holds_yaw));
    one_arm_each && at_once && rigid
}

/// Rejects the restitution of each target that no arm bounces off in any case.
fn reject_idle_restitutions(tables: &[Table<'_>], cases: &[Case]) {
    for (i, table) in tables.iter().enumerate() {
        if !cases.iter().any(|case| case.kinds[i].iter().flatten().any(|kind| kind.is_unilateral())) {
            table.reject_keys(&["restitution"], NO_BOUNCE);
        }
    }
}
