//! The factor by which a system of equations amplifies rounding errors, from its matrix.

use nalgebra::{DMatrix, DVector};

/// A x = b, symmetric and positive definite, with the sizes Â of A's entries; D = diag Â.
///
/// Rounding A by ε Â and b by ε b̂ moves D^½ x by at most ε/λ (‖D^-½ b̂‖ + ‖D^-½ Â D^-½‖ ‖D^½ x‖), λ the smallest
/// eigenvalue of D^-½ A D^-½: hence the condition number and the sizes of x.
pub struct System<'a> {
    pub sizes: &'a DMatrix<f64>,
    pub matrix: &'a DMatrix<f64>,
}

impl System<'_> {
    /// Largest eigenvalue of D^-½ Â D^-½ over the smallest of D^-½ A D^-½; infinite where that is not positive.
    pub fn condition(&self) -> f64 {
        let (largest, smallest) = (self.eigenvalues(self.sizes).max(), self.eigenvalues(self.matrix).min());
        if smallest > 0.0 { largest / smallest } else { f64::INFINITY }
    }

    fn eigenvalues(&self, matrix: &DMatrix<f64>) -> DVector<f64> {
        let root = self.roots();
        let size = root.len();
        DMatrix::from_fn(size, size, |i, j| matrix[(i, j)] / (root[i] * root[j])).symmetric_eigenvalues()
    }

    /// D^½.
    fn roots(&self) -> DVector<f64> {
        self.sizes.diagonal().map(f64::sqrt)
    }

    /// ‖D^-½ b̂‖.
    pub fn norm(&self, right: &DVector<f64>) -> f64 {
        right.component_div(&self.roots()).norm()
    }

    /// Sizes of the solution: D^-½ (‖D^-½ b̂‖ + ‖D^½ x‖).
    pub fn solution_sizes(&self, right: &DVector<f64>, solution: &[f64]) -> Vec<f64> {
        let roots = self.roots();
        let solution = DVector::from_column_slice(solution);
        let norm = self.norm(right) + solution.component_mul(&roots).norm();
        roots.iter().map(|root| norm / root).collect()
    }
}
