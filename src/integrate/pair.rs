//! Verner's "most efficient" pair of orders 9 and 8 with an interpolant of order 9 (`rkv989e`), from the tables of the
//! crate `differential-equations`, which are full: here without their zeros.

use crate::scalar::Real;
use differential_equations::tableau::ButcherTableau;
use multiversion::multiversion;
use std::sync::LazyLock;

/// Stages of a step.
pub(super) const STAGES: usize = 16;
/// With those of the interpolant.
pub(super) const ALL_STAGES: usize = 26;
/// The order.
pub(super) const ORDER: f64 = 9.0;
/// The degree of the interpolant.
const DEGREE: usize = 9;
/// Entries in a block: sums of stages are of whole blocks, in registers. Entries are added one by one, each product and sum
/// rounded, so that the bits do not depend on the width of the processor's vectors.
pub(super) const BLOCK: usize = 8;

/// Larger defects of stages are not of rounding.
const ROUNDING: f64 = 1e-12;

/// Entries of an integrated vector, the last block filled up with zeros.
pub(super) type Blocks = Vec<[f64; BLOCK]>;

/// Factors of stages that are not zero.
type Row = Vec<(usize, f64)>;

/// The coefficients.
pub(super) struct Pair {
    /// Where in a step a stage is, from 0 to 1.
    pub(super) nodes: [f64; ALL_STAGES],
    /// What a stage adds to the start of the step.
    pub(super) rows: [Row; ALL_STAGES],
    /// The same of its end, by the formula of order 9.
    pub(super) weights: Row,
    /// Those weights less those of order 8.
    pub(super) errors: Row,
    /// Of each stage `c^q - q Σ a c^(q-1)`, q from 2 to 5, by which the sums of ẋ miss a motion that is a polynomial of time.
    /// It is zero for all but the first few.
    pub(super) defects: Vec<(usize, [f64; 4])>,
    /// Of each stage the polynomial of its weight within the step: the factors of s, s² ….
    interpolant: [[f64; DEGREE]; ALL_STAGES],
}

/// The pair.
pub(super) static PAIR: LazyLock<Pair> = LazyLock::new(Pair::new);

impl Pair {
    fn new() -> Self {
        let ButcherTableau { c, a, b, bh, bi, .. } = ButcherTableau::<f64, STAGES, ALL_STAGES>::rkv989e();
        let row = |factors: &[f64]| factors.iter().copied().enumerate().filter(|(_, factor)| *factor != 0.0).collect();
        let lower = bh.expect("the pair has a second formula");
        let errors: Vec<f64> = b.iter().zip(lower).map(|(high, low)| high - low).collect();
        let interpolant = bi.expect("the pair has an interpolant");
        let defect = |stage: usize, power: i32| {
            let sum =
                a[stage].iter().zip(c).take(stage).map(|(factor, node)| factor * node.powi(power - 1)).sum::<f64>();
            c[stage].powi(power) - f64::from(power) * sum
        };
        let defects = (1..ALL_STAGES).map(|stage| (stage, [2, 3, 4, 5].map(|power| defect(stage, power))));
        Self {
            nodes: c,
            rows: std::array::from_fn(|stage| row(&a[stage][..stage])),
            weights: row(&b),
            errors: row(&errors),
            defects: defects.filter(|(_, defects)| defects.iter().any(|defect| defect.abs() > ROUNDING)).collect(),
            interpolant: interpolant.map(|of_stage| std::array::from_fn(|power| of_stage[power])),
        }
    }

    /// The weights of the stages at s, from 0 to 1, within a step.
    pub(super) fn weights_within(&self, s: f64) -> [(usize, f64); ALL_STAGES] {
        let polynomial = |factors: &[f64; DEGREE]| factors.iter().rev().fold(0.0, |sum, factor| sum * s + factor) * s;
        std::array::from_fn(|stage| (stage, polynomial(&self.interpolant[stage])))
    }
}

/// `start + step Σ factor stage`, into the last argument; the stages one after the other.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn combine(
    start: &[[f64; BLOCK]],
    step: f64,
    row: &[(usize, f64)],
    stages: &[[f64; BLOCK]],
    into: &mut [[f64; BLOCK]],
) {
    let blocks = start.len();
    for (i, (into, start)) in into.iter_mut().zip(start).enumerate() {
        let sum = sum(row, stages, blocks, i);
        for ((into, start), sum) in into.iter_mut().zip(start).zip(sum) {
            *into = start + step * sum;
        }
    }
}

/// The largest error of a step between `ends`, `step Σ factor stage`, over the one that is allowed.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn largest_error(
    ends: [&[[f64; BLOCK]]; 2],
    step: f64,
    row: &[(usize, f64)],
    stages: &[[f64; BLOCK]],
    tolerance: f64,
) -> f64 {
    let mut most = 0.0;
    let [starts, ends] = ends;
    for (i, (start, end)) in starts.iter().zip(ends).enumerate() {
        let error = sum(row, stages, starts.len(), i);
        for ((start, end), error) in start.iter().zip(end).zip(error) {
            let allowed = tolerance * (1.0 + start.abs().max(end.abs()));
            most = Real::maximum(most, (step * error / allowed).abs());
        }
    }
    most
}

/// `Σ factor stage` of a block of so many; inlined for the processor of who calls it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn sum(row: &[(usize, f64)], stages: &[[f64; BLOCK]], blocks: usize, block: usize) -> [f64; BLOCK] {
    let mut sum = [0.0; BLOCK];
    for (stage, factor) in row {
        let stage = &stages[stage * blocks + block];
        sum.iter_mut().zip(stage).for_each(|(sum, rate)| *sum += factor * rate);
    }
    sum
}
