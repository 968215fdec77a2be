//! The statements of a stage with its pairs, each after those that it needs.

use super::names::{Half, Names};
use super::pairing::{Pairing, assigned};
use super::stage::Stage;
use crate::format::{Operand, Operation, Statement, Targets, section_at};
use std::collections::{HashMap, HashSet};

/// Writes statements, each after those that it needs.
pub struct Writer<'a> {
    sections: &'a [(String, usize)],
    statements: &'a [Statement],
    pairings: &'a [Pairing],
    /// Of statements that are part of a pair, its index.
    pairing: HashMap<usize, usize>,
    assigned: HashMap<&'a str, usize>,
    state: Vec<State>,
    /// All names that are not of pairs.
    taken: HashSet<&'a str>,
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
    pub fn new(
        sections: &'a [(String, usize)],
        statements: &'a [Statement],
        pairings: &'a [Pairing],
        earlier: &'a Names,
    ) -> Self {
        let places = pairings.iter().enumerate();
        Self {
            sections,
            statements,
            pairings,
            pairing: places.flat_map(|(place, pairing)| pairing.statements.map(|index| (index, place))).collect(),
            assigned: assigned(statements),
            state: vec![State::Unwritten; statements.len()],
            taken: statements.iter().flat_map(names).collect(),
            stage: Stage { names: earlier.clone(), ..Stage::default() },
            section: String::new(),
        }
    }

    /// All statements; the index of a pair that needs its own result.
    pub fn write(mut self) -> Result<Stage, usize> {
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
            for name in self.statements[*index].reads() {
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
            // sines as they are, beside each other
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
        let name = self.stage.names.of_pair([a, b], &self.taken);
        let mut operands = operands.iter().map(|pair| self.stage.names.operand(pair)).collect::<Vec<_>>().into_iter();
        self.stage.statements.push(Statement {
            targets: Targets::Value(name.clone()),
            operation: first.operation,
            a: operands.next().unwrap_or(Operand::Number(f64::NAN)),
            b: operands.next().unwrap_or(Operand::Number(f64::NAN)),
        });
        self.stage.names.halves.insert(a.to_owned(), (name.clone(), Half::First));
        self.stage.names.halves.insert(b.to_owned(), (name, Half::Second));
    }

    /// The section of a statement; of two arms, of both.
    fn section_of(&self, both: &[usize]) -> String {
        let [a, b] =
            [both.first(), both.last()].map(|index| index.map_or("", |index| section_at(self.sections, *index)));
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
        let operands = statements.iter().flat_map(Statement::reads);
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
                    let [a, b] = [a.clone(), b.clone()];
                    let parts = [&a, &b].map(|part| part.name().unwrap_or_default());
                    let name = names.of_pair(parts, &self.taken);
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

/// What a statement assigns and what it reads.
fn names(statement: &Statement) -> impl Iterator<Item = &str> {
    statement.targets.names().into_iter().chain(statement.reads())
}
