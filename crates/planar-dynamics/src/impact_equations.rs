//! Eqs. (15) and (16) in loops, from generalized inertia and Jacobian: for robots with so many joints that single
//! assignments leave the processor's instruction cache.
//!
//! # Example
//! ```
//! use planar_dynamics::impact_equations::ImpactEquations;
//!
//! // one joint whose end effector moves along y, 2 m from it; a target of 3 kg at rest
//! let equations = ImpactEquations {
//!     generalized_jacobian: &[[1.0], [0.0], [2.0]],
//!     joint_rates: &[0.5],
//!     target_masses: &[3.0],
//!     target_inertias: &[0.0],
//!     contacts: &[[0.0; 2]],
//!     target_twists: &[[0.0; 3]],
//! };
//! let (mut matrix, mut factors, mut momentum, mut rates) = ([[4.0]], [[0.0]], [0.0], [0.0]);
//! let pivot = equations.solve::<false>(&mut matrix, &mut factors, &mut momentum, &mut rates);
//! // G = 4 + 2 · 3 · 2, H = 4 · 0.5
//! assert_eq!((matrix, momentum, rates, pivot), ([[16.0]], [2.0], [0.125], 1.0));
//! ```

use super::scalar::Scalar;

/// What the joint rates after a rigid capture depend on, besides the generalized inertia.
#[derive(Clone, Copy, Debug)]
pub struct ImpactEquations<'a, T, Row> {
    /// J, 3 rows per arm of as many entries as there are joints.
    pub generalized_jacobian: &'a [Row],
    /// Before the impact, arm by arm, rad/s.
    pub joint_rates: &'a [T],
    /// kg, one per arm; a target without mass and inertia is none.
    pub target_masses: &'a [T],
    /// kg m², one per arm.
    pub target_inertias: &'a [T],
    /// [rx, ry] from each target's COM to its contact point, inertial axes, m.
    pub contacts: &'a [[T; 2]],
    /// [ω, vx, vy] of each target's COM before the impact, inertial axes; rad/s, m/s.
    pub target_twists: &'a [[T; 3]],
}

impl<T: Scalar, Row: AsRef<[T]> + AsMut<[T]> + Clone> ImpactEquations<'_, T, Row> {
    /// `G = I + Σ Kᵀ I_t K` and `H = I θ̇ + Σ Kᵀ I_t t_ti` with `K = J_t⁻¹ J`, eq. (16), and the solution of
    /// `G θ̇_f = H`, eq. (15), by `L D Lᵀ` from the last joint to the first. Returns the smallest pivot relative to its
    /// diagonal entry: small or zero: singular, NaN: singular or not finite.
    ///
    /// `matrix` (joints × joints) is the generalized inertia and becomes G; `momentum` becomes H, `joint_rates_after` the
    /// solution. `factors` is working space of the matrix's size. Rows that are arrays are faster than others. Slices of
    /// other lengths are used as far as they reach. `FUSED`: by [`Scalar::mul_add`].
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "it has one caller for each scalar, whose processor's instructions it takes"
    )]
    pub fn solve<const FUSED: bool>(
        &self,
        matrix: &mut [Row],
        factors: &mut [Row],
        momentum: &mut [T],
        joint_rates_after: &mut [T],
    ) -> T {
        for (row, momentum) in matrix.iter().zip(&mut *momentum) {
            let products = row.as_ref().iter().zip(self.joint_rates);
            *momentum = products.fold(T::ZERO, |sum, (inertia, rate)| add::<T, FUSED>(sum, *inertia, *rate));
        }
        let of_targets =
            self.target_masses.iter().zip(self.target_inertias).zip(self.contacts.iter().zip(self.target_twists));
        for (rows, ((mass, inertia), ([x, y], twist))) in self.generalized_jacobian.chunks_exact(3).zip(of_targets) {
            let [angular, ..] = rows else { continue };
            // the contact point moves by v + ω × r: one row of J_t⁻¹ after the other
            let of_rows = [*inertia, *mass, *mass].into_iter().zip([T::ZERO, *y, -*x]).zip(twist);
            for (row, ((weight, lever), velocity)) in rows.iter().zip(of_rows) {
                let mut of_target = row.clone();
                for (entry, angular) in of_target.as_mut().iter_mut().zip(angular.as_ref()) {
                    *entry = add::<T, FUSED>(*entry, lever, *angular);
                }
                let of_joints = matrix.iter_mut().zip(&mut *momentum).zip(of_target.as_ref());
                for (i, ((row, momentum), entry)) in of_joints.enumerate() {
                    let weighted = weight * *entry;
                    *momentum = add::<T, FUSED>(*momentum, weighted, *velocity);
                    add_scaled::<T, FUSED>(row.as_mut(), i + 1, weighted, of_target.as_ref());
                }
            }
        }
        for i in 0..matrix.len() {
            // what is left of the diagonal goes above it
            let Some((above, [row, ..])) = matrix.split_at_mut_checked(i) else { continue };
            for (entries, entry) in above.iter_mut().zip(row.as_ref()) {
                if let Some(place) = entries.as_mut().get_mut(i) {
                    *place = *entry;
                }
            }
        }
        for (place, row) in factors.iter_mut().zip(&*matrix) {
            place.clone_from(row);
        }
        let pivot = factor::<T, Row, FUSED>(matrix, factors);
        for (place, value) in joint_rates_after.iter_mut().zip(&*momentum) {
            *place = *value;
        }
        substitute::<T, Row, FUSED>(factors, joint_rates_after);
        pivot
    }
}

/// `L D Lᵀ` of a symmetric matrix in the place of a copy's lower triangle, from the last row to the first, with `1 / D` on
/// the diagonal. Returns the smallest pivot relative to its diagonal entry.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as for its caller")]
fn factor<T: Scalar, Row: AsRef<[T]> + AsMut<[T]> + Clone, const FUSED: bool>(matrix: &[Row], copy: &mut [Row]) -> T {
    let mut smallest = T::ONE;
    for (k, original) in matrix.iter().enumerate().rev() {
        let Some((above, [row, ..])) = copy.split_at_mut_checked(k) else { continue };
        let column = row.clone();
        let (Some(pivot), Some(diagonal)) = (column.as_ref().get(k), original.as_ref().get(k)) else { continue };
        smallest = smallest.minimum(*pivot / *diagonal);
        let inverse = T::ONE / *pivot;
        for (i, (entries, entry)) in above.iter_mut().zip(column.as_ref()).enumerate() {
            add_scaled::<T, FUSED>(entries.as_mut(), i + 1, -(*entry * inverse), column.as_ref());
        }
        for entry in row.as_mut() {
            *entry = *entry * inverse;
        }
        if let Some(place) = row.as_mut().get_mut(k) {
            *place = inverse;
        }
    }
    smallest
}

/// Solves a system of equations by the factors of [`factor`].
#[inline(always)]
#[allow(clippy::inline_always, reason = "as for its caller")]
fn substitute<T: Scalar, Row: AsRef<[T]>, const FUSED: bool>(factors: &[Row], solution: &mut [T]) {
    for (k, row) in factors.iter().enumerate().rev() {
        if let Some((others, [value, ..])) = solution.split_at_mut_checked(k) {
            add_scaled::<T, FUSED>(others, k, -*value, row.as_ref());
        }
    }
    for (k, row) in factors.iter().enumerate() {
        let row = row.as_ref();
        if let (Some((others, [value, ..])), Some(inverse)) = (solution.split_at_mut_checked(k), row.get(k)) {
            let products = row.iter().zip(others);
            *value = products.fold(*value * *inverse, |sum, (entry, other)| add::<T, FUSED>(sum, -*entry, *other));
        }
    }
}

/// `sum + a b`.
#[inline(always)]
#[allow(clippy::inline_always, reason = "one operation")]
fn add<T: Scalar, const FUSED: bool>(sum: T, a: T, b: T) -> T {
    if FUSED { a.mul_add(b, sum) } else { sum + a * b }
}

/// Adds a multiple of the first elements of a slice to those of another.
#[inline(always)]
#[allow(clippy::inline_always, reason = "as for its callers")]
fn add_scaled<T: Scalar, const FUSED: bool>(sum: &mut [T], length: usize, factor: T, part: &[T]) {
    // as slices of that length, not as iterators that end there: those are not computed in vectors
    if let (Some(sum), Some(part)) = (sum.get_mut(..length), part.get(..length)) {
        for (sum, part) in sum.iter_mut().zip(part) {
            *sum = add::<T, FUSED>(*sum, factor, *part);
        }
    }
}
