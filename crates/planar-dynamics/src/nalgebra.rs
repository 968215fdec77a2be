//! Row-major results as matrices of `nalgebra` (feature `nalgebra`).
//!
//! # Example
//! ```
//! use nalgebra::SVector;
//! use planar_capture::generated::dual_arm_3r::{JOINTS, Model};
//! use planar_dynamics::nalgebra::matrix;
//!
//! let (robot, pose, angles) = (Model::<f64>::default(), [0.0; 3], [0.5; JOINTS]);
//! let mass_matrix = matrix(&robot.mass_matrix(&pose, &angles));
//! let velocity = SVector::from([0.1, 0.0, 0.2, 0.3, 0.3, 0.3, 0.3, 0.3, 0.3]);
//! // the kinetic energy is ½ vᵀ M v
//! let energy = robot.momentum(&pose, &angles, &[0.1, 0.0, 0.2], &[0.3; JOINTS]).kinetic_energy;
//! assert!((0.5 * velocity.dot(&(mass_matrix * velocity)) - energy).abs() < 1e-12);
//! ```

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
