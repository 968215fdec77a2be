//! Names and texts of a graph that become a part of Rust code.

use planar_layout::diagnostic::{excerpt, is_hidden};
use planar_layout::layout::Layout;
use std::collections::HashSet;

pub fn identifier(what: &str, name: &str) -> Result<(), String> {
    // the rule of a layout's name, which is that of a module
    if Layout::is_name(name) {
        return Ok(());
    }
    Err(format!("{what} `{}` is no name: expected lower-case letters, digits and `_`, and no keyword", excerpt(name)))
}

/// Text for a comment and for documentation: of one line, which starts no block of code.
pub fn text(what: &str, text: &str) -> Result<(), String> {
    let starts_code = [" ", "```", "~~~"].iter().any(|start| text.starts_with(start));
    if text.contains(is_hidden) || starts_code {
        return Err(format!("{what} `{}` cannot be text of the module", excerpt(text)));
    }
    Ok(())
}

/// Text for a literal too, which nothing in it ends.
pub fn unit(unit: &str) -> Result<(), String> {
    if unit.contains(['"', '\\']) {
        return Err(format!("`{}` is no unit", excerpt(unit)));
    }
    text("unit", unit)
}

pub fn version(casadi: &str) -> Result<(), String> {
    let is_version = casadi.chars().all(|c| c.is_ascii_alphanumeric() || ".+-_".contains(c));
    if is_version { Ok(()) } else { Err(format!("`{}` is no version of CasADi", excerpt(casadi))) }
}

/// The names, none of them twice.
pub fn distinct<'a>(what: &str, names: impl Iterator<Item = &'a str>) -> Result<HashSet<&'a str>, String> {
    let mut found = HashSet::new();
    for name in names {
        if !found.insert(name) {
            return Err(format!("there are two of the {what} `{}`", excerpt(name)));
        }
    }
    Ok(found)
}

/// Options of the command that derived a graph, for a command line in a comment.
pub fn options(options: &[String]) -> Result<(), String> {
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "-_,:=".contains(c);
    match options.iter().find(|option| !option.chars().all(is_plain)) {
        Some(option) => Err(format!("`{}` is no option of its command", excerpt(option))),
        None => Ok(()),
    }
}
