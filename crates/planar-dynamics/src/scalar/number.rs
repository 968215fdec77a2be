//! The trait of numbers that generated code computes with.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// A number that generated code computes with: `f32`, `f64`, SIMD lanes, dual numbers.
///
/// The code is free of branches and compares by [`Scalar::minimum`] alone, so that SIMD lanes can implement it.
pub trait Scalar:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// 0, in every lane.
    const ZERO: Self;
    /// 1, in every lane.
    const ONE: Self;

    /// The nearest value to `value`, in every lane.
    fn constant(value: f64) -> Self;

    /// (sine, cosine) of an angle in rad.
    fn sin_cos(self) -> (Self, Self);

    /// (sine, cosine) of several angles in rad, at once where that is faster.
    #[allow(clippy::inline_always, reason = "a call would leave a batch's processor features behind, and its vectors")]
    #[inline(always)]
    fn sin_cos_all<const N: usize>(angles: [Self; N]) -> [(Self, Self); N] {
        angles.map(Self::sin_cos)
    }

    /// (sine, cosine) of sums in rad, whose terms are among `some` and `others`. A sum beyond the largest number counts as
    /// that number where all of these are finite: each angle is valid, whatever the others are.
    ///
    /// Without a definition of its own, a scalar has what [`sin_cos_all`](Self::sin_cos_all) gives.
    #[allow(clippy::inline_always, reason = "a call would leave a batch's processor features behind, and its vectors")]
    #[inline(always)]
    fn sin_cos_of_sums<const N: usize, const K: usize, const M: usize>(
        sums: [Self; N],
        some: [Self; K],
        others: &[Self; M],
    ) -> [(Self, Self); N] {
        let _ = (some, others);
        Self::sin_cos_all(sums)
    }

    /// The value, or of an infinite one the largest number with its sign.
    #[inline]
    #[must_use]
    fn saturated(self) -> Self {
        self
    }

    /// `self` · `factor` + `addend`; with one rounding where the feature `fused` and the processor allow it.
    #[inline]
    #[must_use]
    fn mul_add(self, factor: Self, addend: Self) -> Self {
        self * factor + addend
    }

    /// Square root.
    #[must_use]
    fn sqrt(self) -> Self;

    /// The angle of the vector (`x`, `self`), in rad, −π to π; 0 for the null vector.
    #[must_use]
    fn atan2(self, x: Self) -> Self;

    /// The smaller of two values; NaN where either is, so that it shows in the smallest of many.
    #[must_use]
    fn minimum(self, other: Self) -> Self;

    super::both::number_by_number!(add_both + sub_both - mul_both * div_both /);
}
