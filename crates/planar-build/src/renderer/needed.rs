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
    stage(&kept)
}

/// Sections and statements of a stage from statements with the names of their sections.
pub fn stage(statements: &[(&str, &Statement)]) -> (Vec<(String, usize)>, Vec<Statement>) {
    let begins = |index: &usize| *index == 0 || statements[index - 1].0 != statements[*index].0;
    let sections = (0..statements.len()).filter(begins).map(|index| (statements[index].0.to_owned(), index)).collect();
    (sections, statements.iter().map(|(_, statement)| (*statement).clone()).collect())
}
