//! Tables and numbers in Markdown.

/// Below this a momentum of some tenths of N s is rounding.
const ROUNDING: f64 = 1e-9;

/// A table with a head.
pub(super) fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let head: Vec<String> = head.iter().map(|cell| (*cell).to_owned()).collect();
    let rule = format!("|{}\n", "---|".repeat(head.len()));
    let body: String = rows.iter().map(|row| line(row)).collect();
    (line(&head) + &rule + &body).trim_end().to_owned()
}

/// With so many digits after the point; never a negative zero.
pub(super) fn number(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let zero = text.chars().all(|c| "-0.".contains(c));
    if zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// (x, y) with so many digits.
pub(super) fn point([x, y]: [f64; 2], digits: usize) -> String {
    format!("({}, {})", number(x, digits), number(y, digits))
}

/// A difference that should be zero; rounding errors are shown as such.
pub(super) fn jump(value: f64) -> String {
    if value.abs() < ROUNDING { "0 (< 1e-9)".to_owned() } else { number(value, 4) }
}
