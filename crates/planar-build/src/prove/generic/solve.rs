//! Dense symmetric positive definite systems.

use nalgebra::{Cholesky, DMatrix, Dyn};
use planar_dynamics::error::Error;
use planar_dynamics::validate::{finite, pivot};

/// The Cholesky factorisation A = L Lᵀ.
///
/// # Errors
/// [`Error::NotFinite`]; [`Error::Singular`] with the smallest pivot `L_kk²` over `A_kk`, or 0 where the factorisation
/// met a pivot that is not positive.
pub fn factor(what: &'static str, matrix: &DMatrix<f64>) -> Result<Cholesky<f64, Dyn>, Error> {
    finite(what, matrix.as_slice())?;
    let limit = 8.0 * f64::EPSILON;
    let factors = matrix.clone().cholesky().ok_or(Error::Singular { what, pivot: 0.0, limit })?;
    let lower = factors.l_dirty();
    let ratios = (0..matrix.nrows()).map(|k| lower[(k, k)] * lower[(k, k)] / matrix[(k, k)]);
    pivot(what, ratios.fold(1.0, f64::min))?;
    Ok(factors)
}
