//! The same where four lanes are one register: those of far angles are put together in some, so that they meet the others' in
//! registers. What follows then takes a tenth less; where four lanes are two registers, of which there are fewer, it takes more.

use super::{COUNT, Pairs, any_sum, near_f64x4, pairs};
use core::array::from_fn;
use wide::f64x4;

/// (sine, cosine) of each angle, rad; the terms are asked for where one is far.
#[inline(always)]
pub(super) fn of_each<const N: usize>(angles: [f64; N], terms: impl Fn() -> f64) -> [(f64, f64); N] {
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

/// The same from an angle on. Its first lines are also in the loop for two lanes: as a function of both they make a Runge-Kutta step there
/// 300 instructions longer.
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
    let (mut sines, is_far) = near_f64x4(first.into());
    let (mut next_sines, is_further) = near_f64x4(second.into());
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
