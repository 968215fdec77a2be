//! The base's block of the mass matrix, factored.

use crate::check::pivot;
use crate::error::Error;
use crate::scalar::Real;

/// `I_b = L D Lᵀ`, 3 × 3, written out: it is solved with several right sides, and has no path that panics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BaseInertia<T> {
    /// D.
    pivots: [T; 3],
    /// Of L, below its diagonal: (2, 1), (3, 1), (3, 2).
    lower: [T; 3],
}

impl<T: Real> BaseInertia<T> {
    /// Factors a symmetric matrix.
    ///
    /// # Errors
    /// [`Error::Singular`] where a pivot is no larger than rounding beside its diagonal entry.
    pub(crate) fn new([[xx, ..], [yx, yy, _], [zx, zy, zz]]: &[[T; 3]; 3]) -> Result<Self, Error> {
        let check = |value: T, scale: T| pivot("the base inertia I_b", value / scale);
        check(*xx, *xx)?;
        let (a, b) = (*yx / *xx, *zx / *xx);
        let second = *yy - a * *yx;
        check(second, *yy)?;
        let c = (*zy - a * *zx) / second;
        let third = *zz - b * *zx - c * c * second;
        check(third, *zz)?;
        Ok(Self { pivots: [*xx, second, third], lower: [a, b, c] })
    }

    /// `I_b⁻¹ right`.
    pub(crate) fn solve(&self, right: [T; 3]) -> [T; 3] {
        let Self { pivots: [first, second, third], lower: [yx, zx, zy] } = *self;
        let middle = right[1] - yx * right[0];
        let last = (right[2] - zx * right[0] - zy * middle) / third;
        let middle = middle / second - zy * last;
        [right[0] / first - yx * middle - zx * last, middle, last]
    }
}
