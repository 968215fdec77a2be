//! Row-major results as matrices of `nalgebra` (feature `nalgebra`).

use nalgebra::{SMatrix, Scalar};

/// A matrix from its rows. `SMatrix::from` takes columns, and so gives the transpose.
#[must_use]
pub fn matrix<T: Scalar, const R: usize, const C: usize>(rows: &[[T; C]; R]) -> SMatrix<T, R, C> {
    SMatrix::from_row_slice(rows.as_flattened())
}

#[cfg(test)]
mod tests {
    use super::matrix;

    #[test]
    fn rows_stay_rows() {
        let matrix = matrix(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
        assert_eq!((matrix.shape(), matrix[(0, 1)], matrix[(1, 0)]), ((2, 3), 2.0, 4.0));
    }
}
