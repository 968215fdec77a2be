//! What the values of a case have no part in: it is said once, of the scenario.

use crate::diagnostic::Warning;
use crate::scenario::Variant;

/// Whether a warning about a case with values of its own is one that is said of the scenario already. Numbers may differ, as
/// a reach does by the mass of the base; what is said of a value that the case sets is of that value.
pub(super) fn is_repeated(own: &Warning, of_scenario: &Warning, variant: &Variant) -> bool {
    own.key == of_scenario.key && !sets(variant, &own.key) && words(&own.why).eq(words(&of_scenario.why))
}

/// Whether a case has a value of its own at a key, or at an element of it.
fn sets(variant: &Variant, key: &str) -> bool {
    let is_in = |inner: &str, outer: &str| {
        inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('['))
    };
    variant.set.iter().map(|(path, _)| by_index(path, variant)).any(|path| is_in(&path, key) || is_in(key, &path))
}

/// A path with the indices of targets and arms in place of their names: `target[0].mass`.
fn by_index(path: &str, variant: &Variant) -> String {
    let (targets, arms) = (&variant.scenario.targets, &variant.scenario.layout.arms);
    let names = |table: &str| -> Vec<&str> {
        match table {
            "target." => targets.iter().map(|target| target.name.as_str()).collect(),
            _ => arms.iter().map(|arm| arm.name.as_str()).collect(),
        }
    };
    for table in ["target.", "layout.arm."] {
        let Some(rest) = path.strip_prefix(table) else { continue };
        for (i, name) in names(table).into_iter().enumerate() {
            if let Some(after) = rest.strip_prefix(name).filter(|after| after.starts_with('.')) {
                return format!("{}[{i}]{after}", table.trim_end_matches('.'));
            }
        }
    }
    path.to_owned()
}

/// A sentence without its numbers.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let is_number = |word: &str| word.trim_matches(|c: char| !c.is_alphanumeric()).parse::<f64>().is_ok();
    text.split_whitespace().filter(move |word| !is_number(word))
}
