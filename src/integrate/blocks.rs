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
    for_each_sum(row, stages, start.len(), |i, sum| {
        for ((into, start), sum) in into[i].iter_mut().zip(&start[i]).zip(sum) {
            *into = start + step * sum;
        }
    });
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
    for_each_sum(row, stages, starts.len(), |i, errors| {
        for ((start, end), error) in starts[i].iter().zip(&ends[i]).zip(errors) {
            let allowed = tolerance * (1.0 + start.abs().max(end.abs()));
            most = Real::maximum(most, (step * error / allowed).abs());
        }
    });
    most
}

/// `Σ factor stage` of each of so many blocks; inlined for the processor of who calls it, with as many blocks at once as have
/// place in its registers.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn for_each_sum(
    row: &[(usize, f64)],
    stages: &[[f64; BLOCK]],
    blocks: usize,
    mut each: impl FnMut(usize, [f64; BLOCK]),
) {
    let mut first = 0;
    while blocks - first >= 3 {
        let sums = sums::<3>(row, stages, blocks, first);
        sums.into_iter().enumerate().for_each(|(i, sum)| each(first + i, sum));
        first += 3;
    }
    for i in first..blocks {
        let [sum] = sums(row, stages, blocks, i);
        each(i, sum);
    }
}

/// `Σ factor stage` of blocks from one on.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn sums<const N: usize>(
    row: &[(usize, f64)],
    stages: &[[f64; BLOCK]],
    blocks: usize,
    first: usize,
) -> [[f64; BLOCK]; N] {
    let mut sums = [[0.0; BLOCK]; N];
    for (stage, factor) in row {
        let of_stage = stages[stage * blocks + first..].first_chunk::<N>().expect("all blocks of a stage");
        for (sum, rates) in sums.as_flattened_mut().iter_mut().zip(of_stage.as_flattened()) {
            *sum += factor * rates;
        }
    }
    sums
}
