//! Rank correlations by a Gaussian copula: normal scores of the keys' probabilities are mixed, and their probabilities
//! taken again. Every key keeps its distribution.

use super::normal;
use std::f64::consts::PI;

/// How the probabilities of a case are mixed.
///
/// # Example
/// ```
/// use planar_capture::campaign::Copula;
///
/// let copula = Copula::new(&[([0, 1], 0.5)]).expect("a correlation that two keys can have");
/// let mut numbers = [0.9, 0.5];
/// copula.mix(&mut numbers);
/// // the first key keeps 0.9, of which the normal score is 1.2816; that of the second becomes 2 sin(π/12) as much
/// assert_eq!(numbers[0], 0.9);
/// assert!((numbers[1] - 0.7464).abs() < 1e-4);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Copula {
    /// Indices of the keys that have a correlation, in order.
    keys: Vec<usize>,
    /// The Cholesky factor of the correlations of their normal scores, lower triangle by rows.
    factor: Vec<Vec<f64>>,
}

/// Rank correlations that no variables have together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotPositiveDefinite;

impl Copula {
    /// Of rank correlations of pairs of keys, each −1 to 1; pairs that are not given are uncorrelated.
    ///
    /// # Errors
    /// [`NotPositiveDefinite`].
    pub fn new(pairs: &[([usize; 2], f64)]) -> Result<Self, NotPositiveDefinite> {
        let mut keys: Vec<usize> = pairs.iter().flat_map(|(pair, _)| *pair).collect();
        keys.sort_unstable();
        keys.dedup();
        // Pearson (1907): the rank correlation of normal variables of correlation r is (6/π) asin(r/2)
        let of_scores = |rank: f64| 2.0 * libm::sin(PI / 6.0 * rank);
        let correlation = |a: usize, b: usize| {
            let found = pairs.iter().find(|(pair, _)| *pair == [a, b] || *pair == [b, a]);
            found.map_or(if a == b { 1.0 } else { 0.0 }, |(_, rank)| of_scores(*rank))
        };
        let mut factor: Vec<Vec<f64>> = Vec::new();
        for (i, a) in keys.iter().enumerate() {
            let mut row: Vec<f64> = Vec::new();
            for (j, b) in keys[..=i].iter().enumerate() {
                let before = if j < i { &factor[j] } else { &row };
                let sum: f64 = row.iter().zip(before).take(j).map(|(x, y)| x * y).sum();
                let rest = correlation(*a, *b) - sum;
                let entry = if j < i {
                    rest / factor[j][j]
                } else if rest > 1e-9 {
                    libm::sqrt(rest)
                } else {
                    return Err(NotPositiveDefinite);
                };
                row.push(entry);
            }
            factor.push(row);
        }
        Ok(Self { keys, factor })
    }

    /// The rank correlations of pairs of keys, those that are not zero, to ten digits.
    #[must_use]
    pub fn ranks(&self) -> Vec<([usize; 2], f64)> {
        let mut found = Vec::new();
        for (j, (second, row)) in self.keys.iter().zip(&self.factor).enumerate() {
            for (first, other) in self.keys.iter().zip(&self.factor).take(j) {
                let of_scores: f64 = row.iter().zip(other).map(|(x, y)| x * y).sum();
                let rank = 6.0 / PI * libm::asin(0.5 * of_scores);
                found.push(([*first, *second], (1e10 * rank).round() / 1e10));
            }
        }
        found.retain(|(_, rank)| *rank != 0.0);
        found
    }

    /// Mixes the probabilities of all keys of a case. The first key of a group keeps its own.
    pub fn mix(&self, numbers: &mut [f64]) {
        let scores: Vec<f64> = self.keys.iter().map(|key| normal::quantile(numbers[*key])).collect();
        for (key, row) in self.keys.iter().zip(&self.factor).skip(1) {
            let score: f64 = row.iter().zip(&scores).map(|(x, y)| x * y).sum();
            // a score of 9 has the probability 1, which no number has
            numbers[*key] = normal::cumulative(score).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON / 2.0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Copula, normal};
    use crate::campaign::uniform::UniformStream;

    fn ranks(numbers: &[f64]) -> Vec<f64> {
        let mut order: Vec<usize> = (0..numbers.len()).collect();
        order.sort_by(|a, b| numbers[*a].total_cmp(&numbers[*b]));
        let mut ranks = vec![0.0; numbers.len()];
        (0..).zip(order).for_each(|(rank, i): (u32, usize)| ranks[i] = f64::from(rank));
        ranks
    }

    #[test]
    fn ranks_are_those_given() {
        let given = [([0, 2], 0.5), ([2, 3], -0.7), ([1, 4], 0.25)];
        let mut found = Copula::new(&given).expect("possible").ranks();
        found.sort_by_key(|(pair, _)| *pair);
        assert_eq!(found, [([0, 2], 0.5), ([1, 4], 0.25), ([2, 3], -0.7)]);
    }

    #[test]
    fn ranks_are_correlated_as_wanted() {
        const COUNT: u32 = 20_000;
        let copula = Copula::new(&[([0, 2], 0.5), ([2, 3], -0.7)]).expect("possible");
        let streams = ["a", "b", "c", "d"].map(|key| UniformStream::new(1, "value", key));
        let mut columns = [const { Vec::new() }; 4];
        for case in 0..u64::from(COUNT) {
            let mut numbers = streams.each_ref().map(|stream| stream.number(case));
            copula.mix(&mut numbers);
            columns.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
        }
        let middle = f64::from(COUNT - 1) / 2.0;
        let ranks = columns.each_ref().map(|column| ranks(column));
        let product = |a: usize, b: usize| -> f64 {
            ranks[a].iter().zip(&ranks[b]).map(|(x, y)| (x - middle) * (y - middle)).sum()
        };
        for (a, b, wanted) in [(0, 2, 0.5), (2, 3, -0.7), (0, 1, 0.0), (0, 3, 0.0), (1, 2, 0.0)] {
            let found = product(a, b) / product(a, a);
            assert!((found - wanted).abs() < 4.0 / f64::from(COUNT).sqrt(), "{a}, {b}: {found}");
        }
    }

    /// Scores of the correlation 2 sin(π ρ / 6): at 0.6 that is the golden ratio less one.
    #[test]
    fn scores_have_the_correlation_of_these_ranks() {
        let copula = Copula::new(&[([0, 1], 0.6)]).expect("possible");
        let mut numbers = [0.9, 0.5];
        copula.mix(&mut numbers);
        let [first, second] = numbers.map(normal::quantile);
        let expected = 0.5 * (5.0_f64.sqrt() - 1.0);
        assert!((second / first - expected).abs() < 1e-9, "{}", second / first);
    }

    #[test]
    fn impossible_correlations_are_refused() {
        let impossible = [([0, 1], 0.9), ([1, 2], 0.9), ([0, 2], -0.9)];
        assert!(Copula::new(&impossible).is_err());
        assert!(Copula::new(&[([0, 1], 1.0)]).is_err(), "the same variable twice");
    }
}
