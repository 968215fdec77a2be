//! Edits of a text's tokens.

use crate::dictionary::{MARKS, NUMBERS, STRINGS};
use crate::input::LONGEST;
use crate::tokens::{group, tokens};

/// An edit; its numbers choose among what there is.
#[derive(Clone, Copy, Debug)]
pub struct Edit {
    kind: u8,
    at: u16,
    other: u16,
    count: u16,
}

impl From<(u8, u16, u16, u16)> for Edit {
    fn from((kind, at, other, count): (u8, u16, u16, u16)) -> Self {
        Self { kind, at, other, count }
    }
}

/// A seed after edits.
pub fn mutant(seeds: &[String], seed: usize, edits: &[Edit]) -> String {
    let mut text = tokens(&seeds[seed % seeds.len()]);
    for edit in edits {
        apply(&mut text, *edit, seeds);
    }
    let mut whole = String::with_capacity(LONGEST);
    for token in text {
        if whole.len() > LONGEST {
            break;
        }
        whole.push_str(token);
    }
    whole
}

fn apply<'a>(text: &mut Vec<&'a str>, edit: Edit, seeds: &'a [String]) {
    if text.is_empty() {
        return;
    }
    let (at, other, count) = (place(text, edit.at), place(text, edit.other), usize::from(edit.count));
    let chosen = |list: &'static [&'static str]| list[usize::from(edit.other) % list.len()];
    let numbers =
        || (at..text.len()).chain(0..at).find(|i| text[*i].starts_with(|c: char| c.is_ascii_digit() || c == '-'));
    let strings = || (at..text.len()).chain(0..at).find(|i| text[*i].len() > 1 && text[*i].starts_with(['"', '\'']));
    match edit.kind % 16 {
        0 => drop(text.drain(at..text.len().min(at + 1 + count % 4))),
        1 => text.insert(at, text[at]),
        2 => text.swap(at, other),
        3 => text[at] = chosen(&MARKS),
        4 => text.insert(at, chosen(&MARKS)),
        5 => text[at] = text[other],
        6 => drop(text.drain(group(text, at))),
        7 => {
            let copied = text[group(text, at)].to_vec();
            let times = 1 + if count.is_multiple_of(256) { count / 16 } else { count % 3 };
            let times = times.min(4 * LONGEST / copied.len().max(1));
            text.splice(at..at, copied.iter().copied().cycle().take(copied.len() * times));
        }
        8 | 9 => {
            if let Some(found) = numbers() {
                text[found] = chosen(&NUMBERS);
            }
        }
        10 => {
            if let Some(found) = strings() {
                text[found] = chosen(&STRINGS);
            }
        }
        11 => {
            let moved: Vec<&str> = text.drain(group(text, at)).collect();
            let to = other.min(text.len());
            text.splice(to..to, moved);
        }
        12 => text.truncate(at),
        13 => {
            let token = text[at];
            let times = if count.is_multiple_of(256) { count } else { count % 8 };
            text.splice(at..at, std::iter::repeat_n(token, times));
        }
        14 => {
            let from = tokens(&seeds[count % seeds.len()]);
            let there = place(&from, edit.other);
            let part = group(&from, there);
            text.splice(at..at, from[part].iter().copied());
        }
        _ => {
            // a part of a token
            let end = text[at].floor_char_boundary(1 + count % text[at].len().max(1));
            text[at] = &text[at][..end];
        }
    }
}

/// An index of a token.
fn place(text: &[&str], number: u16) -> usize {
    usize::from(number) * text.len() / (usize::from(u16::MAX) + 1)
}
