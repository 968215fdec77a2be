//! Sums of stages over whole blocks of the integrated vector.

use crate::scalar::Real;
use multiversion::multiversion;

/// Entries in a block: sums of stages are of whole blocks, in registers. Entries are added one by one, each product and sum
/// rounded, so that the bits do not depend on the width of the processor's vectors.
pub(super) const BLOCK: usize = 8;

/// Entries of an integrated vector, the last block filled up with zeros.
pub(super) type Blocks = Vec<[f64; BLOCK]>;

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

/// The largest `step Σ factor stage` of a step between `ends`, over the error that is allowed.
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
