//! Reads the `[clearance]` table.

use crate::diagnostic::{Table, Value, every, listing};
use crate::scenario::{ClearanceRules, OnOverlap};

const PAIRS: &str = "a list of pairs of bodies, [[\"base\", \"arms/ARM/link2\"], …]";

/// `names` are those of the scenario's bodies.
pub(super) fn clearance(table: &Table<'_>, names: &[String]) -> Option<ClearanceRules> {
    let on_overlap = table.choice("on_overlap", &OnOverlap::ALL);
    let ignore =
        table.read_or("ignore", Vec::new(), |value| every(value.items(PAIRS)?.iter().map(|item| pair(item, names))));
    Some(ClearanceRules { on_overlap: on_overlap?, ignore: ignore?, ..ClearanceRules::default() })
}

fn pair(value: &Value<'_>, names: &[String]) -> Option<[String; 2]> {
    let items = value.items(PAIRS)?;
    let known: Vec<&str> = names.iter().map(String::as_str).collect();
    let body = |item: &Value<'_>| {
        let name = item.text_as(&format!("the name of a body: {}", listing(&known, "or")))?;
        if !known.contains(&name) {
            item.expected_one_of(&known, None);
            return None;
        }
        Some(name.to_owned())
    };
    let pair = <[String; 2]>::try_from(every(items.iter().map(body))?);
    let pair = pair.map_err(|names| value.reject(&format!("found {} bodies, expected {PAIRS}", names.len()))).ok()?;
    if pair[0] == pair[1] {
        value.reject("a body is not compared with itself, expected two bodies");
        return None;
    }
    Some(pair)
}
