//! Uniform numbers by their place: u(seed, stream, index), whatever was drawn before.
//!
//! A stream is the `ChaCha8` key stream of the SHA-256 of seed and name; two of its 32-bit words are one number. Neither
//! the order of draws nor other streams have a part in it.

use hmac_sha256::Hash;
use rand::Rng;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

/// The numbers of one seed and name.
#[derive(Clone, Debug)]
pub struct UniformStream([u8; 32]);

impl UniformStream {
    /// `purpose` tells streams of the same name apart.
    #[must_use]
    pub fn new(seed: u64, purpose: &str, name: &str) -> Self {
        let mut hash = Hash::new();
        hash.update(seed.to_le_bytes());
        hash.update((purpose.len() as u64).to_le_bytes());
        hash.update(purpose);
        hash.update(name);
        Self(hash.finalize())
    }

    /// 64 random bits.
    #[must_use]
    pub fn bits(&self, index: u64) -> u64 {
        let mut generator = ChaCha8Rng::from_seed(self.0);
        generator.set_word_pos(2 * u128::from(index));
        generator.next_u64()
    }

    /// A number between 0 and 1, neither of which it is.
    #[must_use]
    pub fn number(&self, index: u64) -> f64 {
        unit(self.bits(index) >> (64 - UNIT_BITS))
    }
}

/// The digits of uniform numbers: the middle of each of 2⁵² intervals has 53.
pub(super) const UNIT_BITS: u32 = 52;

/// The middle of one of 2⁵² intervals between 0 and 1.
#[allow(clippy::cast_precision_loss, reason = "52 bits")]
pub(super) fn unit(interval: u64) -> f64 {
    const INTERVALS: f64 = (1_u64 << UNIT_BITS) as f64;
    (interval as f64 + 0.5) / INTERVALS
}

#[cfg(test)]
mod tests {
    use super::UniformStream;

    /// The SHA-256 and the `ChaCha8` key stream of two other implementations (Python's hashlib, and `ChaCha` written after
    /// RFC 8439 with 8 rounds and a 64-bit counter).
    #[test]
    fn numbers_are_known_and_do_not_depend_on_order() {
        let stream = UniformStream::new(7, "value", "layout.base.mass");
        let forwards: Vec<u64> = (0..40).map(|i| stream.bits(i)).collect();
        let backwards: Vec<u64> = (0..40).rev().map(|i| stream.bits(i)).collect();
        assert!(forwards.iter().eq(backwards.iter().rev()));
        assert_eq!(
            [0, 1, 9, 1_000_000].map(|i| stream.bits(i)),
            [
                2_011_564_481_940_788_915,
                10_311_172_314_748_932_622,
                17_402_253_808_401_222_668,
                9_571_335_539_471_934_952
            ]
        );
        assert_ne!(UniformStream::new(8, "value", "layout.base.mass").bits(0), forwards[0]);
        assert_ne!(UniformStream::new(7, "jitter", "layout.base.mass").bits(0), forwards[0]);
        assert_ne!(UniformStream::new(7, "value", "layout.base.inertia").bits(0), forwards[0]);
    }

    /// Kolmogorov–Smirnov at 1e-4: 2.23/√n.
    #[test]
    fn numbers_are_uniform() {
        const COUNT: u32 = 10_000;
        let stream = UniformStream::new(1, "value", "a");
        let mut numbers: Vec<f64> = (0..COUNT).map(|i| stream.number(i.into())).collect();
        numbers.sort_by(f64::total_cmp);
        assert!(numbers[0] > 0.0 && numbers[numbers.len() - 1] < 1.0);
        let places = (0..COUNT).map(|i| (f64::from(i) + 0.5) / f64::from(COUNT));
        let distance = numbers.iter().zip(places).map(|(u, place)| (u - place).abs()).fold(0.0, f64::max);
        assert!(distance < 2.23 / f64::from(COUNT).sqrt(), "{distance}");
    }
}
