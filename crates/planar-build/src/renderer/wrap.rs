//! Lines that are too long, broken at the commas of a list.

/// Columns of a line.
const WIDTH: usize = 120;

/// The text with its long lists broken: one entry a line where an entry is a list itself, else as many as fit. A matrix
/// is always broken into its rows. No blank line begins or ends a block.
pub fn wrap(text: &str) -> String {
    let mut wrapped = String::with_capacity(text.len());
    for line in text.lines().map(str::trim_end) {
        if line.is_empty() && (wrapped.ends_with("{\n") || wrapped.ends_with("\n\n")) {
            continue;
        }
        if line.trim_start().starts_with('}') && wrapped.ends_with("\n\n") {
            wrapped.pop();
        }
        push(&mut wrapped, line);
    }
    wrapped
}

fn push(text: &mut String, line: &str) {
    let breaks = line.chars().count() > WIDTH || line.contains("], [");
    // a comment that is broken is no comment any more
    let list = if breaks && !line.contains("//") { longest_list(line) } else { None };
    let Some(List { before, items, after }) = list else {
        text.extend([line, "\n"]);
        return;
    };
    let outside = " ".repeat(line.len() - line.trim_start().len());
    let inside = format!("{outside}    ");
    text.extend([before, "\n"]);
    if items.iter().any(|item| item.ends_with([']', '}'])) {
        for item in items {
            push(text, &format!("{inside}{item},"));
        }
    } else {
        let mut current = inside.clone();
        for item in items {
            if current.len() > inside.len() && current.len() + item.len() >= WIDTH {
                text.extend([current.trim_end(), "\n"]);
                current.clone_from(&inside);
            }
            current = format!("{current}{item}, ");
        }
        text.extend([current.trim_end(), "\n"]);
    }
    text.extend([&outside, after, "\n"]);
}

/// A list in a line: the text up to its opening bracket, its items, and the text from its closing bracket.
struct List<'a> {
    before: &'a str,
    items: Vec<&'a str>,
    after: &'a str,
}

/// The longest outermost bracket that has a comma.
fn longest_list(line: &str) -> Option<List<'_>> {
    let (mut depth, mut in_string, mut commas) = (0, false, Vec::new());
    let mut longest: Option<Vec<usize>> = None; // its start, its commas, its end
    for (i, c) in line.char_indices() {
        match c {
            '"' if !line[..i].ends_with('\\') => in_string = !in_string,
            _ if in_string => {}
            '(' | '[' | '{' => {
                depth += 1;
                if depth == 1 {
                    commas = vec![i];
                }
            }
            ',' if depth == 1 => commas.push(i),
            ')' | ']' | '}' if depth > 0 => {
                depth -= 1;
                if depth == 0 && commas.len() > 1 {
                    commas.push(i);
                    let extent = |places: &[usize]| places[places.len() - 1] - places[0];
                    if longest.as_ref().is_none_or(|longest| extent(longest) < extent(&commas)) {
                        longest = Some(commas.clone());
                    }
                }
            }
            _ => {}
        }
    }
    let places = longest?;
    let items = places.windows(2).map(|ends| line[ends[0] + 1..ends[1]].trim()).filter(|item| !item.is_empty());
    Some(List { before: &line[..=places[0]], items: items.collect(), after: &line[places[places.len() - 1]..] })
}
