//! Long lists of numbers: put in after formatting, which would give each number a line.

use serde_json::Value;
use std::fmt::Write;

/// Columns of a line.
const WIDTH: usize = 120;

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
fn list_of<'a>(line: &'a str, vectors: &'a Value) -> Option<(&'a str, Vec<&'a str>, &'a str)> {
    for (mark, key) in [("[VALUES_", "values"), ("[SIZES_", "sizes")] {
        let Some((before, rest)) = line.split_once(mark) else { continue };
        let (place, after) = rest.split_once(']')?;
        let (state, result) = place.split_once('_')?;
        let [state, result] = [state, result].map(|number| number.parse::<usize>().ok());
        let numbers = vectors.get(state?)?["expected"].get(result?)?[key].as_array()?;
        return Some((before, numbers.iter().filter_map(Value::as_str).collect(), after));
    }
    None
}

/// One line where they fit, else as many to a line as fit.
fn wrap(to: &mut String, before: &str, numbers: &[&str], after: &str) {
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
