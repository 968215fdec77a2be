//! Arms of equal structure, two by two: which name of the one is which of the other.
//!
//! It is where pairs of statements are looked for; what is computed does not depend on it.

use crate::format::{Graph, Operand, Operation, Parameter, Statement};
use std::collections::{BTreeSet, HashMap, HashSet};

/// Names, and those of the other arm.
#[derive(Clone, Debug, Default)]
pub struct Symmetry {
    counterparts: HashMap<String, Counterpart>,
    /// Of every joint and of every arm the index of the other one.
    joints: Vec<usize>,
    arms: Vec<usize>,
}

#[derive(Clone, Debug)]
struct Counterpart {
    name: String,
    /// Whether the name is of the earlier arm.
    is_first: bool,
}

/// A statement's operation and operands, by which it is found.
type Key = (Operation, Name, Name);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Name {
    Number(u64),
    Name(String),
}

impl Graph {
    /// Whether arms are of equal structure, two by two, which modules can compute in pairs: as many links, with the same
    /// exact zeros.
    #[must_use]
    pub fn has_equal_arms(&self) -> bool {
        !Symmetry::of(self).counterparts.is_empty()
    }
}

impl Symmetry {
    /// Of inputs, parameters and constants. Arms of as many links with the same exact zeros are of equal structure.
    pub fn of(graph: &Graph) -> Self {
        let links: Vec<usize> = graph.layout.arms.iter().map(|arm| arm.links).collect();
        // the numbers that the graph has of an arm: the others are exact zeros
        let structure = |arm: usize| {
            let of_arm = graph.parameters.iter().filter(move |parameter| parameter.arm == Some(arm));
            let numbers: BTreeSet<_> = of_arm.map(|parameter| (&parameter.quantity, parameter.link)).collect();
            (links[arm], numbers)
        };
        let mut arms: Vec<usize> = (0..links.len()).collect();
        for first in 0..links.len() {
            let is_other = |second: &usize| arms[*second] == *second && structure(*second) == structure(first);
            let second = (first + 1..links.len()).find(is_other);
            if let (Some(second), true) = (second, arms[first] == first) {
                arms.swap(first, second);
            }
        }
        let start = |arm: usize| links.iter().take(arm).sum::<usize>();
        let joints =
            arms.iter().zip(&links).flat_map(|(other, links)| (0..*links).map(move |link| start(*other) + link));
        let joints = joints.collect();
        let mut symmetry = Self { counterparts: HashMap::new(), joints, arms };
        for input in graph.inputs.iter().filter(|input| !input.name.starts_with("base_")) {
            for (index, other) in symmetry.elements(&input.shape).into_iter().enumerate() {
                symmetry.insert(&input.element(index), &input.element(other), index < other);
            }
        }
        for parameter in &graph.parameters {
            let Some(other) = parameter.arm.and_then(|arm| symmetry.arms.get(arm)).copied() else { continue };
            let is_other =
                |p: &&Parameter| p.quantity == parameter.quantity && p.link == parameter.link && p.arm == Some(other);
            if let Some(found) = graph.parameters.iter().find(is_other) {
                symmetry.insert(&parameter.name, &found.name, parameter.arm < found.arm);
            }
        }
        // those of the arm that the base is reduced to are computed in a way of their own: by name
        let names: HashSet<&str> = graph.constants.values.iter().map(|constant| constant.name.as_str()).collect();
        for name in &names {
            let of_arm = name.strip_prefix("arm").and_then(|rest| rest.split_once('_'));
            let Some((arm, what)) = of_arm.and_then(|(number, what)| Some((number.parse::<usize>().ok()?, what)))
            else {
                continue;
            };
            let other = arm.checked_sub(1).and_then(|arm| symmetry.arms.get(arm)).map_or(arm, |other| other + 1);
            let counterpart = format!("arm{other}_{what}");
            if names.contains(counterpart.as_str()) {
                symmetry.insert(name, &counterpart, arm < other);
            }
        }
        symmetry
    }

    /// Names with that of the other arm after each.
    pub fn side_by_side<'a>(&self, names: &[&'a str]) -> Vec<&'a str> {
        let mut placed = HashSet::new();
        let with_other = names.iter().flat_map(|name| {
            let other = names.iter().find(|other| self.counterpart(name) == Some(**other));
            [Some(name), other].into_iter().flatten()
        });
        with_other.filter(|name| placed.insert(**name)).copied().collect()
    }

    fn insert(&mut self, name: &str, other: &str, is_first: bool) {
        if name != other {
            self.counterparts.insert(name.to_owned(), Counterpart { name: other.to_owned(), is_first });
        }
    }

    /// The other arm's name.
    pub fn counterpart(&self, name: &str) -> Option<&str> {
        self.counterparts.get(name).map(|counterpart| counterpart.name.as_str())
    }

    /// Whether a name is of the earlier of two arms.
    pub fn is_first(&self, name: &str) -> Option<bool> {
        self.counterparts.get(name).map(|counterpart| counterpart.is_first)
    }

    /// Of every element of an array, row-major, the one of the other arms.
    pub fn elements(&self, shape: &[usize]) -> Vec<usize> {
        let axis = |place: usize, length: usize| -> Vec<usize> {
            if length == self.joints.len() {
                self.joints.clone()
            } else if length == self.joints.len() + 3 {
                (0..3).chain(self.joints.iter().map(|joint| joint + 3)).collect()
            } else if place == 0 && length == self.arms.len() {
                self.arms.clone()
            } else {
                (0..length).collect()
            }
        };
        shape.iter().enumerate().fold(vec![0], |found, (place, length)| {
            let axis = axis(place, *length);
            found.iter().flat_map(|row| axis.iter().map(move |index| row * length + index)).collect()
        })
    }

    /// Two by two the statements of which one computes for one arm what the other does for another, the earlier arm's
    /// first. What they assign has counterparts then.
    pub fn extend(&mut self, statements: &[Statement]) -> Vec<[usize; 2]> {
        if self.counterparts.is_empty() {
            return Vec::new();
        }
        let all: HashMap<Key, usize> = (statements.iter().enumerate())
            .map(|(index, statement)| (key(statement.operation, name(&statement.a), name(&statement.b)), index))
            .collect();
        let (mut found, mut is_found) = (Vec::new(), vec![false; statements.len()]);
        for (index, statement) in statements.iter().enumerate() {
            let other = |operand: &Operand| match operand.name().and_then(|name| self.counterpart(name)) {
                Some(name) => Name::Name(name.to_owned()),
                None => name(operand),
            };
            let Some(&partner) = all.get(&key(statement.operation, other(&statement.a), other(&statement.b))) else {
                continue;
            };
            if partner == index || is_found[index] || is_found[partner] {
                continue;
            }
            (is_found[index], is_found[partner]) = (true, true);
            let pair = self.ordered(statements, [index, partner]);
            self.join(statements, pair);
            found.push(pair);
        }
        found
    }

    /// Two statements in the order of their arms.
    pub fn ordered(&self, statements: &[Statement], [index, partner]: [usize; 2]) -> [usize; 2] {
        let is_first = statements[index].reads().find_map(|name| self.is_first(name));
        if is_first.unwrap_or(index < partner) { [index, partner] } else { [partner, index] }
    }

    /// Makes what two statements assign counterparts.
    pub fn join(&mut self, statements: &[Statement], [first, second]: [usize; 2]) {
        for (a, b) in statements[first].targets.names().into_iter().zip(statements[second].targets.names()) {
            self.insert(a, b, true);
            self.insert(b, a, false);
        }
    }
}

/// The operands of sums and products in one order.
fn key(operation: Operation, a: Name, b: Name) -> Key {
    if operation.is_commutative() && b < a { (operation, b, a) } else { (operation, a, b) }
}

fn name(operand: &Operand) -> Name {
    match operand {
        Operand::Number(number) => Name::Number(number.to_bits()),
        Operand::Name(name) => Name::Name(name.clone()),
    }
}

#[cfg(test)]
mod tests;
