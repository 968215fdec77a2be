//! `planar-capture list`: what this program knows by name.

use super::{CommandError, print_product};
use crate::engine;
use crate::format::{Choice, Shape, TableFormat};
use crate::graphs::kept;
use crate::layout::Layout;
use crate::plain_text::{count, wrap};
use crate::program::Program;
use crate::scenario::{self, LawFormat, LawNumber};
use std::process::ExitCode;

/// List what this program knows by name.
///
/// Those are robots, with what computes them, the graphs in your cache folder, and the names that scenarios choose from: trajectories, control laws,
/// integrators, kinds of contacts.
#[derive(Debug, clap::Args)]
pub struct Arguments {}

/// Columns before an explanation.
const NAME: usize = 25;

/// Prints the list.
pub fn run(_: &Arguments, program: Program<'_>) -> Result<ExitCode, CommandError> {
    let mut text = String::from("robots: arms of links, what computes them\n");
    for (name, toml) in program.robots.layouts() {
        let layout = Layout::parse(toml, name)?;
        let links: Vec<_> = layout.arms.iter().map(|arm| arm.links.len()).collect();
        let engine = engine::Choice::fastest(&layout, program.robots).0.engine.name();
        text += &item(name, &format!("{}, {engine}", arms(&links)));
    }
    let kept = kept();
    if let Some(folder) = kept.first().and_then(|(path, _)| path.parent()) {
        text.extend(["\ngraphs that were derived, in ", &folder.display().to_string(), "\n"]);
        for (path, links) in &kept {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            text += &item(&name, &arms(links));
        }
    }
    let laws = program.law_formats();
    let mut all = Vec::new();
    collect(&mut all, "", &scenario::FORMAT);
    for (keys, choices) in all {
        text.extend(["\n", &keys.join(", "), "\n"]);
        text.extend(choices.iter().map(|choice| item(choice.name, &choice.doc.replace('`', ""))));
        for (key, own) in [("approach.tracking", &laws.tracking), ("post_impact.control", &laws.post_capture)] {
            if keys.iter().any(|known| known == key) {
                text.extend(own.iter().map(own_law));
            }
        }
    }
    print_product(&text)?;
    Ok(ExitCode::SUCCESS)
}

/// The arms of a robot by their numbers of links.
fn arms(links: &[usize]) -> String {
    let each: Vec<_> = links.iter().map(usize::to_string).collect();
    format!("{} of {}", count(links.len(), "arm"), each.join(" + "))
}

/// What the keys of a table, and of those in it, choose from, with the keys that have the same choices.
fn collect(all: &mut Vec<(Vec<String>, Vec<Choice>)>, path: &str, table: &'static TableFormat) {
    for key in table.keys {
        let path = format!("{path}{}", key.name);
        if let Shape::Table(inner) | Shape::Tables(inner) = key.shape {
            collect(all, &format!("{path}."), inner);
        } else if let Some(choices) = key.shape.choices() {
            match all.iter_mut().find(|(_, known)| *known == choices) {
                Some((keys, _)) => keys.push(path),
                None => all.push((vec![path], choices)),
            }
        }
    }
}

/// A law of the program's own, with the keys of its table `law`.
fn own_law(format: &LawFormat) -> String {
    let numbers = format.numbers.iter().map(|LawNumber { key, rule, default }| match default {
        Some(default) => format!("{key} = {default} {}", rule.unit()).trim_end().to_owned(),
        None => format!("{key}, {rule}"),
    });
    let numbers: Vec<_> = numbers.collect();
    let law = if numbers.is_empty() { String::new() } else { format!("; law: {}", numbers.join(", ")) };
    item(format.name, &format!("of this program: {}{law}", format.doc))
}

/// A name with its explanation beside it.
fn item(name: &str, explanation: &str) -> String {
    let lines = wrap(&format!("  {name:<width$}", width = NAME - 2), &" ".repeat(NAME), explanation);
    lines.iter().flat_map(|line| [line.trim_end(), "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::{LawFormat, LawNumber, own_law};
    use crate::format::NumberRule;

    const NUMBERS: &[LawNumber] = &[
        LawNumber { key: "stiffness", rule: NumberRule::positive("a stiffness", "N m/rad"), default: None },
        LawNumber { key: "share", rule: NumberRule::any("a share", ""), default: Some(0.5) },
        LawNumber { key: "reach", rule: NumberRule::any("a length", "m"), default: Some(2.0) },
    ];

    #[test]
    fn a_law_of_ones_own_is_listed_with_its_numbers() {
        let law = LawFormat { name: "spring", doc: "pulls back.", numbers: NUMBERS };
        let words: Vec<_> = own_law(&law).split_whitespace().map(str::to_owned).collect();
        assert_eq!(
            words.join(" "),
            "spring of this program: pulls back.; law: stiffness, a stiffness in N m/rad greater than 0, share = 0.5, \
             reach = 2 m"
        );
    }
}
