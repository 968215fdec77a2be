//! A commented file to start from, which is valid as it stands.

use super::{FileFormat, about, default};
use crate::format::{Default, Example, Key, Shape, TableFormat};
use crate::plain_text::wrap;

/// The whole file.
pub fn template(file: FileFormat) -> String {
    let mut lines = Vec::new();
    comment(&mut lines, file.table().doc);
    let check =
        "`planar-capture check FILE.toml` describes the file. What is commented out is a default or an example.";
    comment(&mut lines, &check.replace('`', ""));
    lines.push(String::new());
    write_table(&mut lines, "", file.table(), true);
    lines.join("\n") + "\n"
}

/// The lines of a table, with its keys before its tables; all of them comments unless it is `given`.
fn write_table(lines: &mut Vec<String>, path: &str, table: &'static TableFormat, given: bool) {
    let is_inner = |key: &&Key| matches!(key.shape, Shape::Table(_) | Shape::Tables(_)) && !is_inline(key);
    for name in table.names() {
        let variants: Vec<_> = table.variants(name).collect();
        if !is_inner(&variants[0]) {
            entry(lines, &variants, given);
        }
    }
    for key in table.keys.iter().filter(is_inner) {
        let path = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        let (inner, header) = match key.shape {
            Shape::Tables(inner) => (inner, format!("[[{path}]]")),
            Shape::Table(inner) => (inner, format!("[{path}]")),
            _ => continue,
        };
        let given = given && has_start(inner);
        lines.push(String::new());
        comment(lines, inner.doc);
        lines.push(if given { header.clone() } else { format!("# {header}") });
        write_table(lines, &path, inner, given);
        if let Example::Entries(count) = key.example {
            for _ in 1..count {
                lines.extend([String::new(), header.clone()]);
                lines.extend(inner.keys.iter().filter_map(|key| match key.example {
                    Example::Start(value) => Some(format!("{} = {value}", key.name)),
                    _ => None,
                }));
            }
        }
    }
}

/// Whether a table stands in the template although it need not be given.
fn has_start(table: &'static TableFormat) -> bool {
    table.keys.iter().any(|key| match (key.example, key.shape) {
        (Example::Start(_), _) => true,
        (_, Shape::Table(inner) | Shape::Tables(inner)) => has_start(inner),
        _ => false,
    })
}

/// Whether the value is written behind the key.
fn is_inline(key: &Key) -> bool {
    matches!(key.example, Example::Start(_) | Example::Comment(_))
}

/// A key with what it means.
fn entry(lines: &mut Vec<String>, variants: &[&'static Key], given: bool) {
    let choices = variants[0].shape.choices().unwrap_or_default();
    let choices = choices.iter().map(|choice| format!("\"{}\"", choice.name)).collect::<Vec<_>>().join(", ");
    let parts = [variants[0].doc.to_owned(), choices]
        .into_iter()
        .chain(variants.iter().map(|key| about(key)))
        .filter(|part| !part.is_empty());
    comment(lines, &parts.collect::<Vec<_>>().join("; ").replace('`', ""));
    let (starts, value) = match (variants[0].example, &variants[0].default) {
        (Example::Start(value), _) => (true, value.to_owned()),
        (Example::Comment(value), _) => (false, value.to_owned()),
        (_, Default::Zeros) => (false, zeros(&variants[0].shape)),
        _ => (false, default(variants[0]).unwrap_or_default()),
    };
    let mark = if starts && given { "" } else { "# " };
    lines.push(format!("{mark}{} = {value}", variants[0].name));
}

fn zeros(shape: &Shape) -> String {
    let count = if let Shape::Vector(components) = shape { components.len() } else { 1 };
    toml::Value::from(vec![0.0; count]).to_string()
}

/// A text as lines of comment.
fn comment(lines: &mut Vec<String>, text: &str) {
    lines.extend(wrap("#", "#  ", text));
}
