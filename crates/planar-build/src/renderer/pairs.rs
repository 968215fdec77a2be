//! Statements of two arms of equal structure as one statement on pairs of numbers: the first is the earlier arm's.
//!
//! The operations are the same, number by number, and so are the bits of all results.

mod cost;
mod names;
mod pairing;
mod stage;
mod writer;

pub use names::{Half, Names};
pub use stage::Stage;

use super::symmetry::Symmetry;
use crate::format::Statement;
use cost::drop_costly;
use pairing::{Pairing, before, is_paired};
use writer::Writer;

/// Stages of more statements are not paired: they are limited by memory, and a compiler takes many times as long for them.
const MOST: usize = 4000;

/// A stage in pairs, of which `results` are used after it, each with that of the other arm. `earlier` are the names of the
/// stage before it. What is found to be symmetric is added to `symmetry`.
pub fn paired(
    symmetry: &mut Symmetry,
    sections: &[(String, usize)],
    statements: &[Statement],
    results: &[(&str, &str)],
    earlier: &Names,
) -> Stage {
    let is_short = statements.len() <= MOST;
    let mut pairings = if is_short { found(symmetry, statements, results, earlier) } else { Vec::new() };
    loop {
        match Writer::new(sections, statements, &pairings, earlier).write() {
            Ok(stage) => return stage,
            Err(wrong) => drop(pairings.remove(wrong)),
        }
    }
}

/// The pairs of a stage that save something.
fn found(symmetry: &mut Symmetry, statements: &[Statement], results: &[(&str, &str)], earlier: &Names) -> Vec<Pairing> {
    let mut pairs = symmetry.extend(statements);
    pairs.extend(before(symmetry, statements, &pairs, results));
    let pairs = pairs.into_iter().filter(|[first, _]| is_paired(&statements[*first]));
    let mut pairings = pairs.map(|pair| Pairing::new(symmetry, statements, pair)).collect();
    while drop_costly(&mut pairings, statements, earlier) {}
    pairings
}

#[cfg(test)]
mod tests;
