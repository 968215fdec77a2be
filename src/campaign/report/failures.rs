//! Failures of a sweep by kinds: messages that are alike but for numbers, which are given as ranges.

use std::cmp::Reverse;
use std::collections::HashMap;

/// Failures whose messages are alike but for numbers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FailureKind {
    /// How many there are.
    pub count: usize,
    /// The first case.
    pub case: u64,
    /// Its status.
    pub status: String,
    /// Its message; numbers that others of the kind have other values of are ranges: "-3.0 to -1.0".
    pub message: String,
}

/// A word of a message, or a number in it with what is around: its least and largest value as they are written.
enum Word {
    Text(String),
    Number { before: String, least: (f64, String), largest: (f64, String), after: String },
}

impl Word {
    fn new(word: &str) -> Self {
        let is_own = |c: char| c.is_ascii_digit() || c == '-' || c == '+';
        let number = || {
            let (from, to) = (word.find(is_own)?, word.rfind(|c: char| c.is_ascii_digit())? + 1);
            let (before, text, after) = (word.get(..from)?, word.get(from..to)?, word.get(to..)?);
            // the index in a key, the number in a name
            let is_alone = !before.contains(char::is_alphanumeric) && !after.contains(char::is_alphanumeric);
            let value = (text.parse().ok().filter(|_| is_alone)?, text.to_owned());
            Some(Self::Number {
                before: before.to_owned(),
                least: value.clone(),
                largest: value,
                after: after.to_owned(),
            })
        };
        number().unwrap_or_else(|| Self::Text(word.to_owned()))
    }

    /// Takes the value of another message at the same place.
    fn widen(&mut self, other: Self) {
        let (Self::Number { least, largest, .. }, Self::Number { least: value, .. }) = (self, other) else { return };
        if value.0 < least.0 {
            *least = value;
        } else if value.0 > largest.0 {
            *largest = value;
        }
    }

    fn shown(&self) -> String {
        match self {
            Self::Text(text) => text.clone(),
            Self::Number { before, least, largest, after } if least.1 == largest.1 => {
                format!("{before}{}{after}", least.1)
            }
            Self::Number { before, least, largest, after } => format!("{before}{} to {}{after}", least.1, largest.1),
        }
    }
}

fn words(message: &str) -> Vec<Word> {
    message.split_whitespace().map(Word::new).collect()
}

/// Which of several numbers are negative: an angle and the limit that it is beyond have a sign together, which is lost in
/// ranges of both.
fn signs(words: &[Word]) -> Vec<bool> {
    let number = |word: &Word| match word {
        Word::Number { least: (value, _), .. } => Some(*value < 0.0),
        Word::Text(_) => None,
    };
    let signs: Vec<_> = words.iter().filter_map(number).collect();
    if signs.len() > 1 { signs } else { Vec::new() }
}

/// Failures by their messages without numbers, the most frequent kind first.
pub(super) fn kinds_of(failures: impl Iterator<Item = FailureKind>) -> Vec<FailureKind> {
    let mut places = HashMap::new();
    let mut kinds: Vec<(FailureKind, Vec<Word>)> = Vec::new();
    for failure in failures {
        let without: Vec<_> =
            failure.message.split_whitespace().filter(|word| !word.contains(|c: char| c.is_ascii_digit())).collect();
        let own = words(&failure.message);
        let kind = (failure.status.clone(), without.join(" "), signs(&own));
        let place = *places.entry(kind).or_insert(kinds.len());
        match kinds.get_mut(place) {
            Some((kind, all)) => {
                kind.count += 1;
                all.iter_mut().zip(own).for_each(|(word, own)| word.widen(own));
            }
            None => kinds.push((failure, own)),
        }
    }
    // stable: equally frequent kinds stay in their order
    kinds.sort_by_key(|(kind, _)| Reverse(kind.count));
    let message = |words: Vec<Word>| words.iter().map(Word::shown).collect::<Vec<_>>().join(" ");
    kinds.into_iter().map(|(kind, words)| FailureKind { message: message(words), ..kind }).collect()
}

#[cfg(test)]
mod tests;
