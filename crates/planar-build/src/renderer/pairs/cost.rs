//! What pairs cost beside the operations that they save: numbers have to be joined to pairs, and pairs to be parted.

use super::names::Names;
use super::pairing::Pairing;
use crate::format::{Operand, Operation, Statement};
use std::collections::{HashMap, HashSet};

/// Drops the pairs that save less than it takes to join their operands and to part their results; whether there were any.
pub fn drop_costly(pairings: &mut Vec<Pairing>, statements: &[Statement], earlier: &Names) -> bool {
    let is_in_pair: HashSet<usize> = pairings.iter().flat_map(|pairing| pairing.statements).collect();
    let assigned: HashSet<&str> = statements.iter().flat_map(|statement| statement.targets.names()).collect();
    let is_computed = |operand: &Operand| {
        operand.name().is_some_and(|name| assigned.contains(name) || earlier.halves.contains_key(name))
    };
    // pairs that are there, by their halves
    let mut halves: HashMap<&str, &str> = HashMap::new();
    for Pairing { statements: [first, second], .. } in pairings.iter() {
        let [first, second] = [first, second].map(|index| statements[*index].targets.names());
        halves.extend(first.into_iter().zip(second));
    }
    let is_pair = |operands: &[Operand; 2]| match operands.each_ref().map(Operand::name) {
        [Some(a), Some(b)] => a == b || halves.get(a) == Some(&b) || earlier.pair_of(operands).is_some(),
        _ => true,
    };
    let mut joined: HashMap<String, u32> = HashMap::new();
    let key = |[a, b]: &[Operand; 2]| format!("{a:?} {b:?}");
    for pair in pairings.iter().flat_map(|pairing| &pairing.operands).filter(|pair| !is_pair(pair)) {
        *joined.entry(key(pair)).or_default() += 1;
    }
    // what single statements, joined operands and results need
    let singles = statements.iter().enumerate().filter(|(index, _)| !is_in_pair.contains(index));
    let singles = singles.flat_map(|(_, statement)| statement.reads());
    let parts = pairings.iter().flat_map(|pairing| &pairing.operands).filter(|pair| !is_pair(pair)).flatten();
    let parted: HashSet<&str> = singles.chain(parts.filter_map(Operand::name)).collect();
    let saved = |pairing: &Pairing| {
        let operation = statements[pairing.statements[0]].operation;
        let operation = if operation == Operation::Div { 5.0 } else { 1.0 };
        let join = |pair: &[Operand; 2]| {
            let each = if pair.iter().any(is_computed) { 1.0 } else { 0.5 };
            if is_pair(pair) { 0.0 } else { each / f64::from(joined[&key(pair)]) }
        };
        let second = statements[pairing.statements[1]].targets.names();
        let part = if second.iter().any(|name| parted.contains(name)) { 0.5 } else { 0.0 };
        operation - pairing.operands.iter().map(join).sum::<f64>() - part
    };
    // sines stay numbers
    let is_sine = |pairing: &&Pairing| statements[pairing.statements[0]].operation == Operation::SinCos;
    let kept: Vec<Pairing> =
        pairings.iter().filter(|pairing| is_sine(pairing) || saved(pairing) > 0.0).cloned().collect();
    let has_dropped = kept.len() < pairings.len();
    *pairings = kept;
    has_dropped
}
