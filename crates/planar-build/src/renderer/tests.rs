//! Statements from text, and templates.

use super::*;
use crate::format::Statement;

/// Statements from lines such as `p = mul a b`; `sine,cosine = sin_cos angle`.
pub(super) fn statements(lines: &[&str]) -> Vec<Statement> {
    let statement = |line: &&str| {
        let words: Vec<&str> = line.split(' ').collect();
        let [targets, "=", operation, operands @ ..] = words.as_slice() else { panic!("{line}") };
        let targets = match targets.split_once(',') {
            Some(pair) => json!([pair.0, pair.1]),
            None => json!(targets),
        };
        let list = [targets, json!(operation)].into_iter().chain(operands.iter().map(|operand| json!(operand)));
        serde_json::from_value(list.collect()).expect("a statement")
    };
    lines.iter().map(statement).collect()
}

/// A shipped graph.
pub(super) fn graph(name: &str) -> Graph {
    let path = format!("{}/../../codegen/graphs/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(path).expect("a graph");
    serde_json::from_str(&text).expect("a graph")
}

/// A tag alone in its line leaves no line; text, and tags in it, stay as they are.
#[test]
fn lines_of_tags_are_none() {
    let template = "a\n  {% if b %}\n  c {% if d %}\n{% if e %}f{% endif %}\n\n{# why #}\n{% open\n{{ g }}\nh }\n";
    let expected = "a\n{% if b %}  c {% if d %}\n{% if e %}f{% endif %}\n\n{# why #}{% open\n{{ g }}\nh }\n";
    assert_eq!(without_lines_of_tags(template), expected);
}

#[test]
fn names_of_types_are_in_camel_case() {
    assert_eq!(["joint_rates", "a", "x2_y"].map(camel_case), ["JointRates", "A", "X2Y"]);
}
