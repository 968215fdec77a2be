//! Statements of two arms of equal structure as one statement on pairs of numbers: the first is the earlier arm's.
//!
//! The operations are the same, number by number, and so are the bits of all results.

use super::symmetry::Symmetry;
use crate::format::{Operand, Operation, Statement, Targets};
use std::collections::{HashMap, HashSet};

/// Statements of a stage, some of them on pairs, in an order in which each comes after those that it needs.
#[derive(Debug, Default)]
pub struct Stage {
    pub sections: Vec<(String, usize)>,
    pub statements: Vec<Statement>,
    pub names: Names,
}

/// Stages of more statements are not paired: they are limited by memory, and a compiler takes many times as long for them.
const MOST: usize = 4000;

/// How the names of pairs and of numbers are made of each other.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Numbers that are half of a pair: its name, and which half.
    pub halves: HashMap<String, (String, Half)>,
    /// Operands that are made of two.
    pub joined: HashMap<String, [Operand; 2]>,
    /// All names of pairs that statements assign.
    pub pairs: HashSet<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Half {
    First,
    Second,
}

/// Two statements that become one, with the operands that go together.
#[derive(Clone, Debug)]
struct Pairing {
    statements: [usize; 2],
    operands: Vec<[Operand; 2]>,
}

impl Stage {
    /// Of a stage, of which `results` are used after it. `earlier` are the names of the stage before it.
    pub fn new(
        symmetry: &mut Symmetry,
        sections: &[(String, usize)],
        statements: &[Statement],
        results: &[(&str, &str)],
        earlier: &Names,
    ) -> Self {
        let is_short = statements.len() <= MOST;
        let mut pairings = if is_short { found(symmetry, statements, results, earlier) } else { Vec::new() };
        loop {
            match Writer::new(sections, statements, &pairings, earlier).write() {
                Ok(stage) => return stage,
                Err(wrong) => drop(pairings.remove(wrong)),
            }
        }
    }
}

/// The pairs of a stage that save something.
fn found(symmetry: &mut Symmetry, statements: &[Statement], results: &[(&str, &str)], earlier: &Names) -> Vec<Pairing> {
    let mut pairs = symmetry.extend(statements);
    pairs.extend(before(symmetry, statements, &pairs, results));
    let mut pairings = pairs.into_iter().map(|pair| Pairing::new(symmetry, statements, pair)).collect();
    while drop_costly(&mut pairings, statements, earlier) {}
    pairings
}

/// Pairs of statements that results of two arms need, and that are not among those that were found from the inputs.
fn before(
    symmetry: &mut Symmetry,
    statements: &[Statement],
    found: &[[usize; 2]],
    results: &[(&str, &str)],
) -> Vec<[usize; 2]> {
    let assigned: HashMap<&str, usize> = (statements.iter().enumerate())
        .flat_map(|(index, statement)| statement.targets.names().into_iter().map(move |name| (name, index)))
        .collect();
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

/// Drops the pairs that save less than it takes to join their operands and to part their results; whether there were any.
fn drop_costly(pairings: &mut Vec<Pairing>, statements: &[Statement], earlier: &Names) -> bool {
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
    let is_pair = |[a, b]: &[Operand; 2]| match (a.name(), b.name()) {
        (Some(a), Some(b)) => {
            let of = |name: &str| earlier.halves.get(name).map(|(pair, half)| (pair, *half));
            let is_earlier = matches!(
                (of(a), of(b)),
                (Some((pair, Half::First)), Some((other, Half::Second))) if pair == other
            );
            a == b || halves.get(a) == Some(&b) || is_earlier
        }
        _ => true,
    };
    let mut joined: HashMap<String, u32> = HashMap::new();
    let key = |[a, b]: &[Operand; 2]| format!("{a:?} {b:?}");
    for pair in pairings.iter().flat_map(|pairing| &pairing.operands).filter(|pair| !is_pair(pair)) {
        *joined.entry(key(pair)).or_default() += 1;
    }
    // what single statements, joined operands and results need
    let singles = statements.iter().enumerate().filter(|(index, _)| !is_in_pair.contains(index));
    let singles = singles.flat_map(|(_, statement)| [&statement.a, &statement.b]);
    let parts = pairings.iter().flat_map(|pairing| &pairing.operands).filter(|pair| !is_pair(pair)).flatten();
    let parted: HashSet<&str> = singles.chain(parts).filter_map(Operand::name).collect();
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
    let before = pairings.len();
    let is_kept = pairings
        .iter()
        .map(|pairing| statements[pairing.statements[0]].operation == Operation::SinCos || saved(pairing) > 0.0);
    let mut is_kept = is_kept.collect::<Vec<_>>().into_iter();
    pairings.retain(|_| is_kept.next().unwrap_or(true));
    pairings.len() < before
}

/// Whether pairs have the operation.
fn is_paired(statement: &Statement) -> bool {
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
    let is_commutative = matches!(first.operation, Operation::Add | Operation::Mul);
    let straight = are_counterparts(&first.a, &second.a) || are_counterparts(&first.b, &second.b);
    if is_commutative && !straight && (are_counterparts(&first.a, &second.b) || are_counterparts(&first.b, &second.a)) {
        vec![[&first.a, &second.b], [&first.b, &second.a]]
    } else {
        vec![[&first.a, &second.a], [&first.b, &second.b]]
    }
}

impl Pairing {
    fn new(symmetry: &Symmetry, statements: &[Statement], pair: [usize; 2]) -> Self {
        let operands = together(symmetry, statements, pair);
        Self { statements: pair, operands: operands.into_iter().map(|pair| pair.map(Clone::clone)).collect() }
    }
}

/// Writes statements, each after those that it needs.
struct Writer<'a> {
    sections: &'a [(String, usize)],
    statements: &'a [Statement],
    pairings: &'a [Pairing],
    /// Of statements that are part of a pair, its index.
    pairing: HashMap<usize, usize>,
    assigned: HashMap<&'a str, usize>,
    state: Vec<State>,
    stage: Stage,
    section: String,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    Unwritten,
    Begun,
    Written,
}

impl<'a> Writer<'a> {
    fn new(
        sections: &'a [(String, usize)],
        statements: &'a [Statement],
        pairings: &'a [Pairing],
        earlier: &'a Names,
    ) -> Self {
        let pairing = pairings.iter().enumerate().filter(|(_, pairing)| is_paired(&statements[pairing.statements[0]]));
        Self {
            sections,
            statements,
            pairings,
            pairing: pairing.flat_map(|(place, pairing)| pairing.statements.map(|index| (index, place))).collect(),
            assigned: (statements.iter().enumerate())
                .flat_map(|(index, statement)| statement.targets.names().into_iter().map(move |name| (name, index)))
                .collect(),
            state: vec![State::Unwritten; statements.len()],
            stage: Stage { names: earlier.clone(), ..Stage::default() },
            section: String::new(),
        }
    }

    /// All statements; the index of a pair that needs its own result.
    fn write(mut self) -> Result<Stage, usize> {
        for index in 0..self.statements.len() {
            self.statement(index)?;
        }
        Ok(self.with_names_for_joined())
    }

    fn statement(&mut self, index: usize) -> Result<(), usize> {
        let place = self.pairing.get(&index).copied();
        match self.state[index] {
            State::Written => return Ok(()),
            // only pairs can need themselves; any of those that are begun may be the one
            State::Begun => return Err(place.unwrap_or(self.begun())),
            State::Unwritten => {}
        }
        let both = place.map_or(vec![index], |place| self.pairings[place].statements.to_vec());
        for index in &both {
            self.state[*index] = State::Begun;
        }
        for index in &both {
            let Statement { a, b, .. } = &self.statements[*index];
            for name in [a, b].into_iter().filter_map(Operand::name) {
                if let Some(needed) = self.assigned.get(name) {
                    self.statement(*needed)?;
                }
            }
        }
        for index in &both {
            self.state[*index] = State::Written;
        }
        let section = self.section_of(&both);
        if section != self.section {
            self.stage.sections.push((section.clone(), self.stage.statements.len()));
            self.section = section;
        }
        let first = &self.statements[both[0]];
        match place {
            Some(place) if first.operation != Operation::SinCos => self.pair(place),
            // sines are computed together anyway
            _ => self.stage.statements.extend(both.iter().map(|index| self.statements[*index].clone())),
        }
        Ok(())
    }

    fn begun(&self) -> usize {
        let is_begun = |pairing: &Pairing| pairing.statements.iter().any(|index| self.state[*index] == State::Begun);
        self.pairings.iter().position(is_begun).unwrap_or(0)
    }

    fn pair(&mut self, place: usize) {
        let Pairing { statements: [first, second], operands } = &self.pairings[place];
        let [first, second] = [first, second].map(|index| &self.statements[*index]);
        let (a, b) = (first.targets.names()[0], second.targets.names()[0]);
        let name = self.stage.names.name_of([a, b]);
        let mut operands = operands.iter().map(|pair| self.stage.names.operand(pair)).collect::<Vec<_>>().into_iter();
        self.stage.statements.push(Statement {
            targets: Targets::Value(name.clone()),
            operation: first.operation,
            a: operands.next().unwrap_or(Operand::Number(f64::NAN)),
            b: operands.next().unwrap_or(Operand::Number(f64::NAN)),
        });
        self.stage.names.halves.insert(a.to_owned(), (name.clone(), Half::First));
        self.stage.names.halves.insert(b.to_owned(), (name.clone(), Half::Second));
        self.stage.names.pairs.insert(name);
    }

    /// The section of a statement; of two arms, of both.
    fn section_of(&self, both: &[usize]) -> String {
        let section = |index: usize| {
            let begun = self.sections.partition_point(|(_, start)| *start <= index);
            begun.checked_sub(1).map_or("", |last| self.sections[last].0.as_str())
        };
        let [a, b] = [both.first(), both.last()].map(|index| index.map_or("", |index| section(*index)));
        let arm = |text: &'a str| text.strip_prefix("arm ").and_then(|rest| rest.split_once(", "));
        match [arm(a), arm(b)] {
            [Some((first, what)), Some((second, same))] if what == same && first != second => {
                format!("arms {first} and {second}, {what}")
            }
            _ => a.to_owned(),
        }
    }

    /// What is joined more than once gets a name.
    fn with_names_for_joined(self) -> Stage {
        let Stage { sections, statements, mut names } = self.stage;
        let mut uses: HashMap<&str, usize> = HashMap::new();
        let operands = statements.iter().flat_map(|statement| [&statement.a, &statement.b]).filter_map(Operand::name);
        operands.filter(|name| names.joined.contains_key(*name)).for_each(|name| *uses.entry(name).or_default() += 1);
        let is_named = |key: &str| {
            let is_number = names.joined.get(key).is_some_and(|[a, _]| a.name().is_none());
            uses.get(key).is_some_and(|uses| *uses > 1) && !is_number
        };
        let named: HashSet<String> = uses.keys().filter(|key| is_named(key)).map(|key| (*key).to_owned()).collect();
        let mut stage = Stage { sections: Vec::new(), statements: Vec::new(), names: Names::default() };
        let mut given: HashMap<String, String> = HashMap::new();
        for (index, mut statement) in statements.into_iter().enumerate() {
            let section = sections.iter().find(|(_, start)| *start == index);
            stage.sections.extend(section.map(|(name, _)| (name.clone(), stage.statements.len())));
            for operand in [&mut statement.a, &mut statement.b] {
                let Operand::Name(key) = operand else { continue };
                if !named.contains(key) {
                    continue;
                }
                if !given.contains_key(key) {
                    let [a, b] = &names.joined[key];
                    let name = names.name_of([a.name().unwrap_or_default(), b.name().unwrap_or_default()]);
                    names.pairs.insert(name.clone());
                    stage.statements.push(Statement {
                        targets: Targets::Value(name.clone()),
                        operation: Operation::Copy,
                        a: Operand::Name(key.clone()),
                        b: Operand::Number(f64::NAN),
                    });
                    given.insert(key.clone(), name);
                }
                *operand = Operand::Name(given[key].clone());
            }
            stage.statements.push(statement);
        }
        stage.names = names;
        stage
    }
}

impl Names {
    /// The fields in which values are kept for the next stage, and the names that it begins with: a pair is one of them
    /// where both of its halves are values.
    pub fn fields<'a>(&'a self, values: &[&'a str]) -> (Vec<&'a str>, Self) {
        let wanted: HashSet<&str> = values.iter().copied().collect();
        let mut whole: HashMap<&str, usize> = HashMap::new();
        let pairs = self.halves.iter().filter(|(name, _)| wanted.contains(name.as_str()));
        pairs.for_each(|(_, (pair, _))| *whole.entry(pair.as_str()).or_default() += 1);
        let is_whole = |pair: &str| whole.get(pair) == Some(&2);
        let mut fields: Vec<&str> = Vec::new();
        for value in values {
            let field = self.halves.get(*value).map(|(pair, _)| pair.as_str()).filter(|pair| is_whole(pair));
            let field = field.unwrap_or(value);
            if fields.last() != Some(&field) && !fields.contains(&field) {
                fields.push(field);
            }
        }
        let halves = self.halves.iter().filter(|(_, (pair, _))| is_whole(pair));
        let halves = halves.map(|(name, half)| (name.clone(), half.clone())).collect();
        let pairs = self.pairs.iter().filter(|pair| is_whole(pair)).cloned().collect();
        (fields, Self { halves, pairs, joined: HashMap::new() })
    }

    pub fn has_pairs(&self) -> bool {
        !self.pairs.is_empty()
    }

    /// Whether a name is a pair's.
    pub fn is_pair(&self, name: &str) -> bool {
        self.pairs.contains(name)
    }

    /// Two operands as one: the pair whose halves they are, or one that is made of them.
    fn operand(&mut self, [a, b]: &[Operand; 2]) -> Operand {
        let half = |operand: &Operand| operand.name().and_then(|name| self.halves.get(name));
        if let (Some((pair, Half::First)), Some((other, Half::Second))) = (half(a), half(b))
            && pair == other
        {
            return Operand::Name(pair.clone());
        }
        let text = |operand: &Operand| match operand {
            Operand::Number(number) => format!("{number:?}"),
            Operand::Name(name) => name.clone(),
        };
        let key = format!("{} & {}", text(a), text(b));
        self.joined.entry(key.clone()).or_insert_with(|| [a.clone(), b.clone()]);
        Operand::Name(key)
    }

    /// The name of a pair: both names, the second without what it has in common with the first one's beginning.
    fn name_of(&self, [a, b]: [&str; 2]) -> String {
        let plain = |name: &str| name.replace("][", "_").replace('[', "_").replace(']', "");
        let (a, b) = (plain(a), plain(b));
        let mut name = if a == b { format!("{a}_both") } else { format!("{a}_{b}") };
        while self.pairs.contains(&name) || self.halves.contains_key(&name) {
            name.push_str("_pair");
        }
        name
    }
}

#[cfg(test)]
mod tests;
