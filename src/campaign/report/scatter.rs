//! An output over the key that it depends on most.

/// Most points: more of them hide each other.
const MOST: usize = 500;

/// Values of a key and of an output.
#[derive(Clone, Debug, PartialEq)]
pub struct Scatter {
    /// Which one of the report's keys.
    pub key: usize,
    /// Every so many of the cases has a point.
    pub stride: usize,
    /// (key, output), in the order of the cases.
    pub points: Vec<(f64, f64)>,
}

impl Scatter {
    /// Of the key with the strongest effect, the first one of several; `None` without one, or with values that are not
    /// finite. `values_of` has a key's values of the same cases.
    #[must_use]
    pub fn of(effects: &[Option<f64>], values_of: impl FnOnce(usize) -> Vec<f64>, output: &[f64]) -> Option<Self> {
        let (key, _) = strongest_first(effects).into_iter().next()?;
        let stride = output.len().div_ceil(MOST).max(1);
        let points: Vec<_> = values_of(key).into_iter().zip(output.iter().copied()).step_by(stride).collect();
        points.iter().all(|(x, y)| x.is_finite() && y.is_finite()).then_some(Self { key, stride, points })
    }
}

/// How strong the effect of each key is: its rank correlation or, where that is greater, the root of its first-order index,
/// which also sees an output that is least in the middle of the key's range.
#[must_use]
pub fn effects(correlations: &[Option<f64>], first_order: &[Option<f64>]) -> Vec<Option<f64>> {
    let indices = first_order.iter().copied().chain(std::iter::repeat(None));
    let larger = |(correlation, index): (&Option<f64>, Option<f64>)| {
        let of_index = index.map(|index| index.max(0.0).sqrt());
        let is_larger = of_index > correlation.map(f64::abs);
        if is_larger { of_index } else { *correlation }
    };
    correlations.iter().zip(indices).map(larger).collect()
}

/// The places of correlations and these, by their absolute values; without those that there are not.
#[must_use]
pub fn strongest_first(correlations: &[Option<f64>]) -> Vec<(usize, f64)> {
    let mut all: Vec<_> = correlations.iter().enumerate().filter_map(|(i, found)| Some((i, (*found)?))).collect();
    // stable: equal ones stay in their order
    all.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
    all
}

#[cfg(test)]
mod tests {
    use super::{Scatter, effects, strongest_first};

    #[test]
    fn an_effect_that_no_correlation_shows_is_that_of_the_index() {
        let found = effects(&[Some(-0.5), Some(0.01), None], &[Some(0.2), Some(0.81), None]);
        assert_eq!(found, [Some(-0.5), Some(0.9), None]);
        assert_eq!(effects(&[Some(0.3)], &[]), [Some(0.3)], "keys that are correlated have no indices");
    }

    #[test]
    fn correlations_are_sorted_by_strength() {
        let found = strongest_first(&[Some(0.2), None, Some(-0.9), Some(0.5), Some(-0.5)]);
        assert_eq!(found, [(2, -0.9), (3, 0.5), (4, -0.5), (0, 0.2)]);
    }

    #[test]
    fn every_case_has_a_point_up_to_a_number_and_every_nth_beyond() {
        for (cases, stride, points) in [(1, 1, 1), (500, 1, 500), (501, 2, 251), (100_000, 200, 500)] {
            let output: Vec<f64> = (0..cases).map(f64::from).collect();
            let of_key = |key: usize| output.iter().map(|value| value + [0.0, 7.0][key]).collect();
            let found = Scatter::of(&[Some(0.1), Some(-0.2)], of_key, &output).expect("points");
            assert_eq!((found.key, found.stride, found.points.len()), (1, stride, points));
            assert!(found.points.iter().all(|(key, output)| (key - output - 7.0).abs() < 1e-9));
        }
        assert_eq!(Scatter::of(&[None, None], |_| vec![1.0], &[1.0]), None);
        assert_eq!(Scatter::of(&[Some(0.5)], |_| vec![f64::NAN], &[1.0]), None);
    }
}
