//! Text in lines of a width.

/// Columns of a line.
const WIDTH: usize = 100;

/// The words of a text behind `first`, in as many lines as they need; those after the first begin with `next`.
pub(crate) fn wrap(first: &str, next: &str, text: &str) -> Vec<String> {
    let (mut lines, mut line) = (Vec::new(), first.to_owned());
    for word in text.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(std::mem::replace(&mut line, next.to_owned()));
        }
        line.extend([" ", word]);
    }
    lines.push(line);
    lines
}
