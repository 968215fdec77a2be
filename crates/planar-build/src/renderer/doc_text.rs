//! Documentation of the generated code: descriptions, coordinates, operation counts.

use crate::format::{Function, Graph, Operations, Variable};
use serde_json::{Value, json};

/// Documentation of a function without its arguments, as lines that start with `///`.
pub fn function(function: &Function) -> Vec<String> {
    let Function { description, equation, source, outputs, .. } = function;
    let returns = match outputs.as_slice() {
        [only] => format!(" Returns {}.", variable(only)),
        _ => String::new(),
    };
    let text = format!("{description}\n\n```text\n{equation}\n```\n\n{source}.{returns}\n\n");
    text.lines().map(|line| format!("/// {line}").trim_end().to_owned()).collect()
}

/// Description, shape and unit of an input or output.
pub fn variable(variable: &Variable) -> String {
    format!("{} {}", escaped(&variable.description), shape_and_unit(variable))
}

/// As [`variable`], for other tools than rustdoc.
pub fn plain_variable(variable: &Variable) -> String {
    format!("{} {}", variable.description, shape_and_unit(variable))
}

fn shape_and_unit(variable: &Variable) -> String {
    let shape: Vec<String> = variable.shape.iter().map(usize::to_string).collect();
    let shape = if shape.is_empty() { "scalar".to_owned() } else { shape.join(" × ") };
    format!("({shape}; {})", variable.unit)
}

/// Documentation of a function without its arguments, as lines of plain text.
pub fn function_lines(function: &Function) -> Vec<String> {
    let Function { description, equation, source, .. } = function;
    vec![description.clone(), String::new(), format!("    {equation}"), String::new(), format!("{source}.")]
}

/// Text in which rustdoc sees no links, tags or code.
pub fn escaped(text: &str) -> String {
    let mark = |c: char| if "[]<>`*".contains(c) { vec!['\\', c] } else { vec![c] };
    text.chars().flat_map(mark).collect()
}

/// Rows of the table of operations: the stages, family by family.
pub fn operations(graph: &Graph) -> Vec<Value> {
    let mut rows = vec![row("the constants of a [`Model`], once", None, &graph.constants.operations)];
    for family in &graph.families {
        let stage = format!("[`Model::{}_configuration`]", family.name);
        rows.push(row(&stage, None, &family.configuration.operations));
        let functions = family.functions.iter();
        rows.extend(functions.map(|f| row(&format!("[`Model::{}`]", f.name), Some(&f.name), &f.operations)));
    }
    rows
}

fn row(title: &str, function: Option<&String>, counts: &Operations) -> Value {
    let count = |kinds: &[&str]| kinds.iter().filter_map(|kind| counts.get(*kind)).sum::<u64>();
    json!({
        "title": title,
        "function": function,
        "multiplications": count(&["mul"]),
        "additions": count(&["add", "sub"]),
        "divisions": count(&["div"]),
        "sin_cos": count(&["sin_cos"]),
        "other": count(&["neg", "min", "sqrt", "atan2"]),
    })
}

/// Name and unit of every full coordinate, in their order.
pub fn coordinates(graph: &Graph) -> Vec<Value> {
    let base = [("base yaw", "rad"), ("base x", "m"), ("base y", "m")];
    let base = base.map(|(name, unit)| json!({"name": literal(name), "text": name, "unit": unit}));
    let arms = graph.layout.arms.iter();
    let joints = arms.flat_map(|arm| (1..=arm.links).map(|link| format!("{} joint {link}", arm.name)));
    let joints = joints.map(|name| json!({"name": literal(&name), "text": code(&name), "unit": "rad"}));
    base.into_iter().chain(joints).collect()
}

/// Text as a Rust literal.
fn literal(text: &str) -> String {
    format!("{text:?}")
}

/// Text that somebody chose, as code in a cell of a table.
fn code(text: &str) -> String {
    format!("`{}`", text.replace('`', "'").replace('|', "\\|"))
}

#[cfg(test)]
mod tests;
