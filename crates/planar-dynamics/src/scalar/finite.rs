//! Whether numbers are finite.

use super::number::Scalar;
use super::real::Real;

/// Whether the numbers of all slices are finite: 0 x is 0 where x is, else NaN. There is no branch per number, and no call:
/// what a function borrows is in memory, where it could have been in registers.
///
/// A processor with vectors compares several at once, and would wait for a sum. One without adds the products, and so does one with
/// AVX-512, where the compiler takes vectors of 64 bytes for the comparison alone, puts them together from others, and Intel's slow
/// down what is around them: a fifth of a Runge–Kutta step.
#[cfg_attr(target_arch = "arm", inline)]
#[cfg_attr(not(target_arch = "arm"), inline(always))]
#[must_use]
#[allow(clippy::inline_always, reason = "a call, see above")]
#[allow(clippy::needless_bitwise_bool, reason = "a branch per number costs more than the comparison")]
pub fn all_finite<T: Real, const N: usize>(slices: [&[T]; N]) -> bool {
    if cfg!(not(any(target_arch = "arm", target_feature = "avx512f"))) {
        let mut all = true;
        for values in &slices {
            for value in *values {
                all &= *value * T::ZERO == T::ZERO;
            }
        }
        return all;
    }
    let products = |sum, values: &[T]| {
        values.iter().fold(sum, |sum: Option<T>, value| {
            Some(sum.map_or(*value * T::ZERO, |sum| T::mul_add(*value, T::ZERO, sum)))
        })
    };
    slices.into_iter().fold(None, products).is_none_or(|sum| sum == T::ZERO)
}

/// The sum with products that are 0, or none with a number that is not finite.
#[inline]
#[must_use]
pub fn unless_finite<T: Scalar>(sum: T, values: &[T]) -> T {
    values.iter().fold(sum, |sum, value| sum + *value * T::ZERO)
}

/// 0, or none where one of the masses and moments of inertia is 0 or not finite: x / x is else 1.
#[inline]
#[must_use]
#[allow(clippy::eq_op, reason = "it is not 1 of each number")]
pub fn regularity<T: Scalar, const N: usize>(masses: [T; N]) -> T {
    masses.iter().fold(T::ZERO, |sum, mass| sum + *mass / *mass) * T::ZERO
}
