//! Eq. (17): the base twist from the momentum and the joint rates.

use crate::error::Error;
use crate::linear::{copy, dot, factor, matrix_rows, matrix_rows_mut, substitute};
use crate::scalar::Real;

/// The base's rows `[I_b I_bm]` of a mass matrix, with `I_b` factored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MomentumEquation<'a, T> {
    /// Three rows of 3 + joints.
    rows: &'a [T],
    /// Of `I_b`.
    factors: [T; 9],
}

impl<'a, T: Real> MomentumEquation<'a, T> {
    /// From a mass matrix, (3 + joints)².
    ///
    /// # Errors
    /// [`Error::Singular`] for a singular `I_b`; [`Error::Length`] for fewer than three rows.
    pub(crate) fn new(mass_matrix: &'a [T], joints: usize) -> Result<Self, Error> {
        let wrong =
            Error::Length { quantity: "mass_matrix", expected: (3 + joints) * (3 + joints), found: mass_matrix.len() };
        let rows = mass_matrix.get(..3 * (3 + joints)).ok_or(wrong)?;
        let mut factors = [T::ZERO; 9];
        for (place, row) in matrix_rows_mut(&mut factors, 3).zip(matrix_rows(rows, 3 + joints)) {
            copy(row, place);
        }
        factor("the base inertia I_b", &mut factors, 3)?;
        Ok(Self { rows, factors })
    }

    /// `I_b⁻¹ right`.
    pub(crate) fn solve(&self, mut right: [T; 3]) -> [T; 3] {
        substitute(&self.factors, &mut right);
        right
    }

    /// `I_b⁻¹ (right − I_bm joints)`, for rates or accelerations of the joints.
    pub(crate) fn solve_with_joints<I: Iterator<Item = T>>(&self, mut right: [T; 3], joints: impl Fn() -> I) -> [T; 3] {
        for (right, row) in right.iter_mut().zip(matrix_rows(self.rows, self.rows.len() / 3)) {
            if let Some((_, row)) = row.split_first_chunk::<3>() {
                *right -= dot(row, joints());
            }
        }
        self.solve(right)
    }

    /// Eq. (17), `I_b t_b = [l − c_o × p; p] − I_bm θ̇`: the base twist from the momentum [l, px, py] about the inertial
    /// origin and the joint rates. The order of the right-hand side is that of the base twist, [ω; v].
    pub(crate) fn base_twist(&self, [l, px, py]: [T; 3], base_pose: &[T; 3], joint_rates: &[T]) -> [T; 3] {
        let [_, x, y] = *base_pose;
        self.solve_with_joints([l - (x * py - y * px), px, py], || joint_rates.iter().copied())
    }
}
