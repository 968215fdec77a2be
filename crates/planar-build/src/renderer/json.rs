//! Reading the graph: a value of the wrong kind is an error that shows it.

use serde_json::{Map, Value};

pub fn list(value: &Value) -> Result<&Vec<Value>, String> {
    value.as_array().ok_or_else(|| format!("a list was expected, not {value}"))
}

pub fn text(value: &Value) -> Result<&str, String> {
    value.as_str().ok_or_else(|| format!("a string was expected, not {value}"))
}

pub fn object(value: &Value) -> Result<&Map<String, Value>, String> {
    value.as_object().ok_or_else(|| format!("an object was expected, not {value}"))
}

pub fn size(value: &Value) -> Result<usize, String> {
    let number = value.as_u64().and_then(|number| usize::try_from(number).ok());
    number.ok_or_else(|| format!("a size was expected, not {value}"))
}

/// The `name` of each item.
pub fn names(items: &Value) -> Result<impl Iterator<Item = &str>, String> {
    Ok(list(items)?.iter().filter_map(|item| item.get("name").and_then(Value::as_str)))
}
