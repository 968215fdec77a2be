//! Products that are used once, in a sum, as one operation with it: a fused multiply-add.

use crate::format::{Operand, Operation, Statement};
use std::collections::HashMap;

/// Cycles from operands to result on current processors, about.
const LATENCIES: [(Operation, u32); 5] =
    [(Operation::Copy, 0), (Operation::Neg, 1), (Operation::SinCos, 60), (Operation::Div, 14), (Operation::Sqrt, 18)];
const LATENCY: u32 = 4;

/// ± a · b ± the addend.
#[derive(Clone, Copy, Debug)]
pub struct MultiplyAdd<'a> {
    pub a: &'a Operand,
    pub b: &'a Operand,
    pub addend: &'a Operand,
    pub is_product_negative: bool,
    pub is_addend_negative: bool,
}

/// Which statements of a stage are fused, by their indices: what they compute then; `None` for a product that another
/// one contains. `results` are used after the stage.
///
/// Of two products in a sum the one that is known later is fused, for the other has been computed when it comes.
/// `sources` are the names that statements assign of which a name is made.
pub fn fuse<'a>(
    statements: &'a [Statement],
    results: &[&str],
    sources: &dyn Fn(&'a str) -> Vec<&'a str>,
) -> HashMap<usize, Option<MultiplyAdd<'a>>> {
    let mut uses: HashMap<&str, usize> = HashMap::new();
    let operands = statements.iter().flat_map(Statement::reads);
    operands.chain(results.iter().copied()).for_each(|name| *uses.entry(name).or_default() += 1);
    let products: HashMap<&str, usize> = (statements.iter().enumerate())
        .filter(|(_, statement)| statement.operation == Operation::Mul)
        .filter_map(|(index, statement)| Some((*statement.targets.names().first()?, index)))
        .filter(|(name, _)| uses.get(name) == Some(&1))
        .collect();
    let mut times: HashMap<&str, u32> = HashMap::new();
    let mut fused = HashMap::new();
    for (index, statement) in statements.iter().enumerate() {
        let time = |operand: &'a Operand| {
            let sources = operand.name().map_or(Vec::new(), sources);
            sources.into_iter().filter_map(|name| times.get(name)).copied().max().unwrap_or(0)
        };
        let [a, b] = [time(&statement.a), time(&statement.b)];
        let latency = LATENCIES.iter().find(|(operation, _)| *operation == statement.operation);
        let mut known = a.max(b) + latency.map_or(LATENCY, |(_, latency)| *latency);
        if let Operation::Add | Operation::Sub = statement.operation {
            let product = |operand: &Operand| operand.name().and_then(|name| products.get(name)).copied();
            let is_difference = statement.operation == Operation::Sub;
            let first = product(&statement.a).map(|product| (product, &statement.b, [false, is_difference]));
            let second = product(&statement.b).map(|product| (product, &statement.a, [is_difference, false]));
            let late = if a > b { first.or(second) } else { second.or(first) };
            if let Some((product, addend, [is_product_negative, is_addend_negative])) = late {
                let Statement { a, b, .. } = &statements[product];
                known = time(a).max(time(b)).max(time(addend)) + LATENCY;
                let sum = MultiplyAdd { a, b, addend, is_product_negative, is_addend_negative };
                fused.insert(index, Some(sum));
                fused.insert(product, None);
            }
        }
        times.extend(statement.targets.names().into_iter().map(|name| (name, known)));
    }
    fused
}

#[cfg(test)]
mod tests;
