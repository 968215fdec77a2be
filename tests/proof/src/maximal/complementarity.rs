//! Linear complementarity problem p ≥ 0, u + W p ≥ 0, p·(u + W p) = 0, by enumeration of the active sets.

use nalgebra::{DMatrix, DVector};

/// W⁻¹ times a right side for a symmetric positive semidefinite W; `None` where a pivot is at most `floor`.
fn solved(w: DMatrix<f64>, right: &DVector<f64>, floor: f64) -> Option<DVector<f64>> {
    let factor = w.cholesky()?;
    let smallest = factor.l_dirty().diagonal().iter().fold(f64::INFINITY, |least: f64, l| least.min(l * l));
    (smallest > floor).then(|| factor.solve(right))
}

/// Whether W p determines p.
pub fn is_definite(w: &DMatrix<f64>, floor: f64) -> bool {
    w.is_empty() || solved(w.clone(), &DVector::zeros(w.nrows()), floor).is_some()
}

/// The solution p for a symmetric positive semidefinite W, with pivots up to `floor` taken for zeros; `size` is the scale
/// of the velocities whose difference is u.
///
/// For every subset S, u + W p = 0 is solved on S with p = 0 elsewhere; the p with the smallest violation of the other
/// conditions is returned. W p is unique. Where W is singular p need not be unique, but a solution with a regular block
/// of W exists (Cottle, Pang & Stone, The Linear Complementarity Problem, 3.1 and 4.4).
pub fn complementary(w: &DMatrix<f64>, u: &DVector<f64>, floor: f64, size: f64) -> DVector<f64> {
    let count = u.len();
    assert!(count < 16, "2^{count} sets are too many");
    let mut best = (f64::INFINITY, DVector::zeros(count));
    for set in 0..1_u32 << count {
        let active: Vec<usize> = (0..count).filter(|i| set >> i & 1 == 1).collect();
        let mut p = DVector::zeros(count);
        if !active.is_empty() {
            let block = w.select_rows(&active).select_columns(&active);
            let Some(pushes) = solved(block, &-u.select_rows(&active), floor) else { continue };
            for (i, push) in active.iter().zip(&pushes) {
                p[*i] = *push;
            }
        }
        let after = u + w * &p;
        let violation = (0..count).fold(0.0, |most: f64, i| {
            // impulses are compared as velocities
            let pulls = -p[i] * w[(i, i)];
            let open = if active.contains(&i) { after[i].abs() } else { -after[i] };
            most.max(pulls).max(open)
        });
        if violation < best.0 {
            best = (violation, p);
        }
    }
    assert!(best.0 <= 1e-9 * size, "no set is complementary: the best violates by {:e} of {size:e}", best.0);
    best.1
}
