//! Solves general systems of equations by elimination, with the pivot that is largest relative to its row.

use super::{add_scaled, check_pivot, matrix_rows, matrix_rows_mut};
use crate::error::Error;
use crate::scalar::Real;

/// The smallest pivot relative to the largest entry of its row, in units of ε. Dependent equations leave a few ε.
const SMALLEST_PIVOT: f64 = 64.0;

/// Solves `A x = b` from the rows [a | b]; then b is x, and A is destroyed. `scales` has one number per row.
///
/// Rows of different units and orders of magnitude are no loss: the choice of a pivot does not depend on the scale of a
/// row.
///
/// # Errors
/// [`Error::Singular`] unless every pivot is larger than 64 ε times the largest entry of its row.
pub(crate) fn eliminate<T: Real>(what: &'static str, rows: &mut [T], scales: &mut [T]) -> Result<(), Error> {
    let size = scales.len();
    let width = size + 1;
    for (scale, row) in scales.iter_mut().zip(matrix_rows(rows, width)) {
        *scale = row.iter().take(size).fold(T::ZERO, |most, entry| most.maximum(entry.abs()));
    }
    for i in 0..size {
        let (Some((_, rest)), Some((_, scales))) =
            (rows.split_at_mut_checked(i * width), scales.split_at_mut_checked(i))
        else {
            continue;
        };
        let largest = exchange(i, rest, scales, width);
        check_pivot(what, largest, SMALLEST_PIVOT)?;
        let Some((pivot_row, others)) = rest.split_at_mut_checked(width) else { continue };
        let Some([pivot, known @ ..]) = pivot_row.get(i..) else { continue };
        for row in matrix_rows_mut(others, width) {
            if let Some([entry, entries @ ..]) = row.get_mut(i..) {
                add_scaled(entries, -(*entry / *pivot), known);
            }
        }
    }
    for i in (0..size).rev() {
        let Some((above, [row @ .., right])) =
            rows.get_mut(..(i + 1) * width).and_then(|r| r.split_at_mut_checked(i * width))
        else {
            continue;
        };
        if let Some(pivot) = row.get(i) {
            *right /= *pivot;
        }
        for row in matrix_rows_mut(above, width) {
            if let [entries @ .., value] = row
                && let Some(entry) = entries.get(i)
            {
                *value -= *entry * *right;
            }
        }
    }
    Ok(())
}

/// Exchanges the first row with that of the largest entry in column i relative to its scale, and returns this.
fn exchange<T: Real>(i: usize, rows: &mut [T], scales: &mut [T], width: usize) -> T {
    let relative = |(row, scale): (&[T], &T)| row.get(i).map_or(T::ZERO, |entry| entry.abs() / *scale);
    let (mut best, mut largest) = (0, T::ZERO);
    for (k, value) in matrix_rows(rows, width).zip(scales.iter()).map(relative).enumerate() {
        if value > largest {
            (best, largest) = (k, value);
        }
    }
    let mut all = matrix_rows_mut(rows, width).zip(scales.iter_mut());
    if best > 0
        && let (Some((first, first_scale)), Some((other, other_scale))) = (all.next(), all.nth(best - 1))
    {
        core::mem::swap(first_scale, other_scale);
        for (a, b) in first.iter_mut().zip(other) {
            core::mem::swap(a, b);
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::eliminate;
    use crate::error::Error;

    /// [a | b] with x = [1, 2, 3]; rows and columns of very different scales, a zero on the diagonal.
    #[test]
    fn scales_of_rows_do_not_matter() {
        for scale in [1e-200, 1e-9, 1.0, 1e9, 1e200] {
            let mut rows = [0.0, 2.0, 1.0, 7.0, 1.0, 1e-12, -1.0, -2.0 + 2e-12, 3.0, 1.0, 1.0, 8.0_f64];
            for entry in &mut rows[4..8] {
                *entry *= scale;
            }
            assert_eq!(eliminate("A", &mut rows, &mut [0.0; 3]), Ok(()));
            for (found, expected) in [rows[3], rows[7], rows[11]].into_iter().zip([1.0, 2.0, 3.0]) {
                assert!((found - expected).abs() < 4e-15, "{scale:e}: {found}");
            }
        }
    }

    #[test]
    fn dependent_equations_are_rejected() {
        for mut rows in [[1.0, 2.0, 3.0, 1e-9, 2e-9, 1.0], [0.0; 6], [1.0, f64::NAN, 1.0, 1.0, 2.0, 1.0]] {
            let result = eliminate("A", &mut rows, &mut [0.0; 2]);
            assert!(matches!(result, Err(Error::Singular { what: "A", .. })), "{rows:?}: {result:?}");
        }
    }
}
