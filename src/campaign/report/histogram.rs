//! How many cases have which values of an output.

/// Most bins.
const MOST: f64 = 60.0;

/// Numbers of values in bins of equal width.
///
/// # Example
/// ```
/// use planar_capture::campaign::report::Histogram;
///
/// // by the rule of Sturges log₂ 4 + 1 bins, as many as by that of Freedman and Diaconis
/// let histogram = Histogram::of(&[0.0, 1.0, 2.0, 3.0]).expect("values that are not all equal");
/// assert_eq!(histogram.edges, [0.0, 1.0, 2.0, 3.0]);
/// assert_eq!(histogram.counts, [1, 1, 2]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// The ends of the bins, one more than bins.
    pub edges: Vec<f64>,
    /// The values in each bin: those on a common end are in the upper bin.
    pub counts: Vec<usize>,
}

impl Histogram {
    /// Of finite values in order that are not all equal; `None` for others.
    ///
    /// As many bins as the rule of Freedman and Diaconis gives (widths of twice the interquartile range over the cube root
    /// of the number of values), or that of Sturges where these are more: the first has too few for small samples.
    #[must_use]
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "counts of values in memory, bins of which there are few"
    )]
    pub fn of(sorted: &[f64]) -> Option<Self> {
        let (low, high) = (*sorted.first()?, *sorted.last()?);
        let span = high - low;
        // which leaves out values that are not finite, too
        if !(span > 0.0 && span.is_finite()) {
            return None;
        }
        let count = sorted.len() as f64;
        let at = |part: f64| sorted[(part * (count - 1.0)).round() as usize];
        let sturges = libm::log2(count).ceil() + 1.0;
        // of no width where half of the values are equal, as those of an answer are: then the first rule alone
        let width = 2.0 * (at(0.75) - at(0.25)) / libm::cbrt(count);
        let diaconis = if width > 0.0 { (span / width).ceil() } else { 0.0 };
        let bins = sturges.max(diaconis).clamp(1.0, MOST) as usize;
        let mut counts = vec![0; bins];
        for value in sorted {
            let bin = ((value - low) / span * bins as f64) as usize;
            counts[bin.min(bins - 1)] += 1;
        }
        let edges = (0..=bins).map(|bin| low + span * (bin as f64 / bins as f64)).collect();
        Some(Self { edges, counts })
    }
}

#[cfg(test)]
mod tests {
    use super::Histogram;

    /// Squares of 0 to 99: Sturges gives 8 bins of 1225.125, Freedman and Diaconis 5.
    #[test]
    fn bins_are_of_equal_width_by_the_rule_with_more_of_them() {
        let values: Vec<f64> = (0..100).map(|i| f64::from(i * i)).collect();
        let found = Histogram::of(&values).expect("a histogram");
        assert_eq!(found.counts, [36, 14, 11, 10, 8, 7, 7, 7]);
        assert_eq!([found.edges[0], found.edges[8]].map(f64::to_bits), [0.0, 9801.0_f64].map(f64::to_bits));
    }

    #[test]
    fn every_value_is_in_one_bin() {
        let extreme = [vec![0.0; 999], vec![1e300]].concat();
        let near = [1.0, 1.0_f64.next_up()].to_vec();
        let long: Vec<f64> = (0..10_000).map(|i| libm::exp(f64::from(i) / 1000.0)).collect();
        for values in [extreme, near, long, vec![0.0, 1.0]] {
            let Histogram { edges, counts } = Histogram::of(&values).expect("a histogram");
            assert_eq!(counts.iter().sum::<usize>(), values.len());
            assert_eq!(edges.len(), counts.len() + 1);
            assert!(counts.len() <= 60 && counts[0] > 0 && counts[counts.len() - 1] > 0, "{counts:?}");
            let ends = [values[0], values[values.len() - 1]];
            assert_eq!([edges[0], edges[counts.len()]].map(f64::to_bits), ends.map(f64::to_bits));
        }
    }

    #[test]
    fn equal_values_and_infinite_ones_have_none() {
        for values in
            [vec![], vec![2.0], vec![2.0; 9], vec![0.0, f64::INFINITY], vec![0.0, f64::NAN], vec![-1e308, 1e308]]
        {
            assert_eq!(Histogram::of(&values), None, "{values:?}");
        }
    }
}
