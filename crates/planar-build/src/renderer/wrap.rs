//! Long lists of names and numbers, wrapped: formatting gives each entry a line.

use serde_json::Value;
use std::fmt::Write;

/// Columns of a line.
const WIDTH: usize = 120;

/// The text with as many names of a list on a line as fit, where formatting gave each a line.
pub fn names(text: &str) -> String {
    let is_name = |line: &str| {
        let name = line.trim_start().strip_suffix(',');
        name.is_some_and(|name| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'))
    };
    let mut wrapped = String::with_capacity(text.len());
    let mut column = 0; // of a line of names that may go on, else 0
    for line in text.lines() {
        let (name, goes_on) = (line.trim_start(), is_name(line));
        if goes_on && column > 0 && column + 1 + name.len() <= WIDTH {
            wrapped.push(' ');
            wrapped.push_str(name);
            column += 1 + name.len();
        } else {
            if !wrapped.is_empty() {
                wrapped.push('\n');
            }
            wrapped.push_str(line);
            column = if goes_on { line.len() } else { 0 };
        }
    }
    wrapped.push('\n');
    wrapped
}

/// The text with the lists of `vectors` in place of `[VALUES_i_j]` and `[SIZES_i_j]`: state i, result j.
pub fn fill(text: &str, vectors: &Value) -> String {
    let mut filled = String::with_capacity(2 * text.len());
    for line in text.lines() {
        match list_of(line, vectors) {
            Some((before, numbers, after)) => wrap(&mut filled, before, &numbers, after),
            None => filled.push_str(line),
        }
        filled.push('\n');
    }
    filled
}

/// The numbers that belong into a line, with what stands before and after them.
fn list_of<'a>(line: &'a str, vectors: &Value) -> Option<(&'a str, Vec<String>, &'a str)> {
    for (mark, key) in [("[VALUES_", "values"), ("[SIZES_", "sizes")] {
        let Some((before, rest)) = line.split_once(mark) else { continue };
        let (place, after) = rest.split_once(']')?;
        let (state, result) = place.split_once('_')?;
        let [state, result] = [state, result].map(|number| number.parse::<usize>().ok());
        let numbers = vectors.get(state?)?["expected"].get(result?)?[key].as_array()?;
        let literal = |value: &Value| match key {
            "sizes" => value.as_f64().map(|size| format!("{size:.1e}")),
            _ => number(value).ok(),
        };
        return Some((before, numbers.iter().filter_map(literal).collect(), after));
    }
    None
}

/// A number as a literal that reads back as the same.
pub fn number(value: &Value) -> Result<String, String> {
    let number = value.as_f64().ok_or_else(|| format!("a number was expected, not {value}"))?;
    Ok(format!("{number:?}"))
}

/// One line where they fit, else as many to a line as fit.
fn wrap(to: &mut String, before: &str, numbers: &[String], after: &str) {
    let whole = format!("{before}[{}]{after}", numbers.join(", "));
    if whole.chars().count() <= WIDTH {
        to.push_str(&whole);
        return;
    }
    let indent = before.len() - before.trim_start().len();
    let _ = write!(to, "{before}[");
    let mut column = WIDTH;
    for number in numbers {
        if column + number.len() + 2 > WIDTH {
            let _ = write!(to, "\n{:width$}", "", width = indent + 4);
            column = indent + 4;
        } else {
            to.push(' ');
            column += 1;
        }
        let _ = write!(to, "{number},");
        column += number.len() + 1;
    }
    let _ = write!(to, "\n{:indent$}]{after}", "");
}
