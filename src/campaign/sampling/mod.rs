//! Which probability a case has of each key: u(seed, key, index), for every sampling.
//!
//! # Example
//! ```
//! use planar_capture::campaign::sampling::{KeySampling, Sampling};
//!
//! let keys = [("target.ball.mass", None), ("target.ball.inertia", None)];
//! for key in KeySampling::of_keys(Sampling::LatinHypercube, 1, 5, &keys) {
//!     // each fifth of the probability has one of five cases
//!     let mut fifths: Vec<f64> = (0..5).map(|case| (5.0 * key.number(case)).floor()).collect();
//!     fifths.sort_by(f64::total_cmp);
//!     assert_eq!(fifths, [0.0, 1.0, 2.0, 3.0, 4.0]);
//! }
//! ```

mod latin_hypercube;
mod sobol;

use crate::campaign::uniform::UniformStream;
use latin_hypercube::LatinHypercube;
use sobol::Sobol;

pub use sobol::MOST_DIMENSIONS;

/// How cases are spread over the keys' distributions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Independently.
    Random,
    /// Each of as many intervals of equal probability as there are cases has one case.
    LatinHypercube,
    /// By Sobol's sequence.
    Sobol,
    /// All combinations of choices, those of the last key fastest.
    Grid,
}

impl Sampling {
    /// All of them with their names in sweeps.
    pub const ALL: [(&'static str, Self); 4] = [
        ("random", Self::Random),
        ("latin_hypercube", Self::LatinHypercube),
        ("sobol", Self::Sobol),
        ("grid", Self::Grid),
    ];

    /// As in a sweep.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL.iter().find(|(_, sampling)| *sampling == self).map_or("", |(name, _)| name)
    }

    /// As in a sentence.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Random => "random sample",
            Self::LatinHypercube => "Latin hypercube",
            Self::Sobol => "Sobol sequence",
            Self::Grid => "grid",
        }
    }

    /// Whether more cases leave those before as they are.
    #[must_use]
    pub fn can_grow(self) -> bool {
        matches!(self, Self::Random | Self::Sobol)
    }

    /// Whether keys can be correlated: the others have a structure that correlations would destroy.
    #[must_use]
    pub fn can_correlate(self) -> bool {
        matches!(self, Self::Random | Self::LatinHypercube)
    }
}

/// The probabilities of one key.
#[derive(Clone, Debug)]
pub enum KeySampling {
    /// Of [`Sampling::Random`].
    Random(UniformStream),
    /// Of [`Sampling::LatinHypercube`].
    LatinHypercube(LatinHypercube),
    /// Of [`Sampling::Sobol`].
    Sobol(Box<Sobol>),
    /// Of [`Sampling::Grid`]: how many neighbouring cases have the same choice, and the number of choices.
    Grid([u64; 2]),
}

impl KeySampling {
    /// The probability of a case, between 0 and 1.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "a sweep has no 2⁵² cases")]
    pub fn number(&self, case: u64) -> f64 {
        match self {
            Self::Random(stream) => stream.number(case),
            Self::LatinHypercube(intervals) => intervals.number(case),
            Self::Sobol(sequence) => sequence.number(case),
            Self::Grid([repeats, choices]) => ((case / repeats % choices) as f64 + 0.5) / *choices as f64,
        }
    }

    /// Of all keys, given with the numbers of their choices, in a sweep of `cases` cases.
    #[must_use]
    pub fn of_keys(sampling: Sampling, seed: u64, cases: u64, keys: &[(&str, Option<usize>)]) -> Vec<Self> {
        let choices = |(_, count): &(&str, Option<usize>)| count.unwrap_or(1) as u64;
        let of_key = |(i, (key, _)): (usize, &(&str, Option<usize>))| match sampling {
            Sampling::Random => Self::Random(UniformStream::new(seed, "value", key)),
            Sampling::LatinHypercube => Self::LatinHypercube(LatinHypercube::new(seed, key, cases)),
            Sampling::Sobol => Self::Sobol(Box::new(Sobol::new(seed, key, i))),
            Sampling::Grid => Self::Grid([keys[i + 1..].iter().map(choices).product(), choices(&keys[i])]),
        };
        keys.iter().enumerate().map(of_key).collect()
    }
}
