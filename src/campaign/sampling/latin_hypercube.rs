//! Latin hypercube sampling: of n intervals of equal probability each has one case, for every key.
//!
//! Which case that is says a keyed permutation of 0 … n − 1: a Feistel network over the next power of four, walked along
//! its cycle until it is back among the first n. Any case is known alone.

use crate::campaign::uniform::UniformStream;

const ROUNDS: usize = 8;

/// The intervals of one key.
#[derive(Clone, Debug)]
pub struct LatinHypercube {
    round_keys: [u64; ROUNDS],
    /// Within the interval.
    place: UniformStream,
    count: u64,
    /// Of half an index.
    bits: u32,
}

impl LatinHypercube {
    /// Of `count` cases, at least one.
    #[must_use]
    pub fn new(seed: u64, key: &str, count: u64) -> Self {
        let keys = UniformStream::new(seed, "permutation", key);
        let mut round_keys = [0; ROUNDS];
        for (i, round_key) in (0..).zip(&mut round_keys) {
            *round_key = keys.bits(i);
        }
        let bits = (u64::BITS - (count - 1).leading_zeros()).div_ceil(2).max(1);
        Self { round_keys, place: UniformStream::new(seed, "value", key), count, bits }
    }

    /// A probability of a case, between 0 and 1.
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "a sweep has no 2⁵² cases")]
    pub fn number(&self, case: u64) -> f64 {
        (self.interval(case) as f64 + self.place.number(case)) / self.count as f64
    }

    /// The interval of a case, less than the count.
    #[must_use]
    pub fn interval(&self, case: u64) -> u64 {
        let mut interval = self.permuted(case);
        while interval >= self.count {
            interval = self.permuted(interval);
        }
        interval
    }

    /// A permutation of all numbers of twice the bits.
    fn permuted(&self, index: u64) -> u64 {
        let mask = (1 << self.bits) - 1;
        let [mut left, mut right] = [index >> self.bits, index & mask];
        for key in self.round_keys {
            (left, right) = (right, left ^ (mixed(right ^ key) & mask));
        }
        left << self.bits | right
    }
}

/// The finaliser of `SplitMix64` (Steele, Lea and Flood 2014): every bit depends on every one.
fn mixed(bits: u64) -> u64 {
    let bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

#[cfg(test)]
mod tests {
    use super::LatinHypercube;

    #[test]
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small and not negative")]
    fn each_interval_has_one_case() {
        for count in [1, 2, 3, 16, 17, 1000, 4096] {
            let sampling = LatinHypercube::new(3, "a", count);
            let mut intervals: Vec<u64> = (0..count).map(|case| sampling.interval(case)).collect();
            let of_numbers = (0..count).map(|case| (sampling.number(case) * f64::from(count as u32)) as u64);
            assert!(of_numbers.eq(intervals.iter().copied()));
            intervals.sort_unstable();
            assert!(intervals.into_iter().eq(0..count), "{count}");
        }
    }

    /// Neighbouring cases, and the same cases of two keys, are uncorrelated to 5/√n.
    #[test]
    fn intervals_are_independent() {
        const COUNT: u32 = 4000;
        let [a, b] = ["a", "b"].map(|key| LatinHypercube::new(3, key, COUNT.into()));
        let numbers = |sampling: &LatinHypercube, from: u64| -> Vec<f64> {
            (0..u64::from(COUNT)).map(|case| sampling.number((case + from) % u64::from(COUNT))).collect()
        };
        for (x, y) in [(numbers(&a, 0), numbers(&b, 0)), (numbers(&a, 0), numbers(&a, 1))] {
            let products: f64 = x.iter().zip(&y).map(|(x, y)| (x - 0.5) * (y - 0.5)).sum();
            let correlation = 12.0 * products / f64::from(COUNT);
            assert!(correlation.abs() < 5.0 / f64::from(COUNT).sqrt(), "{correlation}");
        }
    }
}
