//! The inputs of a target: mutants of its seeds, and bytes.

use crate::mutation::{Edit, mutant};
use crate::targets::Target;
use proptest::collection::vec;
use proptest::prelude::*;

/// Longest input, bytes.
pub const LONGEST: usize = 1 << 16;

/// How an input is made.
#[derive(Clone, Debug)]
pub enum Input {
    /// A seed, with edits.
    Mutant { seed: u16, edits: Vec<Edit> },
    /// As it is.
    Bytes(Vec<u8>),
}

/// Mutants, and some bytes.
pub fn strategy() -> impl Strategy<Value = Input> {
    let edits = vec(any::<(u8, u16, u16, u16)>().prop_map(Edit::from), 0..6);
    prop_oneof![
        15 => (any::<u16>(), edits).prop_map(|(seed, edits)| Input::Mutant { seed, edits }),
        1 => vec(any::<u8>(), 0..64).prop_map(Input::Bytes),
    ]
}

impl Input {
    /// The bytes that a target reads.
    pub fn bytes(&self, target: &Target) -> Vec<u8> {
        match self {
            Self::Bytes(bytes) => bytes.clone(),
            Self::Mutant { seed, edits } => {
                let mut text = mutant(&target.seeds, usize::from(*seed), edits);
                text.truncate(text.floor_char_boundary(LONGEST));
                text.into_bytes()
            }
        }
    }
}
