//! Lines of a text.

/// The most characters of a line.
pub const WIDTH: usize = 100;

/// A space within a unit, where no line ends; it is printed as a common one.
const FIXED: char = '\u{a0}';

/// The words of a text behind `first`, in as many lines as they need; those after the first begin with `next`.
pub fn wrap(first: &str, next: &str, text: &str) -> Vec<String> {
    let (mut lines, mut line) = (Vec::new(), first.to_owned());
    for word in text.split_ascii_whitespace() {
        let word = word.replace(FIXED, " ");
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, next.to_owned()));
        }
        line.extend([" ", &word]);
    }
    lines.push(line);
    lines
}

/// A sentence in lines that begin with `indent`; those after the first are further in.
pub fn sentence(indent: &str, text: &str) -> String {
    // a space stands before each word, which is one of the indent
    let lines = wrap(indent, &format!("{indent}  "), text);
    lines.iter().flat_map(|line| [line.strip_prefix(' ').unwrap_or(line), "\n"]).collect()
}

/// A name with a text beside it, which begins in the same column for all names.
pub fn entry(name: &str, text: &str) -> String {
    let lines = wrap(&format!("  {name:<19}"), &" ".repeat(21), text);
    lines.iter().flat_map(|line| [line.as_str(), "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::{WIDTH, wrap};

    #[test]
    fn a_unit_stays_in_one_line() {
        let text = format!("{} N\u{a0}m\u{a0}s, N\u{a0}s", "x".repeat(WIDTH - 5));
        let lines = wrap("", "", &text);
        assert_eq!(lines.len(), 2, "{lines:?}");
        assert_eq!(lines[1], " N m s, N s");
    }
}
