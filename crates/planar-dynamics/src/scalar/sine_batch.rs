//! Sines and cosines of several angles of one configuration at once, in SIMD lanes. Those of far angles are put together in lanes, so
//! that they meet the others' in registers: numbers that a function may have written stay in memory, in any case, and vectors that are
//! loaded from there wait.

#![allow(clippy::inline_always, reason = "a call would pass all angles and results through memory")]

use super::portable;
use super::sine::double::{any_sum, terms};
use super::sine_lanes::{NearF64x4, near_f64x4};
use core::array::from_fn;
use wide::f64x4;

/// The terms of angles that are no sums: one that is infinite stays so.
const NO_SUM: f64 = f64::NAN;

/// (sine, cosine) of each angle, rad.
#[inline(always)]
pub(super) fn sin_cos_all_f64<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    if N < 3 {
        return portable::sin_cos_all_f64(angles);
    }
    of_each(angles, || NO_SUM)
}

/// (sine, cosine) of sums, rad: `Scalar::sin_cos_of_sums`.
#[inline(always)]
pub(super) fn sin_cos_of_sums_f64<const N: usize, const K: usize, const M: usize>(
    sums: [f64; N],
    some: [f64; K],
    others: &[f64; M],
) -> [(f64, f64); N] {
    if N < 3 {
        return portable::sin_cos_of_sums_f64(sums, some, others);
    }
    of_each(sums, || terms(some, others))
}

/// Angles at once.
const COUNT: usize = 8;

type Pairs = [(f64, f64); COUNT];

/// (sine, cosine) of each angle, rad; the terms are asked for where one is far.
#[inline(always)]
fn of_each<const N: usize>(angles: [f64; N], terms: impl Fn() -> f64) -> [(f64, f64); N] {
    if N <= COUNT {
        let pairs = of_some(&angles, 0, terms);
        return from_fn(|i| pairs.get(i).copied().unwrap_or_default());
    }
    let mut results = [(0.0, 0.0); N];
    let mut from = 0;
    while from < N {
        let pairs = of_some(&angles, from, &terms);
        results.iter_mut().skip(from).zip(pairs).for_each(|(result, pair)| *result = pair);
        from += COUNT;
    }
    results
}

/// The same from an angle on.
#[inline(always)]
fn of_some<const N: usize>(angles: &[f64; N], from: usize, terms: impl Fn() -> f64) -> Pairs {
    // the last one again in lanes that have none: it is in a register, and a 0 would have to be put beside it
    let angle = |i: usize| angles.get(from + i).or(angles.last()).copied().unwrap_or(0.0);
    let [first, second] = [0, 4].map(|i| [angle(i), angle(i + 1), angle(i + 2), angle(i + 3)]);
    if from + 4 < N { eight(first, second, terms) } else { four(first, terms) }
}

/// Two vectors at once, whose operations fill each other's waiting times.
#[inline(always)]
fn eight(first: [f64; 4], second: [f64; 4], terms: impl Fn() -> f64) -> Pairs {
    let (mut near, is_far) = NearF64x4::new(first.into());
    let (mut next, is_further) = NearF64x4::new(second.into());
    near.add(NearF64x4::TERMS[0]);
    next.add(NearF64x4::TERMS[0]);
    for terms in NearF64x4::next_terms::<2>() {
        near.add(*terms);
        next.add(*terms);
    }
    let (mut sines, mut next_sines) = (near.pair(), next.pair());
    if (is_far | is_further).any() {
        (sines, next_sines) = (far(first, terms()), far(second, terms()));
    }
    pairs(sines, next_sines)
}

#[inline(always)]
fn four(angles: [f64; 4], terms: impl Fn() -> f64) -> Pairs {
    let (mut sines, is_far) = near_f64x4(angles.into());
    if is_far.any() {
        sines = far(angles, terms());
    }
    pairs(sines, (f64x4::ZERO, f64x4::ZERO))
}

/// (sine, cosine) of each lane of two vectors.
#[inline(always)]
fn pairs((sine, cosine): (f64x4, f64x4), (next_sine, next_cosine): (f64x4, f64x4)) -> Pairs {
    let [sine, cosine, next_sine, next_cosine] =
        [sine.to_array(), cosine.to_array(), next_sine.to_array(), next_cosine.to_array()];
    [
        (sine[0], cosine[0]),
        (sine[1], cosine[1]),
        (sine[2], cosine[2]),
        (sine[3], cosine[3]),
        (next_sine[0], next_cosine[0]),
        (next_sine[1], next_cosine[1]),
        (next_sine[2], next_cosine[2]),
        (next_sine[3], next_cosine[3]),
    ]
}

/// (sines, cosines) of angles any of which may be far.
#[inline(always)]
fn far([a, b, c, d]: [f64; 4], terms: f64) -> (f64x4, f64x4) {
    let [a, b, c, d] = [one(a, terms), one(b, terms), one(c, terms), one(d, terms)];
    ([a.0, b.0, c.0, d.0].into(), [a.1, b.1, c.1, d.1].into())
}

/// An angle and two numbers, all in registers.
#[cold]
#[inline(never)]
fn one(angle: f64, terms: f64) -> (f64, f64) {
    any_sum(angle, terms).into_tuple()
}
