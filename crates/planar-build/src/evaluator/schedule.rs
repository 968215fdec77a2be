//! The order of a program's steps.

use super::instruction::Kind;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// What a step waits for, and what it computes.
#[derive(Clone, Debug)]
pub(super) struct Wait {
    /// The steps whose results are operands.
    pub on: Vec<usize>,
    pub kind: Kind,
}

/// Between the starts of two steps, in cycles.
const INTERVAL: usize = 8;

/// How many steps are looked at for one of the same kind as the last.
const ALTERNATIVES: usize = 16;

impl Wait {
    /// From the start of the step to its result, in cycles: that of today's processors, through memory.
    fn latency(&self) -> usize {
        match self.kind {
            Kind::SinCos | Kind::Atan2 => 60,
            Kind::Div | Kind::Sqrt => 25,
            Kind::MulAdd | Kind::MulSub | Kind::SubMul | Kind::MulAddMul | Kind::MulSubMul => 16,
            Kind::Neg | Kind::Add | Kind::Sub | Kind::Mul | Kind::Min => 12,
        }
    }
}

/// A step by the longest chain of steps that begins with it.
type Candidate = (usize, Reverse<usize>);

/// An order in which a processor waits little that starts a step after the other and lets those overlap that do not
/// need each other. Of the steps whose operands are there it takes one of the same kind as the last, else the one that
/// the longest chain of others waits for. In forward dynamics of the paper's robot 224 instructions are 73 runs of one
/// kind, of 184 otherwise.
pub(super) fn schedule(steps: &[Wait]) -> Vec<usize> {
    let mut users = vec![Vec::new(); steps.len()];
    let mut missing: Vec<usize> = steps.iter().map(|step| step.on.len()).collect();
    for (index, step) in steps.iter().enumerate() {
        step.on.iter().for_each(|operand| users[*operand].push(index));
    }
    let mut chain = vec![0; steps.len()];
    for index in (0..steps.len()).rev() {
        let after = users[index].iter().map(|user| chain[*user]).max().unwrap_or(0);
        chain[index] = steps[index].latency() + after;
    }
    let mut ready_at = vec![0; steps.len()];
    let first = (0..steps.len()).filter(|index| missing[*index] == 0);
    let mut waiting: BinaryHeap<(Reverse<usize>, Candidate)> =
        first.map(|index| (Reverse(0), (chain[index], Reverse(index)))).collect();
    let mut ready: BinaryHeap<Candidate> = BinaryHeap::new();
    let mut order: Vec<usize> = Vec::with_capacity(steps.len());
    let mut now = 0;
    loop {
        while let Some((Reverse(at), candidate)) = waiting.peek().copied()
            && (at <= now || ready.is_empty())
        {
            waiting.pop();
            ready.push(candidate);
            now = now.max(at);
        }
        let last = order.last().map(|index| steps[*index].kind);
        let Some(index) = next(&mut ready, |index| Some(steps[index].kind) == last) else { return order };
        order.push(index);
        for user in &users[index] {
            ready_at[*user] = ready_at[*user].max(now + steps[index].latency());
            missing[*user] -= 1;
            if missing[*user] == 0 {
                waiting.push((Reverse(ready_at[*user]), (chain[*user], Reverse(*user))));
            }
        }
        now += INTERVAL;
    }
}

/// Takes the first of some candidates that is preferred, or the first of all.
fn next(ready: &mut BinaryHeap<Candidate>, is_preferred: impl Fn(usize) -> bool) -> Option<usize> {
    let mut some = Vec::with_capacity(ALTERNATIVES);
    while some.len() < ALTERNATIVES
        && let Some(candidate) = ready.pop()
    {
        some.push(candidate);
        if is_preferred(candidate.1.0) {
            break;
        }
    }
    let is_last = some.last().is_some_and(|(_, Reverse(index))| is_preferred(*index));
    let chosen = if is_last { some.len() - 1 } else { 0 };
    let taken = (chosen < some.len()).then(|| some.swap_remove(chosen));
    ready.extend(some);
    taken.map(|(_, Reverse(index))| index)
}
