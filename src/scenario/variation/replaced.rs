//! Values of targets that a case replaces with its own, so that changing them changes nothing.

use super::KeyPath;
use crate::format::Step;
use toml::{Table, Value};

/// Keys of a target, and those of a case that replace them.
const REPLACED: [(&str, &str); 3] = [("twist", "target_twists"), ("kind", "kinds"), ("restitution", "restitutions")];

/// Where the case, the only one of a scenario's tree, has a value of its own in place of that at a path: its path.
pub(super) fn replaced(path: &KeyPath, scenario: &Table) -> Option<KeyPath> {
    let [Step::Key(first), Step::Named(target), Step::Key(key), rest @ ..] = &path.steps[..] else { return None };
    let (_, own) = REPLACED.iter().find(|(of_target, _)| first == "target" && of_target == key)?;
    let case = scenario.get("case")?.as_array()?.first()?;
    case.get(own)?.get(target)?;
    let name = case.get("name").and_then(Value::as_str)?;
    let steps = ["case", name, own, target].map(|step| Step::Key(step.to_owned()));
    Some(KeyPath { file: path.file, steps: [&steps, rest].concat() })
}
