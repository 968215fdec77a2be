//! A function of configuration and velocities in one piece, in two halves, for standalone modules.
//!
//! What the velocities contribute needs many values of the configuration, and gives few. It is computed as soon as these
//! values are there. Between the halves the compiler is told nothing of the few and of the model's numbers: on a processor
//! with few registers it would else compute the rest of the configuration first, with all of both on the stack.

use super::loops;
use super::needed::{needed, stage};
use super::statements::{Scope, bindings, fields};
use super::syntax::Syntax;
use crate::format::{Family, Function, Operand, Statement, Variable, section_at};
use std::collections::{HashMap, HashSet};

/// Statements, each with the name of its section.
type Half<'a> = Vec<(&'a str, &'a Statement)>;

/// The lines of a function, those of its result at the end. None where it has no halves: where it has no matrix, or one that
/// depends on velocities, or what depends on them needs all of the configuration.
pub fn in_halves(
    family: &Family,
    function: &Function,
    scope: &Scope<'_>,
    result: impl FnOnce() -> Vec<String>,
) -> Option<Vec<String>> {
    let [first, second] = halves(family, function)?.map(|half| stage(&half));
    let results = loops::names(&function.outputs);
    let (sections, statements) = needed(&[(&second.0, &second.1)], &results);
    let is_read: HashSet<&str> = statements.iter().flat_map(Statement::reads).chain(results.iter().copied()).collect();
    let assigned = first.1.iter().flat_map(|statement| statement.targets.names());
    let crossing: Vec<&str> = assigned.filter(|name| is_read.contains(name)).collect();
    let (first_sections, first_statements) = needed(&[(&first.0, &first.1)], &crossing);
    let mut lines = scope.lines(&first_sections, &first_statements, &crossing);
    let mut rest = scope.lines(&sections, &statements, &results);
    rest.extend(result());
    let bound = bindings(&[&lines[..], &rest].concat(), "self", Syntax::Rust);
    let of_velocities: HashSet<&str> = function.statements.iter().flat_map(|s| s.targets.names()).collect();
    let few: Vec<&str> = crossing.into_iter().filter(|name| of_velocities.contains(name)).collect();
    lines.push(format!("let [{few}] = read_again([{few}]);", few = few.join(", ")));
    lines.extend(fields(&rest, Syntax::Rust).map(|field| format!("let {field} = read_again({field});")));
    Some([bound, lines, rest].concat())
}

/// The statements up to the last section of the configuration that is needed by all sections of the function but its last,
/// and all of the function that need no more; then the others.
fn halves<'a>(family: &'a Family, function: &'a Function) -> Option<[Half<'a>; 2]> {
    let configuration = &family.configuration;
    let mut section_of: HashMap<&str, usize> = HashMap::new();
    for (index, statement) in configuration.statements.iter().enumerate() {
        let section = configuration.sections.partition_point(|(_, start)| *start <= index);
        section_of.extend(statement.targets.names().into_iter().map(|name| (name, section)));
    }
    let is_early =
        |output: &Variable| output.elements.iter().filter_map(Operand::name).all(|n| section_of.contains_key(n));
    let mut matrices = function.outputs.iter().filter(|output| output.shape.len() == 2).peekable();
    if function.is_in_loops() || matrices.peek().is_none() || !matrices.all(is_early) {
        return None;
    }
    for statement in &function.statements {
        let needs = statement.reads().filter_map(|name| section_of.get(name)).max().copied().unwrap_or(0);
        section_of.extend(statement.targets.names().into_iter().map(|name| (name, needs)));
    }
    let needs =
        |statement: &Statement| statement.targets.names().iter().filter_map(|name| section_of.get(name)).max().copied();
    let (_, last) = function.sections.last()?;
    let boundary = function.statements[..*last].iter().filter_map(needs).max()?;
    if boundary == configuration.sections.len() {
        return None;
    }
    let stages = [(&configuration.sections, &configuration.statements), (&function.sections, &function.statements)];
    let of_stage = |(sections, statements): (&'a Vec<(String, usize)>, &'a Vec<Statement>)| {
        statements.iter().enumerate().map(|(index, statement)| (section_at(sections, index), statement))
    };
    let all = stages.into_iter().flat_map(of_stage);
    let (first, second) = all.partition(|(_, statement)| needs(statement) <= Some(boundary));
    Some([first, second])
}

#[cfg(test)]
mod tests;
