//! What the generated code says of itself: documentation, operation counts, the header's table.

use super::json::{list, object, size, text};
use serde_json::{Value, json};

/// Documentation of one function, as lines that start with `///`.
pub fn function(function: &Value) -> Result<String, String> {
    let mut lines = vec![
        text(&function["description"])?.to_owned(),
        String::new(),
        "```text".to_owned(),
        text(&function["equation"])?.to_owned(),
        "```".to_owned(),
        String::new(),
    ];
    if let [only] = list(&function["outputs"])?.as_slice() {
        lines.push(format!("Returns {}.", item(only)?));
    }
    lines.push(format!(
        "Source: {}. Operations: {}.",
        text(&function["source"])?,
        operations(&function["operations"])?
    ));
    lines.push(String::new());
    Ok(lines.iter().map(|l| format!("/// {l}").trim_end().to_owned()).collect::<Vec<_>>().join("\n"))
}

/// Description, shape and unit of an input or output.
pub fn item(item: &Value) -> Result<String, String> {
    let shape: Vec<String> = list(&item["shape"])?.iter().map(Value::to_string).collect();
    let shape = if shape.is_empty() { "scalar".to_owned() } else { shape.join(" × ") };
    Ok(format!("{} ({shape}; {})", escaped(text(&item["description"])?), text(&item["unit"])?))
}

/// Text in which rustdoc sees no links, tags or code.
pub fn escaped(text: &str) -> String {
    let mark = |c: char| if "[]<>`*".contains(c) { vec!['\\', c] } else { vec![c] };
    text.chars().flat_map(mark).collect()
}

/// Operation counts as a phrase: `329 flops (168 mul, 66 add, 87 sub, 8 div), 7 sin/cos pairs`.
pub fn operations(counts: &Value) -> Result<String, String> {
    let counts = object(counts)?;
    let of = |op: &str| counts.get(op).and_then(Value::as_u64).unwrap_or(0);
    let parts: Vec<String> =
        ["mul", "add", "sub", "div"].iter().filter(|op| of(op) > 0).map(|op| format!("{} {op}", of(op))).collect();
    let mut phrase = format!("{} flops", of("flops"));
    if !parts.is_empty() {
        phrase = format!("{phrase} ({})", parts.join(", "));
    }
    for (op, words) in [
        ("sin_cos", "sin/cos pairs"),
        ("neg", "sign changes"),
        ("min", "minima"),
        ("sqrt", "square roots"),
        ("atan2", "arctangents"),
    ] {
        if of(op) > 0 {
            phrase = format!("{phrase}, {} {words}", of(op));
        }
    }
    Ok(phrase)
}

/// One line per function for the header.
pub fn table(graph: &Value) -> Result<Vec<String>, String> {
    let mut lines =
        vec![format!("    {:42} {}", "parameters, once per model", operations(&graph["constants"]["operations"])?)];
    for family in list(&graph["families"])? {
        let stage = format!("{} (configuration stage)", text(&family["name"])?);
        lines.push(format!("    {stage:42} {}", operations(&family["configuration"]["operations"])?));
        for function in list(&family["functions"])? {
            lines.push(format!("    {:42} {}", text(&function["name"])?, operations(&function["operations"])?));
        }
    }
    Ok(lines)
}

/// Counts of every function for the manifest.
pub fn costs(graph: &Value) -> Result<Vec<Value>, String> {
    let mut costs = Vec::new();
    for family in list(&graph["families"])? {
        for function in list(&family["functions"])? {
            let counts = object(&function["operations"])?;
            let of = |ops: &[&str]| ops.iter().filter_map(|op| counts.get(*op)?.as_u64()).sum::<u64>();
            costs.push(json!({
                "function": function["name"],
                "multiplications": of(&["mul"]),
                "additions": of(&["add", "sub"]),
                "divisions": of(&["div"]),
                "sin_cos": of(&["sin_cos"]),
                "other": of(&["neg", "min", "sqrt", "atan2"]),
            }));
        }
    }
    Ok(costs)
}

/// Name and unit of every full coordinate, in their order.
pub fn coordinates(graph: &Value) -> Result<Vec<Value>, String> {
    let mut all: Vec<Value> = [("base yaw", "rad"), ("base x", "m"), ("base y", "m")]
        .map(|(name, unit)| json!({"name": literal(name), "text": name, "unit": unit}))
        .into();
    for arm in list(&graph["layout"]["arms"])? {
        for link in 1..=size(&arm["links"])? {
            let name = format!("{} joint {link}", text(&arm["name"])?);
            all.push(json!({"name": literal(&name), "text": code(&name), "unit": "rad"}));
        }
    }
    Ok(all)
}

/// Text as a Rust literal.
fn literal(text: &str) -> String {
    format!("{text:?}")
}

/// Text that somebody chose, as code in a cell of a table.
fn code(text: &str) -> String {
    format!("`{}`", text.replace('`', "'").replace('|', "\\|"))
}
