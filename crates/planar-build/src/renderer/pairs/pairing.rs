//! Which statements of a stage become one: of equal arms, from the inputs forwards and from the results backwards.

use crate::format::{Operand, Operation, Statement};
use crate::renderer::symmetry::Symmetry;
use std::collections::{HashMap, HashSet};

/// Two statements that become one, with the operands that go together.
#[derive(Clone, Debug)]
pub struct Pairing {
    /// The earlier arm's first.
    pub statements: [usize; 2],
    pub operands: Vec<[Operand; 2]>,
}

impl Pairing {
    pub fn new(symmetry: &Symmetry, statements: &[Statement], pair: [usize; 2]) -> Self {
        let operands = together(symmetry, statements, pair);
        Self { statements: pair, operands: operands.into_iter().map(|pair| pair.map(Clone::clone)).collect() }
    }
}

/// Pairs of statements that results of two arms need, and that are not among those that were found from the inputs.
pub fn before(
    symmetry: &mut Symmetry,
    statements: &[Statement],
    found: &[[usize; 2]],
    results: &[(&str, &str)],
) -> Vec<[usize; 2]> {
    let assigned = assigned(statements);
    let mut known: HashSet<usize> = found.iter().flatten().copied().collect();
    let mut pairs = Vec::new();
    let mut left: Vec<(&str, &str)> = results.to_vec();
    while let Some((a, b)) = left.pop() {
        let (Some(&first), Some(&second)) = (assigned.get(a), assigned.get(b)) else { continue };
        let is_new = first != second && !known.contains(&first) && !known.contains(&second);
        if !is_new || statements[first].operation != statements[second].operation || !is_paired(&statements[first]) {
            continue;
        }
        known.extend([first, second]);
        let pair = symmetry.ordered(statements, [first, second]);
        symmetry.join(statements, pair);
        pairs.push(pair);
        for [a, b] in together(symmetry, statements, pair) {
            left.extend(a.name().zip(b.name()));
        }
    }
    pairs
}

/// The statement that assigns a name.
pub fn assigned(statements: &[Statement]) -> HashMap<&str, usize> {
    (statements.iter().enumerate())
        .flat_map(|(index, statement)| statement.targets.names().into_iter().map(move |name| (name, index)))
        .collect()
}

/// Whether pairs have the operation; sines are computed together anyway, beside each other.
pub fn is_paired(statement: &Statement) -> bool {
    matches!(
        statement.operation,
        Operation::Neg | Operation::Add | Operation::Sub | Operation::Mul | Operation::Div | Operation::SinCos
    )
}

/// The operands of two statements that go together.
fn together<'a>(symmetry: &Symmetry, statements: &'a [Statement], pair: [usize; 2]) -> Vec<[&'a Operand; 2]> {
    let [first, second] = pair.map(|index| &statements[index]);
    if first.operation.is_unary() {
        return vec![[&first.a, &second.a]];
    }
    let are_counterparts = |a: &Operand, b: &Operand| match (a, b) {
        (Operand::Name(a), Operand::Name(b)) => symmetry.counterpart(a) == Some(b) || a == b,
        (Operand::Number(a), Operand::Number(b)) => a.to_bits() == b.to_bits(),
        _ => false,
    };
    let straight = are_counterparts(&first.a, &second.a) || are_counterparts(&first.b, &second.b);
    let is_commutative = first.operation.is_commutative();
    if is_commutative && !straight && (are_counterparts(&first.a, &second.b) || are_counterparts(&first.b, &second.a)) {
        vec![[&first.a, &second.b], [&first.b, &second.a]]
    } else {
        vec![[&first.a, &second.a], [&first.b, &second.b]]
    }
}
