//! Keys of varied values: dotted paths of TOML, tables of a list by their names, elements of a list by their index.
//!
//! `target.target1.inertia`, `target."my.t".mass`, `layout.arm.arm1.link[0].com[1]`.

use std::fmt::{self, Display, Formatter};

/// One part of a path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// A key of a table, or the name of a table in a list.
    Name(String),
    /// The place in a list.
    Index(usize),
}

/// A path from the root of a scenario, at least one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KeyPath(pub Vec<Step>);

impl KeyPath {
    /// Reads a path.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn parse(text: &str) -> Result<Self, String> {
        let mut steps = Vec::new();
        let mut rest = text;
        loop {
            let (name, after) = name(rest)?;
            steps.push(Step::Name(name));
            rest = after;
            while let Some(inner) = rest.strip_prefix('[') {
                let (index, after) = inner.split_once(']').ok_or("a `[` without its `]`")?;
                let index = index.parse().map_err(|_| format!("`[{index}]` is no index, expected `[0]`, `[1]` …"))?;
                steps.push(Step::Index(index));
                rest = after;
            }
            if rest.is_empty() {
                return Ok(Self(steps));
            }
            rest = rest.strip_prefix('.').ok_or_else(|| format!("expected `.` or `[` before `{rest}`"))?;
        }
    }
}

impl Display for KeyPath {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            match step {
                Step::Index(index) => write!(f, "[{index}]")?,
                Step::Name(name) => {
                    let dot = if i == 0 { "" } else { "." };
                    let quote = if name.is_empty() || !name.chars().all(is_bare) { "\"" } else { "" };
                    write!(f, "{dot}{quote}{name}{quote}")?;
                }
            }
        }
        Ok(())
    }
}

fn is_bare(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_' || c == '-'
}

/// A name at the start of a text, and the text after it.
fn name(text: &str) -> Result<(String, &str), String> {
    for quote in ['"', '\''] {
        if let Some(quoted) = text.strip_prefix(quote) {
            let (name, rest) = quoted.split_once(quote).ok_or_else(|| format!("a `{quote}` without a second one"))?;
            return Ok((name.to_owned(), rest));
        }
    }
    let end = text.find(|c| !is_bare(c)).unwrap_or(text.len());
    match text.split_at(end) {
        ("", "") => Err("a key is missing at its end".to_owned()),
        ("", rest) => {
            Err(format!("expected a key before `{rest}`; other than letters, digits, `_` and `-` stand in quotes"))
        }
        (name, rest) => Ok((name.to_owned(), rest)),
    }
}

#[cfg(test)]
mod tests {
    use super::KeyPath;

    #[test]
    fn paths_are_read_and_shown() {
        for path in ["approach.duration", "target.\"my.t\".mass", "layout.arm.arm1.link[0].com[1]", "case.a-1.x[2]"] {
            assert_eq!(KeyPath::parse(path).expect("a path").to_string(), path);
        }
        assert_eq!(KeyPath::parse("target.'t'.mass").expect("a path").to_string(), "target.t.mass");
    }

    #[test]
    fn malformed_paths_are_refused() {
        for path in ["", "a.", ".a", "a..b", "a[", "a[x]", "a[-1]", "a]", "a[0]b", "\"a", "a b", "[0]"] {
            assert!(KeyPath::parse(path).is_err(), "{path}");
        }
    }
}
