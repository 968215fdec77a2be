//! The scalar of a loop that the compiler turns into vectors: a function compiled for an instruction set computes with it.

#![allow(clippy::inline_always, reason = "what is not inlined has the instruction set of the build")]

use super::Scalar;
use super::sine::{DOUBLE, exchanged_f64};
use core::f64::consts::FRAC_2_PI;
use core::ops::{Add, Div, Mul, Neg, Sub};

/// An `f64` without branches and calls. `FUSED` says whether products are fused with sums where that is asked for: only
/// where the instruction set has it.
///
/// Sines are those of [`sin_cos_f64`](super::sin_cos_f64), bit for bit unless fused, and NaN for angles far from 0.
#[derive(Clone, Copy, Debug)]
pub struct Lane<const FUSED: bool>(pub f64);

macro_rules! operator {
    ($trait:ident, $method:ident, $operator:tt) => {
        impl<const FUSED: bool> $trait for Lane<FUSED> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

impl<const FUSED: bool> Neg for Lane<FUSED> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<const FUSED: bool> Scalar for Lane<FUSED> {
    const ZERO: Self = Self(0.0);
    const ONE: Self = Self(1.0);

    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self(value)
    }

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let [pair] = together([self]);
        pair
    }

    /// Without a loop up to 24 angles: a loop in a loop would not become vectors.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut pairs = [(Self::ZERO, Self::ONE); N];
        let angle = |i: usize| angles.get(i).copied().unwrap_or(Self::ZERO);
        macro_rules! without_loop {
            ($($i:literal)*) => {
                $(if $i < N {
                    // of angles that are not there, the compiler computes nothing
                    let four = together([angle($i), angle($i + 1), angle($i + 2), angle($i + 3)]);
                    for k in 0..4 {
                        if let Some(pair) = pairs.get_mut($i + k) {
                            *pair = four[k];
                        }
                    }
                })*
            };
        }
        without_loop!(0 4 8 12 16 20);
        let mut i = 24;
        while let (Some(pair), Some(angle)) = (pairs.get_mut(i), angles.get(i)) {
            *pair = angle.sin_cos();
            i += 1;
        }
        pairs
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        match FUSED {
            #[cfg(any(feature = "batch", feature = "fused"))]
            true => Self(std::primitive::f64::mul_add(self.0, factor.0, addend.0)),
            _ => self * factor + addend,
        }
    }

    fn sqrt(self) -> Self {
        Self(Scalar::sqrt(self.0))
    }

    fn atan2(self, x: Self) -> Self {
        Self(Scalar::atan2(self.0, x.0))
    }

    #[inline(always)]
    fn minimum(self, other: Self) -> Self {
        if self.0 < other.0 || self.0.is_nan() { self } else { other }
    }
}

/// (sine, cosine) of some angles, whose operations fill each other's waiting times.
#[inline(always)]
fn together<const FUSED: bool, const K: usize>(angles: [Lane<FUSED>; K]) -> [(Lane<FUSED>, Lane<FUSED>); K] {
    let round = Lane(DOUBLE.round);
    let angles = angles.map(|angle| if angle.0.abs() > DOUBLE.furthest { Lane(f64::NAN) } else { angle });
    let shifted = angles.map(|angle| angle.mul_add(Lane(FRAC_2_PI), round));
    let mut x = angles;
    for part in DOUBLE.quarter_turn {
        for (x, shifted) in x.iter_mut().zip(shifted) {
            *x = (shifted - round).mul_add(Lane(-part), *x);
        }
    }
    let z = x.map(|x| x * x);
    let (mut sines, mut cosines) = ([Lane(DOUBLE.sine[5]); K], [Lane(DOUBLE.cosine[5]); K]);
    // by Horner's rule
    for i in (0..5).rev() {
        for k in 0..K {
            sines[k] = z[k].mul_add(sines[k], Lane(DOUBLE.sine[i]));
            cosines[k] = z[k].mul_add(cosines[k], Lane(DOUBLE.cosine[i]));
        }
    }
    core::array::from_fn(|k| {
        let (x, z) = (x[k], z[k]);
        let sine = (x * z).mul_add(sines[k], x);
        let cosine = z.mul_add(z.mul_add(cosines[k], Lane(-0.5)), Lane(1.0));
        let (sine, cosine) = exchanged_f64(sine.0, cosine.0, shifted[k].0.to_bits());
        (Lane(sine), Lane(cosine))
    })
}
