//! Statistics of samples: percentiles with confidence bounds, rank correlation, first-order sensitivity.

/// An estimated percentile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Percentile {
    /// The order statistic nearest to it.
    pub value: f64,
    /// Order statistics between which it is with a probability of at least 95 %; `None` for a bound that so few values
    /// do not give.
    pub bounds: [Option<f64>; 2],
}

/// The ranks of order statistics for a percentile of samples of one size, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PercentileRanks {
    nearest: usize,
    bounds: [Option<usize>; 2],
}

impl PercentileRanks {
    /// For the value with this part of the distribution below it, 0 < `part` < 1, of at least one value.
    ///
    /// The number of values below the percentile is binomial, whatever the distribution; each bound fails with a
    /// probability of at most 2.5 %.
    #[must_use]
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts of values in memory"
    )]
    pub fn new(count: usize, part: f64) -> Self {
        const MISSED: f64 = 0.025;
        let n = count as f64;
        let nearest = ((part * n).ceil() as usize).clamp(1, count) - 1;
        let constant = libm::lgamma(n + 1.0);
        let [below, above] = [libm::log(part), libm::log1p(-part)];
        let probability = |k: f64| {
            libm::exp(constant - libm::lgamma(k + 1.0) - libm::lgamma(n - k + 1.0) + k * below + (n - k) * above)
        };
        // the value of rank r, from 0, is above the percentile where at most r values are below it
        let (mut cumulative, mut bounds) = (0.0, [None; 2]);
        for rank in 0..count {
            cumulative += probability(rank as f64);
            if cumulative <= MISSED {
                bounds[0] = Some(rank);
            }
            if cumulative >= 1.0 - MISSED {
                bounds[1] = Some(rank);
                break;
            }
        }
        Self { nearest, bounds }
    }

    /// Of sorted values, as many as there are for.
    #[must_use]
    pub fn of(&self, sorted: &[f64]) -> Percentile {
        Percentile { value: sorted[self.nearest], bounds: self.bounds.map(|rank| rank.map(|rank| sorted[rank])) }
    }
}

/// Ranks from 0, equal values having their mean rank.
#[must_use]
#[allow(clippy::cast_precision_loss, reason = "counts of values in memory")]
pub fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0.0; values.len()];
    let mut from = 0;
    while from < order.len() {
        let equal = order[from..].iter().take_while(|i| values[**i].total_cmp(&values[order[from]]).is_eq()).count();
        for i in &order[from..from + equal] {
            ranks[*i] = from as f64 + (equal - 1) as f64 / 2.0;
        }
        from += equal;
    }
    ranks
}

/// The correlation of two lists of the same length; `None` where one of them does not vary.
#[must_use]
pub fn correlation(x: &[f64], y: &[f64]) -> Option<f64> {
    let (mean_x, mean_y) = (mean(x), mean(y));
    let (mut xy, mut xx, mut yy) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (x, y) = (x - mean_x, y - mean_y);
        xy += x * y;
        xx += x * x;
        yy += y * y;
    }
    (xx > 0.0 && yy > 0.0).then(|| xy / libm::sqrt(xx * yy))
}

/// First-order sensitivity from given data: the part of y's variance that the mean of y in classes of x explains, less
/// what classes without a meaning would (ω² of an analysis of variance).
///
/// x is given by ranks: classes have about as many values each, or are the values of x where these are few. `None` where
/// there are too few values, or y does not vary.
#[must_use]
#[allow(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "counts of values in memory"
)]
pub fn first_order(ranks: &[f64], y: &[f64]) -> Option<f64> {
    const FEWEST: usize = 50;
    let count = ranks.len();
    if count < FEWEST {
        return None;
    }
    let classes = (libm::cbrt(count as f64) as usize).clamp(4, 50);
    let mut sums: std::collections::BTreeMap<usize, (f64, f64)> = std::collections::BTreeMap::new();
    for (rank, y) in ranks.iter().zip(y) {
        let class = (rank / count as f64 * classes as f64) as usize;
        let (number, sum) = sums.entry(class).or_default();
        *number += 1.0;
        *sum += y;
    }
    let mean = mean(y);
    let total: f64 = y.iter().map(|y| (y - mean) * (y - mean)).sum();
    let between: f64 = sums.values().map(|(number, sum)| number * (sum / number - mean) * (sum / number - mean)).sum();
    let (groups, n) = (sums.len() as f64, count as f64);
    let within = (total - between) / (n - groups);
    (total > 0.0 && groups > 1.0).then(|| ((between - (groups - 1.0) * within) / (total + within)).clamp(0.0, 1.0))
}

#[allow(clippy::cast_precision_loss, reason = "counts of values in memory")]
fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::{PercentileRanks, correlation, first_order, ranks};
    use crate::campaign::uniform::UniformStream;

    /// `scipy.stats.quantile_test(range(1, n + 1), p=p).confidence_interval(0.95)`, its bounds from 1.
    #[test]
    fn bounds_of_percentiles_are_those_of_scipy() {
        for (count, part, expected) in [
            (10_u32, 0.5, [Some(2.0), Some(9.0)]),
            (100_u32, 0.05, [Some(1.0), Some(11.0)]),
            (1000_u32, 0.5, [Some(469.0), Some(532.0)]),
            (1000_u32, 0.95, [Some(936.0), Some(964.0)]),
            (20_u32, 0.05, [None, Some(4.0)]),
        ] {
            let values: Vec<f64> = (1..=count).map(f64::from).collect();
            let found = PercentileRanks::new(values.len(), part).of(&values);
            assert_eq!(found.bounds, expected, "{count}, {part}");
        }
    }

    /// A percentile is the least of the values that at least this part of them does not exceed.
    #[test]
    fn a_percentile_has_its_part_of_the_values_up_to_it() {
        for count in [1_u32, 2, 3, 10, 19, 20, 21, 99, 100, 101] {
            let values: Vec<f64> = (1..=count).map(f64::from).collect();
            for hundredths in [5_u32, 25, 50, 75, 95] {
                let found = PercentileRanks::new(values.len(), f64::from(hundredths) / 100.0).of(&values).value;
                // as whole numbers
                let up_to = |value: f64| 100 * values.iter().filter(|other| **other <= value).count();
                let wanted = (hundredths * count) as usize;
                assert!(up_to(found) >= wanted && up_to(found - 1.0) < wanted, "{hundredths} % of {count}: {found}");
            }
        }
    }

    #[test]
    fn equal_values_have_their_mean_rank() {
        assert_eq!(ranks(&[3.0, 1.0, 3.0, 2.0]), [2.5, 0.0, 2.5, 1.0]);
        assert_eq!(correlation(&[1.0, 1.0], &[1.0, 2.0]), None);
        assert_eq!(correlation(&[1.0, 2.0, 3.0], &[3.0, 2.0, 1.0]), Some(-1.0));
    }

    /// Ishigami's function, a = 7, b = 0.1: 0.314, 0.442, 0.
    #[test]
    fn first_order_indices_are_those_of_a_known_function() {
        let streams = ["a", "b", "c"].map(|key| UniformStream::new(1, "value", key));
        let columns = streams.map(|stream| -> Vec<f64> {
            (0..20_000).map(|case| std::f64::consts::PI * (2.0 * stream.number(case) - 1.0)).collect()
        });
        let value = |i: usize| {
            let [a, b, c] = columns.each_ref().map(|column| column[i]);
            a.sin() + 7.0 * b.sin().powi(2) + 0.1 * c.powi(4) * a.sin()
        };
        let y: Vec<f64> = (0..20_000).map(value).collect();
        for (column, expected) in columns.iter().zip([0.314, 0.442, 0.0]) {
            let found = first_order(&ranks(column), &y).expect("varies");
            assert!((found - expected).abs() < 0.03, "{found}, {expected}");
        }
    }

    /// Four classes of 25 with the means 0, 1, 2, 3, and ±1 twelve times each beside them: 125 between classes and 96 within,
    /// 1 for each of 96 degrees of freedom. ω² is (125 − 3 · 1) / (221 + 1).
    #[test]
    fn a_hundred_values_have_the_index_of_the_formula() {
        let order: Vec<f64> = (0..100_u32).map(f64::from).collect();
        let beside = |i: u32| [1.0, -1.0][(i % 2) as usize];
        let value = |i: u32| f64::from(i / 25) + if i % 25 == 24 { 0.0 } else { beside(i % 25) };
        let y: Vec<f64> = (0..100).map(value).collect();
        let found = first_order(&ranks(&order), &y).expect("varies");
        assert!((found - 122.0 / 222.0).abs() < 1e-12, "{found}");
    }

    /// Fewer than 50 values have no index; sixty have four classes all the same: of 15 values each with the means 0, 1, 2, 3, and
    /// ±1 seven times each beside them.
    #[test]
    fn few_values_have_no_index_or_four_classes() {
        let index = |count: u32| {
            let order: Vec<f64> = (0..count).map(f64::from).collect();
            let beside = |i: u32| if i == 14 { 0.0 } else { [1.0, -1.0][(i % 2) as usize] };
            let y: Vec<f64> = (0..count).map(|i| f64::from(i / 15) + beside(i % 15)).collect();
            first_order(&order, &y)
        };
        assert!(index(49).is_none() && index(50).is_some());
        assert!((index(60).expect("varies") - 72.0 / 132.0).abs() < 1e-12, "{:?}", index(60));
    }
}
