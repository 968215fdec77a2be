//! Solution of the KKT system of free bodies under bilateral constraints, from masses and constraint Jacobian.

use super::constraint::{Constraint, jacobian};
use super::system::System;
use nalgebra::{DMatrix, DVector};

/// A unit row closer than this to the span of the rows before it depends on them.
const DEPENDENT: f64 = 1e-10;

/// [M −Aᵀ; A 0] [x; λ] = [f; g], decomposed for one set of constraints at one configuration.
///
/// With B = D A M^(−½), where D scales the rows to length one, the system is w − Bᵀλ' = M^(−½) f, B w = D g with
/// w = M^½ x, λ' = D⁻¹ λ. It is solved by B = L Q, with orthonormal rows in Q and L lower triangular. A M⁻¹ Aᵀ, whose
/// condition is the square, is never formed. Each row is made orthogonal to those before it twice, which is enough
/// (Kahan; Parlett). (nalgebra's `svd` is not used: for some matrices with the wheel's zeros its U Σ Vᵀ differs from
/// the matrix.)
pub struct KktSystem {
    /// M^½, a diagonal.
    root: DVector<f64>,
    /// D.
    scale: DVector<f64>,
    /// Rows of Q.
    q: Vec<Vec<f64>>,
    /// Rows of L.
    l: Vec<Row>,
    /// Some rows depend on rows before them; their multipliers are zero.
    pub redundant: bool,
    /// Smallest distance of an independent unit row from the span of the rows before it.
    pub margin: f64,
}

/// A row of B that does not depend on those before it, as a combination of the rows of Q.
struct Row {
    /// Index in B.
    index: usize,
    /// One per row of Q up to its own.
    coefficients: Vec<f64>,
}

impl KktSystem {
    /// Of all bodies under these constraints.
    pub fn new(all: &System, constraints: &[Constraint]) -> Self {
        let root = all.masses().map(f64::sqrt);
        Self::decompose(&jacobian(&all.bodies, constraints), root)
    }

    /// Of any A and M^½.
    fn decompose(a: &DMatrix<f64>, root: DVector<f64>) -> Self {
        let mut scale = DVector::zeros(a.nrows());
        let (mut q, mut l): (Vec<Vec<f64>>, Vec<Row>) = (vec![], vec![]);
        let mut margin = 1.0_f64;
        for i in 0..a.nrows() {
            let mut row: Vec<f64> = a.row(i).iter().zip(&root).map(|(a, root)| a / root).collect();
            scale[i] = 1.0 / norm(&row);
            for x in &mut row {
                *x *= scale[i];
            }
            let mut coefficients = vec![0.0; q.len()];
            for _ in 0..2 {
                for (q, sum) in q.iter().zip(&mut coefficients) {
                    let share = dot(q, &row);
                    if share != 0.0 {
                        row.iter_mut().zip(q).for_each(|(x, q)| *x -= share * q);
                        *sum += share;
                    }
                }
            }
            let rest = norm(&row);
            if rest > DEPENDENT {
                margin = margin.min(rest);
                for x in &mut row {
                    *x /= rest;
                }
                q.push(row);
                coefficients.push(rest);
                l.push(Row { index: i, coefficients });
            }
        }
        Self { redundant: l.len() < a.nrows(), margin, root, scale, q, l }
    }

    /// x and λ for forces (or momenta) f and a right side g of the constraints.
    pub fn solve(&self, f: &DVector<f64>, g: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let force: Vec<f64> = f.iter().zip(&self.root).map(|(f, root)| f / root).collect();
        // L z = D g for z = Q w, forwards
        let mut z: Vec<f64> = vec![];
        for Row { index, coefficients } in &self.l {
            let known = dot(&coefficients[..z.len()], &z);
            z.push((g[*index] * self.scale[*index] - known) / coefficients[z.len()]);
        }
        // w = f' + Qᵀ (z − Q f'), Lᵀ λ' = z − Q f', backwards
        let mut w = force.clone();
        let mut change: Vec<f64> = z.iter().zip(&self.q).map(|(z, q)| z - dot(q, &force)).collect();
        for (change, q) in change.iter().zip(&self.q) {
            w.iter_mut().zip(q).for_each(|(w, q)| *w += change * q);
        }
        let mut multipliers = DVector::zeros(self.scale.len());
        for (k, Row { index, coefficients }) in self.l.iter().enumerate().rev() {
            let multiplier = change[k] / coefficients[k];
            change.iter_mut().zip(coefficients).for_each(|(change, l)| *change -= multiplier * l);
            multipliers[*index] = multiplier * self.scale[*index];
        }
        (DVector::from_vec(w).component_div(&self.root), multipliers)
    }

    /// The twists that satisfy the constraints and are nearest to the given ones in the metric of kinetic energy, and
    /// the constraint impulses.
    pub fn project_twists(&self, twists: &DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let momentum = twists.component_mul(&self.root).component_mul(&self.root);
        self.solve(&momentum, &DVector::zeros(self.scale.len()))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
