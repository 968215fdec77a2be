//! The scalar of a loop that the compiler turns into vectors: a function compiled for an instruction set computes with it.

#![allow(clippy::inline_always, reason = "what is not inlined has the instruction set of the build")]

use super::Scalar;
use super::sine::DOUBLE;
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
        let angle = if self.0.abs() > DOUBLE.furthest { Self(f64::NAN) } else { self };
        let round = Self(DOUBLE.round);
        let shifted = angle.mul_add(Self(FRAC_2_PI), round);
        let quarters = shifted - round;
        let [first, second, third] = DOUBLE.quarter_turn.map(|part| Self(-part));
        let x = quarters.mul_add(third, quarters.mul_add(second, quarters.mul_add(first, angle)));
        let z = x * x;
        let sine = (x * z).mul_add(polynomial(z, DOUBLE.sine), x);
        let cosine = z.mul_add(z.mul_add(polynomial(z, DOUBLE.cosine), Self(-0.5)), Self::ONE);
        // exchanged in odd quadrants
        let (sine, cosine, quadrant) = (sine.0.to_bits(), cosine.0.to_bits(), shifted.0.to_bits());
        let exchange = (sine ^ cosine) & (quadrant & 1).wrapping_neg();
        let sign = |quadrant: u64| (quadrant & 2) << 62;
        let sine = sine ^ exchange ^ sign(quadrant);
        let cosine = cosine ^ exchange ^ sign(quadrant.wrapping_add(1));
        (Self(f64::from_bits(sine)), Self(f64::from_bits(cosine)))
    }

    /// Without a loop up to 24 angles: a loop in a loop would not become vectors.
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        let mut pairs = [(Self::ZERO, Self::ONE); N];
        macro_rules! without_loop {
            ($($i:literal)*) => {
                $(if let (Some(pair), Some(angle)) = (pairs.get_mut($i), angles.get($i)) {
                    *pair = angle.sin_cos();
                })*
            };
        }
        without_loop!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23);
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

/// By Horner's rule.
#[inline(always)]
fn polynomial<const FUSED: bool>(z: Lane<FUSED>, [others @ .., last]: [f64; 6]) -> Lane<FUSED> {
    others.iter().rev().fold(Lane(last), |sum, coefficient| z.mul_add(sum, Lane(*coefficient)))
}
