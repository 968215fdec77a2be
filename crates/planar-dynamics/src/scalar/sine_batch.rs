//! Sines and cosines of several angles of one configuration at once, in SIMD lanes.

#![allow(clippy::inline_always, reason = "a call would pass all angles and results through memory")]

mod wide;

use super::portable;
use super::sine::double::{any_sum, terms};
use super::sine_lanes::near_f64x4;
use ::wide::f64x4;

/// Whether four lanes are one register.
const WIDE: bool = cfg!(target_feature = "avx");

/// The terms of angles that are no sums: one that is infinite stays so.
const NO_SUM: f64 = f64::NAN;

/// (sine, cosine) of each angle, rad.
#[inline(always)]
pub(super) fn sin_cos_all_f64<const N: usize>(angles: [f64; N]) -> [(f64, f64); N] {
    if N < 3 {
        return portable::sin_cos_all_f64(angles);
    }
    if WIDE {
        return wide::of_each(angles, || NO_SUM);
    }
    of_each(angles, |a, b| one_by_one(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], NO_SUM))
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
    if WIDE {
        return wide::of_each(sums, || terms(some, others));
    }
    of_each(sums, |a, b| one_by_one(a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3], terms(some, others)))
}

/// (sine, cosine) of each angle, rad; `far` is for eight of which any may be far.
#[inline(always)]
fn of_each<const N: usize>(angles: [f64; N], far: impl Fn([f64; 4], [f64; 4]) -> Pairs) -> [(f64, f64); N] {
    let mut results = [(0.0, 0.0); N];
    let mut from = 0;
    while from < N {
        let angle = |i: usize| angles.get(from + i).copied().unwrap_or(0.0);
        let [first, second] = [0, 4].map(|i| [angle(i), angle(i + 1), angle(i + 2), angle(i + 3)]);
        let pairs = if from + 4 < N { eight(first, second, &far) } else { four(first, &far) };
        results.iter_mut().skip(from).zip(pairs).for_each(|(result, pair)| *result = pair);
        from += COUNT;
    }
    results
}

/// Angles at once.
const COUNT: usize = 8;

type Pairs = [(f64, f64); COUNT];

/// Two vectors at once, whose operations fill each other's waiting times.
#[inline(always)]
fn eight(first: [f64; 4], second: [f64; 4], far: impl Fn([f64; 4], [f64; 4]) -> Pairs) -> Pairs {
    let ((sine, cosine), is_far) = near_f64x4(first.into());
    let ((next_sine, next_cosine), is_further) = near_f64x4(second.into());
    if (is_far | is_further).any() {
        return far(first, second);
    }
    pairs((sine, cosine), (next_sine, next_cosine))
}

#[inline(always)]
fn four(angles: [f64; 4], far: impl Fn([f64; 4], [f64; 4]) -> Pairs) -> Pairs {
    let ((sine, cosine), is_far) = near_f64x4(angles.into());
    if is_far.any() {
        return far(angles, [0.0; 4]);
    }
    pairs((sine, cosine), (f64x4::ZERO, f64x4::ZERO))
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

/// The angles are not passed as arrays, which would keep them in memory wherever this may be called.
#[cold]
#[inline(never)]
#[allow(clippy::too_many_arguments, clippy::many_single_char_names, reason = "registers")]
fn one_by_one(a: f64, b: f64, c: f64, d: f64, e: f64, f: f64, g: f64, h: f64, terms: f64) -> Pairs {
    [a, b, c, d, e, f, g, h].map(|angle| any_sum(angle, terms).into_tuple())
}
