//! What board and host have to agree on, to the last bit.

use crate::Real;
use crate::mission::Record;
use crate::route::{NAMES, Route};
use crate::states::{STATES, inputs};

/// The results of a mission and of all functions at all states.
#[derive(Clone, Debug, PartialEq)]
pub struct Vectors {
    /// Of the mission.
    pub record: Record,
    /// A checksum of the results of each function at all states.
    pub checksums: [u64; NAMES.len()],
    /// How many of the states each function has a result at.
    pub results: [u16; NAMES.len()],
}

/// Those of a route.
///
/// # Errors
/// What the route says of the mission.
pub fn vectors<R: Route>() -> Result<Vectors, &'static str> {
    let mut vectors = Vectors { record: [0.0; _], checksums: [OFFSET; _], results: [0; _] };
    R::capture(&mut vectors.record)?;
    for state in 0..STATES {
        let mut case = R::case(&inputs(state));
        for ((function, checksum), results) in R::FUNCTIONS.iter().zip(&mut vectors.checksums).zip(&mut vectors.results)
        {
            let done = (function.call)(&mut case);
            add(checksum, u64::from(done));
            if done {
                *results += 1;
                (function.results)(&case, &mut |numbers| numbers.iter().for_each(|x| add(checksum, bits(*x))));
            }
        }
    }
    Ok(vectors)
}

/// All bits of a number; what is not one has other bits on other processors.
#[must_use]
pub fn bits(number: Real) -> u64 {
    if number.is_nan() { u64::MAX } else { number.to_bits().into() }
}

const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// Fowler, Noll and Vo's checksum, a word at a time.
fn add(checksum: &mut u64, word: u64) {
    *checksum = (*checksum ^ word).wrapping_mul(0x0100_0000_01b3);
}
