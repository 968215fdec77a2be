//! Numbers of which each is off by a part of a rounding unit, as a number of lower precision is: how far results move tells
//! what rounding may do to them, whatever the order of operations is.

use planar_dynamics::scalar::Scalar;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The rounding unit, relative to a number: far above that of a double, so that only this shows, and so small that results
/// move in proportion to it.
pub const UNIT: f64 = 4096.0 * f64::EPSILON;

/// A number of a run; with the same number, other runs are off by other parts of the unit. Literals belong to none.
#[derive(Clone, Copy, Debug)]
pub struct Perturbed {
    pub value: f64,
    run: u64,
}

impl Perturbed {
    /// A number that is off itself, as an input is that has to be rounded.
    #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
    pub fn new(value: f64, run: u64) -> Self {
        let part = (mixed(value.to_bits() ^ mixed(run)) >> 11) as f64 * f64::EPSILON - 1.0;
        Self { value: value * (1.0 + UNIT * part), run }
    }

    /// What is computed with another number.
    fn with(self, other: Self, value: f64) -> Self {
        Self::new(value, self.run.max(other.run))
    }
}

/// Another number for each, without a pattern that shows: the finalizer of `SplitMix64`.
fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

macro_rules! operators {
    ($($operator:ident $method:ident,)*) => {
        $(impl $operator for Perturbed {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                self.with(other, self.value.$method(other.value))
            }
        })*
    };
}

operators! { Add add, Sub sub, Mul mul, Div div, }

impl Neg for Perturbed {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Scalar for Perturbed {
    const ZERO: Self = Self { value: 0.0, run: 0 };
    const ONE: Self = Self { value: 1.0, run: 0 };

    fn constant(value: f64) -> Self {
        Self { value, run: 0 }
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.value);
        (self.with(self, sin), self.with(self, cos))
    }

    fn sqrt(self) -> Self {
        self.with(self, self.value.sqrt())
    }

    fn atan2(self, x: Self) -> Self {
        self.with(x, libm::atan2(self.value, x.value))
    }

    fn minimum(self, other: Self) -> Self {
        if self.value < other.value || self.value.is_nan() { self } else { other }
    }
}

#[cfg(test)]
mod tests {
    use super::{Perturbed, UNIT};

    /// Sums of 100 terms of 1 are off by some units, less than 100, and in every run by others.
    #[test]
    fn results_move_by_as_much_as_rounding_may_move_them() {
        let moved = |run: u64| {
            let mut sum = Perturbed::new(1.0, run);
            for _ in 0..99 {
                sum = sum + Perturbed::new(1.0, run);
            }
            (sum.value - 100.0) / (100.0 * UNIT)
        };
        let moved = [1, 2, 3, 4].map(moved);
        assert!(moved.iter().all(|moved| (0.01..100.0).contains(&moved.abs())), "{moved:?}");
        assert!(moved[0].to_bits() != moved[1].to_bits() && moved[1].to_bits() != moved[2].to_bits());
    }
}
