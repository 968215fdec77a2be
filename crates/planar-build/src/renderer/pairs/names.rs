//! The names of pairs, and how they and those of numbers are made of each other.

use crate::format::Operand;
use std::collections::{HashMap, HashSet};

/// Names of pairs and of their halves.
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
            if !fields.contains(&field) {
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

    /// The pair whose halves two operands are, in their order.
    pub fn pair_of(&self, operands: &[Operand; 2]) -> Option<&str> {
        let half = |operand: &Operand| operand.name().and_then(|name| self.halves.get(name));
        match operands.each_ref().map(half) {
            [Some((pair, Half::First)), Some((other, Half::Second))] if pair == other => Some(pair),
            _ => None,
        }
    }

    /// Two operands as one: the pair whose halves they are, or one that is made of them.
    pub fn operand(&mut self, operands: &[Operand; 2]) -> Operand {
        if let Some(pair) = self.pair_of(operands) {
            return Operand::Name(pair.to_owned());
        }
        let text = |operand: &Operand| match operand {
            Operand::Number(number) => format!("{number:?}"),
            Operand::Name(name) => name.clone(),
        };
        let key = operands.each_ref().map(text).join(" & ");
        self.joined.entry(key.clone()).or_insert_with(|| operands.clone());
        Operand::Name(key)
    }

    /// The name of a new pair, made of those of its halves; none of `taken`.
    pub fn of_pair(&mut self, [a, b]: [&str; 2], taken: &HashSet<&str>) -> String {
        let plain = |name: &str| name.replace("][", "_").replace('[', "_").replace(']', "");
        let (a, b) = (plain(a), plain(b));
        let mut name = if a == b { format!("{a}_both") } else { format!("{a}_{b}") };
        while self.pairs.contains(&name) || taken.contains(name.as_str()) {
            name.push_str("_pair");
        }
        self.pairs.insert(name.clone());
        name
    }
}
