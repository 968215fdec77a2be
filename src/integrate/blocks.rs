//! Sums of stages over whole blocks of the integrated vector.

use crate::scalar::Real;
use multiversion::multiversion;

/// Entries in a block: sums of stages are of whole blocks, in registers. Entries are added one by one, each product and sum
/// rounded, so that the bits do not depend on the width of the processor's vectors.
pub(super) const BLOCK: usize = 8;

/// Entries of an integrated vector, the last block filled up with zeros.
pub(super) type Blocks = Vec<[f64; BLOCK]>;

/// `start + step Σ factor stage`, into the last argument; the stages one after the other.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
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

/// `Σ factor stage`, into the last argument.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
pub(super) fn sum(row: &[(usize, f64)], stages: &[[f64; BLOCK]], into: &mut [[f64; BLOCK]]) {
    for_each_sum(row, stages, into.len(), |i, sum| into[i] = sum);
}

/// `start + step s Σ cₖ Tₖ(2 s - 1)`, into the last argument; the coefficients c of Chebyshev's polynomials T one after the other.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
pub(super) fn chebyshev(
    start: &[[f64; BLOCK]],
    step: f64,
    s: f64,
    coefficients: &[[f64; BLOCK]],
    into: &mut [[f64; BLOCK]],
) {
    let (u, blocks) = (2.0 * s - 1.0, start.len());
    let of_three = |first| clenshaw::<3>(u, coefficients, blocks, first);
    for_each_part(
        blocks,
        of_three,
        |first| clenshaw::<1>(u, coefficients, blocks, first),
        |i, sum| {
            for ((into, start), sum) in into[i].iter_mut().zip(&start[i]).zip(sum) {
                *into = start + step * (s * sum);
            }
        },
    );
}

/// The largest `step Σ factor stage` of a step between `ends`, over the error that is allowed.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+avx2", "x86_64+avx2"))]
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

/// `Σ factor stage` of each of so many blocks.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn for_each_sum(row: &[(usize, f64)], stages: &[[f64; BLOCK]], blocks: usize, each: impl FnMut(usize, [f64; BLOCK])) {
    let of_three = |first| sums::<3>(row, stages, blocks, first);
    for_each_part(blocks, of_three, |first| sums::<1>(row, stages, blocks, first), each);
}

/// Calls for each of so many blocks with what is computed for it; inlined for the processor of who calls it, with as many
/// blocks at once as have place in its registers.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn for_each_part(
    blocks: usize,
    of_three: impl Fn(usize) -> [[f64; BLOCK]; 3],
    of_one: impl Fn(usize) -> [[f64; BLOCK]; 1],
    mut each: impl FnMut(usize, [f64; BLOCK]),
) {
    let mut first = 0;
    while blocks - first >= 3 {
        of_three(first).into_iter().enumerate().for_each(|(i, found)| each(first + i, found));
        first += 3;
    }
    for i in first..blocks {
        let [found] = of_one(i);
        each(i, found);
    }
}

/// `Σ cₖ Tₖ(u)` of blocks from one on, by Clenshaw's recurrence.
#[inline(always)]
#[allow(clippy::inline_always, reason = "its vectors are those of the caller")]
fn clenshaw<const N: usize>(u: f64, coefficients: &[[f64; BLOCK]], blocks: usize, first: usize) -> [[f64; BLOCK]; N] {
    let of = |rows: &[[f64; BLOCK]]| *rows[first..].first_chunk::<N>().expect("all blocks of a polynomial");
    let (constant, others) = coefficients.split_at(blocks);
    let [mut last, mut before] = [[[0.0; BLOCK]; N]; 2];
    for rows in others.chunks_exact(blocks).rev() {
        let mut sums = of(rows);
        let places = sums.as_flattened_mut().iter_mut().zip(last.as_flattened().iter().zip(before.as_flattened()));
        places.for_each(|(sum, (last, before))| *sum = 2.0 * u * last + *sum - before);
        (last, before) = (sums, last);
    }
    let mut sums = of(constant);
    let places = sums.as_flattened_mut().iter_mut().zip(last.as_flattened().iter().zip(before.as_flattened()));
    places.for_each(|(sum, (last, before))| *sum = u * last + *sum - before);
    sums
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
