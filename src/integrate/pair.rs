//! Pairs of explicit formulas, of which the lower one estimates the error of the other, with interpolants; from the tables
//! of the crate `differential-equations`, which are full: here without their zeros.

use super::lagrange::{NODES, integrated_weights};
use differential_equations::tableau::ButcherTableau;
use std::sync::LazyLock;

/// Most stages of a step and its interpolant.
pub(super) const MOST_STAGES: usize = 26;
/// The largest degree of an interpolant.
pub(super) const DEGREE: usize = 9;

/// The error of a step over the divided difference of its rates. With less, errors under fast feedback exceed ten tolerances; twice as
/// much takes a tenth more evaluations.
const SHARE: f64 = 1e-4;

/// Larger defects of stages are not of rounding.
const ROUNDING: f64 = 1e-12;

/// Factors of stages that are not zero.
type Row = Vec<(usize, f64)>;

/// The coefficients. A step has its stages, the rate at its end, which is the first stage of the next one, and further stages
/// of the interpolant.
#[derive(Debug)]
pub(super) struct Pair {
    /// Stages of a step.
    pub(super) stages: usize,
    /// The power of a step that its error follows.
    pub(super) order: f64,
    /// Where in a step a stage is, from 0 to 1.
    pub(super) nodes: Vec<f64>,
    /// What a stage adds to the start of the step.
    pub(super) rows: Vec<Row>,
    /// The same of its end.
    pub(super) weights: Row,
    /// By which the error of a step is estimated: those weights less those of the lower formula, or a divided difference.
    pub(super) errors: Row,
    /// Of each stage `c^q - q Σ a c^(q-1)`, q from 2 to 5, by which the sums of ẋ miss a motion that is a polynomial of time.
    /// It is zero for all but the first few.
    pub(super) defects: Vec<Option<[f64; 4]>>,
    /// Stages by whose ẋ the motion over a step is continued: spread over it, and of the most exact.
    pub(super) continued: [usize; NODES],
    /// Their weights in the second to the fifth power of time.
    pub(super) continuing: [[f64; NODES]; 4],
    /// Weights of the stages within the step, over the part s of it that has passed, by Chebyshev's polynomials of 2 s - 1. They
    /// are as small as the weights are; those of powers of s are hundreds of times as large, and so are their rounding errors.
    pub(super) interpolant: [Row; DEGREE],
}

/// Verner's "most efficient" pair of orders 9 and 8 with an interpolant of order 9: the fewest evaluations for a smooth motion.
pub(super) static VERNER: LazyLock<Pair> = LazyLock::new(|| {
    let tableau = ButcherTableau::<f64, 16, 26>::rkv989e();
    let lower = tableau.bh.expect("the pair has a second formula");
    let interpolant = tableau.bi.expect("the pair has an interpolant");
    let of_stage = |stage: usize| std::array::from_fn(|power| interpolant[stage][power]);
    Pair {
        order: 9.0,
        errors: row(tableau.b.iter().zip(lower).map(|(high, low)| high - low)),
        interpolant: by_chebyshev::<26>(of_stage),
        ..Pair::formula(&tableau, [0, 10, 8, 11, 16])
    }
});

/// Dormand & Prince's formula of order 8 with an interpolant of order 7 by Hairer (`dop853`): its steps are stable up to 6.4 times
/// the shortest time constant, those of the other pair up to 4.4, with three quarters of the evaluations.
///
/// Of the two estimates that it comes with, of orders 5 and 3, the first over the second times itself has the order of the
/// formula. Where stability limits the steps and each continues the motion of the last one, it misses errors of several hundred
/// tolerances; a divided difference of all rates sees them.
pub(super) static DORMAND_PRINCE: LazyLock<Pair> = LazyLock::new(|| {
    let tableau = ButcherTableau::<f64, 12, 16>::dop853();
    let further = tableau.bi.expect("the pair has an interpolant");
    // Hairer, Nørsett & Wanner (1993), section II.6: products of s and 1 - s by turns
    let bases = [[1, 0], [1, 1], [2, 1], [2, 2], [3, 2], [3, 3], [4, 3]].map(product);
    let of_stage = |stage: usize| {
        let weight = tableau.b.get(stage).copied().unwrap_or_default();
        let [start, end] = [0, 12].map(|of| if stage == of { 1.0 } else { 0.0 });
        let [fourth, fifth, sixth, seventh] = [4, 5, 6, 7].map(|row: usize| further[row][stage]);
        let factors = [weight, start - weight, 2.0 * weight - start - end, fourth, fifth, sixth, seventh];
        std::array::from_fn(|power| factors.iter().zip(&bases).map(|(factor, base)| factor * base[power]).sum())
    };
    Pair {
        order: 8.0,
        errors: divided_difference(&row(tableau.b), &tableau.c),
        interpolant: by_chebyshev::<16>(of_stage),
        ..Pair::formula(&tableau, [0, 6, 9, 10, 12])
    }
});

impl Pair {
    /// The formula of a step, without estimate and interpolant.
    fn formula<const S: usize, const I: usize>(tableau: &ButcherTableau<f64, S, I>, continued: [usize; NODES]) -> Self {
        let ButcherTableau { a, b, .. } = tableau;
        let weights = row(*b);
        let mut nodes = tableau.c.to_vec();
        let mut rows: Vec<_> = (0..I).map(|stage| row(a[stage][..stage].iter().copied())).collect();
        // after the stages of the step comes the rate at its end, which the table of `dop853` leaves out
        (nodes[S], rows[S]) = (1.0, weights.clone());
        let defect = |stage: usize, power: i32| {
            let sum = rows[stage].iter().map(|(of, factor)| factor * nodes[*of].powi(power - 1)).sum::<f64>();
            nodes[stage].powi(power) - f64::from(power) * sum
        };
        let defects = |stage| {
            let defects = [2, 3, 4, 5].map(|power| defect(stage, power));
            let defects = defects.map(|defect| if defect.abs() > ROUNDING { defect } else { 0.0 });
            defects.iter().any(|defect| *defect != 0.0).then_some(defects)
        };
        Self {
            stages: S,
            order: 0.0,
            errors: Vec::new(),
            defects: (0..I).map(defects).collect(),
            continued,
            continuing: integrated_weights(&continued.map(|stage| nodes[stage])),
            interpolant: Default::default(),
            nodes,
            rows,
            weights,
        }
    }

    /// Stages of a step and its interpolant, with the rate at the end.
    pub(super) fn all_stages(&self) -> usize {
        self.nodes.len()
    }

    /// Least part of the allowed step that is taken to end at a requested time, where the interpolant takes further evaluations.
    #[allow(clippy::cast_precision_loss, reason = "small numbers")]
    pub(super) fn landing(&self) -> f64 {
        self.stages as f64 / (self.all_stages() - 1) as f64
    }
}

/// Of polynomials of s, one per stage without a constant, those over s by Chebyshev's polynomials: the factors of each.
fn by_chebyshev<const STAGES: usize>(of_stage: impl Fn(usize) -> [f64; DEGREE]) -> [Row; DEGREE] {
    let polynomials: [[f64; DEGREE]; STAGES] = std::array::from_fn(|stage| in_chebyshev(of_stage(stage)));
    std::array::from_fn(|degree| row(polynomials.iter().map(|factors| factors[degree])))
}

/// From the factors of 1, s, s² … those of Chebyshev's polynomials of 2 s - 1.
fn in_chebyshev(factors: [f64; DEGREE]) -> [f64; DEGREE] {
    let mut sum = [0.0; DEGREE];
    for factor in factors.into_iter().rev() {
        // 4 s Tₖ = Tₖ₋₁ + 2 Tₖ + Tₖ₊₁, where T₋₁ is T₁
        let mut product = [0.0; DEGREE];
        for (k, of) in sum.into_iter().enumerate() {
            for (to, share) in [(k.abs_diff(1), 0.25), (k, 0.5), (k + 1, 0.25)] {
                if let Some(place) = product.get_mut(to) {
                    *place += share * of;
                }
            }
        }
        sum = product;
        sum[0] += factor;
    }
    sum
}

/// What is not zero of the factors of stages.
fn row(factors: impl IntoIterator<Item = f64>) -> Row {
    factors.into_iter().enumerate().filter(|(_, factor)| *factor != 0.0).collect()
}

/// [`SHARE`] times the divided difference of the rates at the stages that a formula has a weight for: of n stages what is left of
/// powers of time from the (n - 1)th on.
fn divided_difference(weights: &Row, nodes: &[f64]) -> Row {
    let stages = || weights.iter().map(|(stage, _)| *stage);
    let of_stage = |stage: usize| {
        let others = stages().filter(|other| *other != stage);
        (stage, SHARE / others.map(|other| nodes[stage] - nodes[other]).product::<f64>())
    };
    stages().map(of_stage).collect()
}

/// s to a power times 1 - s to another: the factors of s, s² ….
fn product([power, of_rest]: [usize; 2]) -> [f64; DEGREE] {
    let mut factors = [0.0; DEGREE];
    let mut binomial = 1.0;
    for i in 0..=of_rest {
        factors[power + i - 1] = binomial;
        #[allow(clippy::cast_precision_loss, reason = "small numbers")]
        let [left, next] = [of_rest - i, i + 1].map(|count| count as f64);
        binomial *= -left / next;
    }
    factors
}

#[cfg(test)]
mod tests;
