//! JSON Schema of a file, for editors.

use super::{FileFormat, about, default};
use crate::format::{Bound, Choice, Count, Default, Key, NumberRule, Shape, TableFormat};
use serde_json::{Map, Value, json};

/// Taplo and the editors on it read draft 7 at most in all their parts.
const DRAFT: &str = "http://json-schema.org/draft-07/schema#";

/// The schema of a file, as text.
pub fn schema(file: FileFormat) -> String {
    let mut schema = json!({ "$schema": DRAFT, "title": format!("planar-capture {}", file.name()) });
    extend(&mut schema, of_table(file.table()));
    format!("{schema:#}\n")
}

fn of_table(table: &'static TableFormat) -> Value {
    let properties: Map<_, _> = table
        .names()
        .into_iter()
        .map(|name| (name.to_owned(), of_key(&table.variants(name).collect::<Vec<_>>())))
        .collect();
    let required: Vec<_> =
        table.keys.iter().filter(|key| key.default == Default::Required).map(|key| key.name).collect();
    let mut schema = json!({ "type": "object", "description": table.doc, "properties": properties });
    if !required.is_empty() {
        extend(&mut schema, json!({ "required": required }));
    }
    extend(&mut schema, json!({ "additionalProperties": false }));
    if !table.one_of.is_empty() {
        let alternatives: Vec<_> = table.one_of.iter().map(|name| json!({ "required": [name] })).collect();
        extend(&mut schema, json!({ "oneOf": alternatives }));
    }
    schema
}

/// The schema of a key by its entries, which differ in units and defaults.
fn of_key(variants: &[&'static Key]) -> Value {
    let mut shapes: Vec<_> = variants.iter().map(|key| of_shape(&key.shape)).collect();
    shapes.dedup();
    let mut schema = if let [shape] = &mut shapes[..] { shape.take() } else { json!({ "anyOf": shapes }) };
    // a table says of itself what it is
    let of_table = schema["description"].as_str().unwrap_or_default().to_owned();
    let what: Vec<_> = variants.iter().map(|key| about(key)).collect();
    let parts: Vec<_> = [variants[0].doc.to_owned(), of_table].into_iter().chain(what).collect();
    let parts: Vec<_> = parts.iter().map(String::as_str).filter(|part| !part.is_empty()).collect();
    extend(&mut schema, json!({ "description": parts.join("\n\n") }));
    match variants {
        [key @ Key { default: Default::Number(_), .. }] => {
            let number: Option<Value> = default(key).and_then(|text| text.parse().ok());
            extend(&mut schema, json!({ "default": number }));
        }
        [Key { default: Default::Choice(name), .. }] => extend(&mut schema, json!({ "default": name })),
        [Key { default: Default::Zeros, shape: Shape::Vector(components), .. }] => {
            extend(&mut schema, json!({ "default": vec![0.0; components.len()] }));
        }
        _ => {}
    }
    schema
}

fn of_shape(shape: &'static Shape) -> Value {
    match shape {
        Shape::Text(_) => json!({ "type": "string" }),
        Shape::Choice(choices) => of_choices(&choices()),
        Shape::Number(rule) => of_number(rule),
        Shape::NumberOrNone(rule) => json!({ "anyOf": [of_number(rule), of_vector(&[])] }),
        Shape::Scalar(rule) => json!({ "anyOf": [of_number(rule), { "type": "string" }, { "type": "boolean" }] }),
        Shape::Vector(components) => of_vector(components),
        Shape::OneOf(vectors) => json!({ "anyOf": vectors.iter().map(|vector| of_vector(vector)).collect::<Vec<_>>() }),
        Shape::List(item, count) => of_list(item, *count),
        Shape::OneOrList(item, count) => json!({ "anyOf": [of_shape(item), of_list(item, *count)] }),
        Shape::ByName(item, _) => json!({ "type": "object", "additionalProperties": of_shape(item) }),
        Shape::Table(table) => of_table(table),
        Shape::Tables(table) => json!({ "type": "array", "items": of_table(table) }),
    }
}

fn of_choices(choices: &[Choice]) -> Value {
    let [names, docs] = [|choice: &Choice| choice.name, |choice: &Choice| choice.doc]
        .map(|part| choices.iter().map(part).collect::<Vec<_>>());
    json!({ "type": "string", "enum": names, "x-taplo": { "docs": { "enumValues": docs } } })
}

fn of_number(rule: &NumberRule) -> Value {
    let mut schema = json!({ "type": if rule.is_whole() { "integer" } else { "number" } });
    for (bound, keys) in
        rule.bounds().into_iter().zip([["minimum", "exclusiveMinimum"], ["maximum", "exclusiveMaximum"]])
    {
        if let Some(Bound { value, is_excluded }) = bound {
            extend(&mut schema, json!({ keys[usize::from(is_excluded)]: value }));
        }
    }
    schema
}

fn of_vector(components: &'static [NumberRule]) -> Value {
    let count = components.len();
    if count == 0 {
        return json!({ "type": "array", "maxItems": 0 });
    }
    let items: Vec<_> = components.iter().map(of_number).collect();
    json!({ "type": "array", "items": items, "minItems": count, "maxItems": count })
}

fn of_list(item: &'static Shape, count: Count) -> Value {
    let mut schema = json!({ "type": "array", "items": of_shape(item) });
    match count {
        Count::Exactly(count) => extend(&mut schema, json!({ "minItems": count, "maxItems": count })),
        Count::AtLeastOne | Count::Joints | Count::Arms | Count::Contacts => {
            extend(&mut schema, json!({ "minItems": 1 }));
        }
        Count::Any => {}
    }
    schema
}

/// Adds the members of another object.
fn extend(to: &mut Value, other: Value) {
    if let (Value::Object(to), Value::Object(other)) = (to, other) {
        to.extend(other);
    }
}
