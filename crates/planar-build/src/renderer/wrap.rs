//! Lines that are too long, broken at the commas of a list.

use super::syntax::Syntax;

/// Columns of a line.
const WIDTH: usize = 120;

/// The text with its long lists broken: one entry a line where an entry is a list itself, else as many as fit. A matrix
/// is always broken into its rows. No blank line begins or ends a block.
pub fn wrap(text: &str, syntax: Syntax) -> String {
    let mut wrapped = String::with_capacity(text.len());
    for line in text.lines().map(str::trim_end) {
        if line.is_empty() && (wrapped.ends_with("{\n") || wrapped.ends_with("\n\n")) {
            continue;
        }
        if line.trim_start().starts_with('}') && wrapped.ends_with("\n\n") {
            wrapped.pop();
        }
        push(&mut wrapped, line, syntax);
    }
    wrapped
}

fn push(text: &mut String, line: &str, syntax: Syntax) {
    let breaks = line.chars().count() > WIDTH || line.contains("], [");
    // a comment that is broken is no comment any more
    let list = if breaks && !line.contains("//") { longest_list(line) } else { None };
    let Some(List { before, items, after }) = list else {
        text.extend([line, "\n"]);
        return;
    };
    let outside = " ".repeat(line.len() - line.trim_start().len());
    let inside = format!("{outside}    ");
    let ending = syntax.after_last(before);
    text.extend([before, "\n"]);
    if items.iter().any(|item| item.ends_with([']', '}'])) {
        let count = items.len();
        for (i, item) in items.into_iter().enumerate() {
            push(text, &format!("{inside}{item}{}", if i + 1 == count { ending } else { "," }), syntax);
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
        text.extend([current.trim_end().trim_end_matches(','), ending, "\n"]);
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

#[cfg(test)]
mod tests {
    use super::{Syntax, WIDTH, longest_list};

    fn wrap(text: &str) -> String {
        super::wrap(text, Syntax::Rust)
    }

    /// The items of the list that is broken, and what stands before and after it.
    fn list(line: &str) -> Option<(&str, Vec<&str>, &str)> {
        longest_list(line).map(|list| (list.before, list.items, list.after))
    }

    #[test]
    fn the_longest_outermost_list_is_broken() {
        assert_eq!(
            list("f(a, b) + g(longer, list, here);"),
            Some(("f(a, b) + g(", vec!["longer", "list", "here"], ");"))
        );
        assert_eq!(
            list("g(longer, list, here) + f(a, b);"),
            Some(("g(", vec!["longer", "list", "here"], ") + f(a, b);"))
        );
        assert_eq!(list("f(a, b) + g(c, d);"), Some(("f(", vec!["a", "b"], ") + g(c, d);")), "the first of two");
        assert_eq!(list("f([a, b], {c, d});"), Some(("f(", vec!["[a, b]", "{c, d}"], ");")));
        assert_eq!(list("f(a, b,);"), Some(("f(", vec!["a", "b"], ");")), "an empty item is none");
        assert_eq!(list("f(a) + [b];"), None, "a list has a comma");
        assert_eq!(list("a, b) + c"), None, "an unopened bracket is no list");
        assert_eq!(list("a) + f(b, c);"), Some(("a) + f(", vec!["b", "c"], ");")), "and hides none");
    }

    #[test]
    fn brackets_and_commas_in_strings_are_text() {
        assert_eq!(list(r#"f("a, (b", c);"#), Some(("f(", vec![r#""a, (b""#, "c"], ");")));
        assert_eq!(list(r#"f("a \", ) b", c);"#), Some(("f(", vec![r#""a \", ) b""#, "c"], ");")));
        assert_eq!(list(r#"f("a, b");"#), None);
    }

    #[test]
    fn lines_are_broken_from_their_width_on() {
        let of_length = |length: usize| {
            let line = format!("let x = f(a, {});", "b".repeat(length - "let x = f(a, );".len()));
            assert_eq!(line.len(), length);
            wrap(&line)
        };
        assert_eq!(of_length(WIDTH).lines().count(), 1);
        assert_eq!(of_length(WIDTH + 1).lines().count(), 3);
        let long = wrap(&format!("    let [{}] = x;", vec!["name"; 60].join(", ")));
        assert!(long.lines().all(|line| line.len() <= WIDTH), "{long}");
        assert!(
            long.lines().skip(1).take(2).all(|line| line.len() > WIDTH - "name, ".len()),
            "lines are full:\n{long}"
        );
        assert!(long.starts_with("    let [\n        name, name") && long.ends_with("name,\n    ] = x;\n"), "{long}");
    }

    #[test]
    fn a_matrix_has_a_line_for_each_row_and_a_comment_stays_whole() {
        assert_eq!(wrap("m: [[a, b], [c, d]],"), "m: [\n    [a, b],\n    [c, d],\n],\n");
        let comment = format!("a: [b, c], // {}", "d, ".repeat(60).trim_end());
        assert_eq!(wrap(&comment), format!("{comment}\n"));
    }

    #[test]
    fn calls_in_c_have_no_comma_after_the_last_argument() {
        let call = format!("f(a, {});", "b".repeat(WIDTH));
        assert_eq!(super::wrap(&call, Syntax::C), format!("f(\n    a,\n    {}\n);\n", "b".repeat(WIDTH)));
        let list = format!("{{a, {}}}", "b".repeat(WIDTH));
        assert!(super::wrap(&list, Syntax::C).ends_with(",\n}\n"));
        let nested = format!("f({{a, b}}, {{c, {}}});", "d".repeat(WIDTH));
        assert!(super::wrap(&nested, Syntax::C).ends_with("    }\n);\n"));
    }

    #[test]
    fn blocks_neither_begin_nor_end_with_a_blank_line() {
        assert_eq!(wrap("a {\n\nb\n\n\nc\n\n}\n"), "a {\nb\n\nc\n}\n");
    }
}
