//! Solves damped least-squares problems by one-sided Jacobi rotations.

use super::{add_scaled, dot, matrix_rows, matrix_rows_mut};
use crate::scalar::{Real, Scalar};

/// Orthogonalisation converges quadratically, in six to ten sweeps.
const MAXIMUM_SWEEPS: u32 = 30;

/// Makes the rows of A (each `columns` long) orthogonal by rotations Q that are applied to b (`right`, one per row)
/// too, so that `Q A = Σ Vᵀ`; then fills `solution` (columns) with the damped least-squares solution of `A x = b`,
///
/// ```text
/// x = Σᵢ vᵢ (Q b)ᵢ σᵢ / (σᵢ² + λᵢ²),   λᵢ² = (threshold σ_max)² − σᵢ² where that is positive, otherwise 0
/// ```
///
/// It is the shortest solution where no singular value is below `threshold` (0 to 1) times the largest; otherwise its
/// norm is at most |b| over that bound. Returns the ratio of the smallest singular value to the largest, 0 for A = 0.
///
/// One-sided Jacobi rotations (M. R. Hestenes, *Inversion of matrices by biorthogonalization and related results*,
/// 1958) do not form `A Aᵀ`, so that small singular values keep their digits in `f32` too. The damping below a threshold
/// follows Y. Nakamura and H. Hanafusa (*Inverse kinematic solutions with singularity robustness*, 1986), but acts on
/// each singular direction separately.
pub(crate) fn least_squares<T: Real>(
    rows: &mut [T],
    right: &mut [T],
    columns: usize,
    threshold: T,
    solution: &mut [T],
) -> T {
    let columns = columns.max(1);
    for _ in 0..MAXIMUM_SWEEPS {
        if !sweep(rows, right, columns) {
            break;
        }
    }
    let size = |row: &[T]| dot(row, row);
    let sizes = || matrix_rows(rows, columns).map(size);
    let largest = sizes().fold(T::ZERO, T::maximum);
    let smallest = sizes().fold(largest, T::minimum);
    solution.fill(T::ZERO);
    let floor = threshold * threshold * largest;
    if largest == T::ZERO {
        return T::ZERO;
    }
    for (row, right) in matrix_rows(rows, columns).zip(right.iter()) {
        let bounded = floor.maximum(size(row));
        if bounded > T::ZERO {
            add_scaled(solution, *right / bounded, row);
        }
    }
    Scalar::sqrt(smallest / largest)
}

/// Makes every pair of rows orthogonal by a rotation, once; returns whether any pair was not.
fn sweep<T: Real>(rows: &mut [T], right: &mut [T], columns: usize) -> bool {
    let mut changed = false;
    for i in 0..right.len() {
        let Some((before, rest)) = rows.split_at_mut_checked((i + 1) * columns) else { return changed };
        let Some((_, first)) = before.split_at_mut_checked(i * columns) else { return changed };
        let Some((b_before, b_rest)) = right.split_at_mut_checked(i + 1) else { return changed };
        let Some(b_first) = b_before.last_mut() else { return changed };
        for (second, b_second) in matrix_rows_mut(rest, columns).zip(b_rest) {
            let (alpha, beta, gamma) = (dot(first, &*first), dot(second, &*second), dot(first, &*second));
            let oblique = gamma.abs() > T::EPSILON * Scalar::sqrt(alpha * beta);
            if !oblique {
                continue;
            }
            changed = true;
            let zeta = (beta - alpha) / (gamma + gamma);
            let tangent = T::ONE / (zeta.abs() + Scalar::sqrt(T::ONE + zeta * zeta));
            let tangent = if zeta < T::ZERO { -tangent } else { tangent };
            let cosine = T::ONE / Scalar::sqrt(T::ONE + tangent * tangent);
            let sine = cosine * tangent;
            let pairs = first.iter_mut().zip(second.iter_mut());
            for (a, b) in pairs.chain(core::iter::once((&mut *b_first, b_second))) {
                (*a, *b) = (cosine * *a - sine * *b, sine * *a + cosine * *b);
            }
        }
    }
    changed
}

#[cfg(test)]
mod tests {
    use super::least_squares;

    const A: [f64; 8] = [1.0, 2.0, 3.0, 4.0, -2.0, 0.5, 1.0, -1.0];

    /// Against the normal equations, by hand: x = Aᵀ (A Aᵀ)⁻¹ b.
    #[test]
    fn the_shortest_solution() {
        let (mut a, mut b, mut x) = (A, [3.0, -1.0], [0.0_f64; 4]);
        let margin = least_squares(&mut a, &mut b, 4, 0.02, &mut x);
        // A Aᵀ = [[30, −2], [−2, 6.25]], inverse times b = (3, −1)
        let determinant: f64 = 30.0 * 6.25 - 4.0;
        let y = [(6.25 * 3.0 - 2.0) / determinant, (2.0 * 3.0 - 30.0) / determinant];
        for (column, x) in x.iter().enumerate() {
            assert!((x - (A[column] * y[0] + A[4 + column] * y[1])).abs() < 1e-15, "{x}");
        }
        let (half, root) = (36.25 / 2.0, (36.25_f64 * 36.25 / 4.0 - determinant).sqrt());
        assert!((margin - ((half - root) / (half + root)).sqrt()).abs() < 1e-15, "{margin}");
    }

    /// Rows that are nearly equal: the component along their difference is damped, the other is not.
    #[test]
    fn a_singular_direction_is_damped_alone() {
        let small = 1e-4;
        let (mut a, mut b, mut x) = ([1.0, 0.0, 1.0, small], [1.0, 1.0 + small], [0.0_f64; 2]);
        let margin = least_squares(&mut a, &mut b, 2, 0.1, &mut x);
        assert!((margin - small / 2.0).abs() < 1e-8, "{margin}");
        // undamped it is (1, 1): along the small singular vector, (0, 1) nearly, σ²/(0.1 σ_max)² = 0.0025² of it is
        // left
        assert!((x[0] - 1.0).abs() < 1e-4 && x[1].abs() < 1e-4, "{x:?}");
        assert!(least_squares(&mut [0.0; 4], &mut [1.0; 2], 2, 0.1, &mut x) <= 0.0);
        assert!(x.iter().all(|x| x.abs() <= 0.0), "{x:?}");
    }
}
