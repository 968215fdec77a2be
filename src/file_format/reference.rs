//! The reference of a file: a section for each of its tables.

use super::{FileFormat, condition, default, unit};
use crate::format::{Choice, Count, Default, Key, NumberRule, Shape, TableFormat};

/// The whole page.
pub fn page(file: FileFormat) -> String {
    let name = file.name();
    let mut page = format!(
        "<!-- Written from the tables by which the program reads: PLANAR_CAPTURE_WRITE=1 cargo test --test commands formats \
         -->\n# Keys of a {name} file\n\n`planar-capture template {name}` prints a file to start from, `planar-capture schema \
         {name}` a JSON Schema for editors. Unknown keys are errors.\n"
    );
    section(&mut page, "", file.table(), &mut Vec::new());
    page
}

/// The tables that have a section, with its path.
type Sections = Vec<(&'static TableFormat, String)>;

/// The path of a table's section, where it has one.
fn known(done: &Sections, table: &'static TableFormat) -> Option<String> {
    done.iter().find(|(known, _)| std::ptr::eq(*known, table)).map(|(_, path)| path.clone())
}

/// The sections of a table, and of those in it that have none yet; `path` is that of its header.
fn section(page: &mut String, path: &str, table: &'static TableFormat, done: &mut Sections) {
    if known(done, table).is_some() {
        return;
    }
    done.push((table, path.to_owned()));
    let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
    if !path.is_empty() {
        page.extend(["\n## ", path, "\n"]);
    }
    page.extend(["\n", table.doc, "\n\n| key | value | unit | default | content |\n|---|---|---|---|---|\n"]);
    for key in table.keys {
        let elsewhere = match key.shape {
            Shape::Table(inner) | Shape::Tables(inner) => known(done, inner),
            _ => None,
        };
        *page += &row(key, &elsewhere.unwrap_or_else(|| below(key.name)));
    }
    if !table.one_of.is_empty() {
        let names: Vec<_> = table.one_of.iter().map(|name| format!("`{name}`")).collect();
        page.extend(["\nExactly one of ", &names.join(", "), " is given.\n"]);
    }
    for name in table.names() {
        let key = table.key(name).expect("a key of the table");
        if let Some(choices) = key.shape.choices() {
            page.extend(["\n| `", name, "` | meaning |\n|---|---|\n"]);
            for Choice { name, doc } in choices {
                page.extend(["| `\"", name, "\"` | ", doc, " |\n"]);
            }
        }
    }
    for key in table.keys {
        if let Shape::Table(inner) | Shape::Tables(inner) = key.shape {
            section(page, &below(key.name), inner, done);
        }
    }
}

fn row(key: &Key, path: &str) -> String {
    let doc = match condition(key) {
        Some(condition) => format!("{}; {condition}", key.doc),
        None => key.doc.to_owned(),
    };
    let default = match key.default {
        Default::Required => "required".to_owned(),
        Default::Number(_) | Default::Choice(_) => format!("`{}`", default(key).unwrap_or_default()),
        _ => default(key).unwrap_or_default(),
    };
    format!("| `{}` | {} | {} | {default} | {doc} |\n", key.name, value(&key.shape, path), unit(&key.shape))
}

/// What a value is, without its unit.
fn value(shape: &Shape, path: &str) -> String {
    match shape {
        Shape::Text(what) => format!("text: {what}"),
        Shape::Choice(_) => "one of those below".to_owned(),
        Shape::Number(rule) if rule.is_whole() => {
            let [least, most] = rule.bounds().map(|bound| bound.map_or(0.0, |bound| bound.value));
            format!("whole number, {least} to {most}")
        }
        Shape::Number(rule) => {
            let [least, most] = rule.bounds().map(|bound| bound.map(|bound| (bound.value, bound.is_excluded)));
            match (least, most) {
                (Some((least, true)), Some((most, true))) => format!("more than {least}, less than {most}"),
                (Some((least, true)), _) => format!("more than {least}"),
                (Some((least, false)), Some((most, _))) if least >= 0.0 => {
                    format!("{} to {}", short(least), short(most))
                }
                (Some((least, false)), None) => format!("{least} or more"),
                _ => "number".to_owned(),
            }
        }
        Shape::NumberOrNone(rule) => format!("{}, []", value(&Shape::Number(*rule), path)),
        Shape::Scalar(_) => "number, text, `true` or `false`".to_owned(),
        Shape::Vector(components) => {
            let names: Vec<_> = components.iter().map(NumberRule::what).collect();
            format!("[{}]", names.join(", "))
        }
        Shape::OneOf(vectors) => {
            vectors.iter().map(|vector| value(&Shape::Vector(vector), path)).collect::<Vec<_>>().join(", ")
        }
        Shape::List(item, count) => format!("list{}: {}", of(*count), value(item, path)),
        Shape::OneOrList(item, count) => format!("{}, or a list{}", value(item, path), of(*count)),
        Shape::ByName(item, of) => match item {
            Shape::OneOrList(Shape::Choice(_), _) => format!("table by {of}: as its `kind`"),
            _ => format!("table by {of}: {}", value(item, path)),
        },
        Shape::Table(_) => format!("[table](#{})", anchor(path)),
        Shape::Tables(_) => format!("[list of tables](#{})", anchor(path)),
    }
}

/// How many elements a list has, after that word.
fn of(count: Count) -> String {
    if count == Count::Any { String::new() } else { format!(", {}", count.words()) }
}

/// A number with few digits.
fn short(number: f64) -> String {
    if number == 0.0 || number >= 1e-3 { number.to_string() } else { format!("{number:e}") }
}

/// The anchor that a heading with this path has.
fn anchor(path: &str) -> String {
    path.replace('.', "")
}
