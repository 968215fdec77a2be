//! The statements of several stages that some results need, as one stage.

use crate::format::{Statement, section_at};
use std::collections::HashSet;

/// A stage: its sections and its statements.
pub type Stage<'a> = (&'a [(String, usize)], &'a [Statement]);

/// What the results need of the stages, in their order.
pub fn needed(stages: &[Stage<'_>], results: &[&str]) -> (Vec<(String, usize)>, Vec<Statement>) {
    let mut wanted: HashSet<&str> = results.iter().copied().collect();
    let mut kept: Vec<(&str, &Statement)> = Vec::new();
    for (sections, statements) in stages.iter().rev() {
        for (index, statement) in statements.iter().enumerate().rev() {
            if statement.targets.names().iter().any(|name| wanted.contains(name)) {
                wanted.extend(statement.reads());
                kept.push((section_at(sections, index), statement));
            }
        }
    }
    kept.reverse();
    let begins = |index: &usize| *index == 0 || kept[index - 1].0 != kept[*index].0;
    let sections = (0..kept.len()).filter(begins).map(|index| (kept[index].0.to_owned(), index)).collect();
    (sections, kept.into_iter().map(|(_, statement)| statement.clone()).collect())
}
