//! The Gauss–Legendre method with three stages: implicit, symmetric, symplectic.

use crate::error::Error;
use crate::linear::{add_scaled, copy};
use crate::scalar::Real;
use crate::validate::length;

const STAGES: usize = 3;

/// A step that is short enough takes ten.
const MAXIMUM_ITERATIONS: u32 = 60;

/// So many iterations without a smaller change have come to rounding, where the change is small at all: that of light
/// bodies, whose rates are momenta over small masses, is far from the last digit of the vector.
const WITHOUT_GAIN: u32 = 8;

/// ẋ = f(t, x) by Gauss–Legendre steps with three stages (Kuntzmann, Butcher 1964); the global error is O(step⁶).
///
/// The steps preserve every invariant of f that is linear or quadratic in x. Where x are canonical variables they are
/// symplectic, so that the energy error stays bounded over very long times: Hairer, Lubich, Wanner, *Geometric Numerical
/// Integration*, theorems IV.2.1 and VI.4.2. The momenta of a robot are linear and bilinear in
/// [canonical variables](crate::formulation::CanonicalVariables); in other variables, such as rates, this is only a
/// method of order 6.
///
/// The stages are iterated until their change is rounding: an earlier stop would leave an error of one sign, which grows
/// with time. The iteration contracts for steps that are short relative to the fastest motion, that of a stiff control
/// law included. The result depends on `x` alone, not on earlier steps.
#[derive(Debug)]
pub struct GaussLegendre<'a, T> {
    slopes: [&'a mut [T]; STAGES],
    stage: &'a mut [T],
    next: &'a mut [T],
}

/// Nodes c, matrix a and weights b of the method.
struct Tableau<T> {
    nodes: [T; STAGES],
    matrix: [[T; STAGES]; STAGES],
    weights: [T; STAGES],
}

impl<T: Real> Tableau<T> {
    fn new() -> Self {
        const ROOT: f64 = 3.872_983_346_207_417; // √15
        let constant = |row: [f64; STAGES]| row.map(T::constant);
        Self {
            nodes: constant([0.5 - ROOT / 10.0, 0.5, 0.5 + ROOT / 10.0]),
            matrix: [
                constant([5.0 / 36.0, 2.0 / 9.0 - ROOT / 15.0, 5.0 / 36.0 - ROOT / 30.0]),
                constant([5.0 / 36.0 + ROOT / 24.0, 2.0 / 9.0, 5.0 / 36.0 - ROOT / 24.0]),
                constant([5.0 / 36.0 + ROOT / 30.0, 2.0 / 9.0 + ROOT / 15.0, 5.0 / 36.0]),
            ],
            weights: constant([5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0]),
        }
    }
}

impl<'a, T: Real> GaussLegendre<'a, T> {
    /// The length of the workspace over that of the vectors.
    pub const WORKSPACE: usize = STAGES + 2;

    /// An integrator for vectors of a fifth of the workspace's length.
    ///
    /// # Errors
    /// [`Error::Length`] unless the workspace's length is a multiple of 5.
    pub fn new(workspace: &'a mut [T]) -> Result<Self, Error> {
        let n = workspace.len() / Self::WORKSPACE;
        length("integrator workspace", n * Self::WORKSPACE, workspace.len())?;
        let (first, rest) = workspace.split_at_mut(n);
        let (second, rest) = rest.split_at_mut(n);
        let (third, rest) = rest.split_at_mut(n);
        let (stage, next) = rest.split_at_mut(n);
        Ok(Self { slopes: [first, second, third], stage, next })
    }

    /// One step from `time` to `time + step`.
    ///
    /// # Errors
    /// [`Error::Length`] for an `x` of another length than the integrator's vectors, [`Error::NotConverged`] where the
    /// iteration does not contract, and those of `derivative`; `x` is then unchanged.
    pub fn step(
        &mut self,
        time: T,
        step: T,
        x: &mut [T],
        mut derivative: impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        length("state vector", self.next.len(), x.len())?;
        let tableau = Tableau::new();
        derivative(time, x, self.next)?;
        for slope in &mut self.slopes {
            copy(self.next, slope);
        }
        let scale =
            largest_magnitude(x.iter().copied()) + largest_magnitude(self.next.iter().map(|slope| step * *slope));
        let limit = T::constant(1e3) * T::EPSILON * scale;
        let (mut previous, mut iterations) = (None, 0);
        let (mut smallest, mut without_gain) = (scale, 0);
        loop {
            let change = self.iterate(&tableau, time, step, x, &mut derivative)?;
            iterations += 1;
            without_gain = if change < smallest { 0 } else { without_gain + 1 };
            smallest = smallest.minimum(change);
            let last = iterations == MAXIMUM_ITERATIONS;
            let stalled = previous.is_some_and(|previous| change >= previous);
            let is_rounding = without_gain >= WITHOUT_GAIN && change <= T::constant(1e3) * limit;
            if change == T::ZERO || (change <= limit && (stalled || last)) || is_rounding {
                break;
            }
            if last {
                let what = "the stages of a Gauss–Legendre step";
                return Err(Error::NotConverged { what, iterations, change: change.to_f64() });
            }
            previous = Some(change);
        }
        for (slope, weight) in self.slopes.iter().zip(&tableau.weights) {
            add_scaled(x, step * *weight, slope);
        }
        Ok(())
    }

    /// One iteration, each stage with the newest slopes; returns the largest change of the step.
    fn iterate(
        &mut self,
        tableau: &Tableau<T>,
        time: T,
        step: T,
        x: &[T],
        derivative: &mut impl FnMut(T, &[T], &mut [T]) -> Result<(), Error>,
    ) -> Result<T, Error> {
        let mut change = T::ZERO;
        for (i, (node, row)) in tableau.nodes.iter().zip(&tableau.matrix).enumerate() {
            copy(x, self.stage);
            for (slope, entry) in self.slopes.iter().zip(row) {
                add_scaled(self.stage, step * *entry, slope);
            }
            derivative(time + *node * step, self.stage, self.next)?;
            let Some(slope) = self.slopes.get_mut(i) else { continue };
            let of_stage = largest_magnitude(self.next.iter().zip(slope.iter()).map(|(new, old)| step * (*new - *old)));
            change = change.maximum(of_stage);
            copy(self.next, slope);
        }
        Ok(change)
    }
}

fn largest_magnitude<T: Real>(values: impl Iterator<Item = T>) -> T {
    values.fold(T::ZERO, |largest, value| largest.maximum(value.abs()))
}

#[cfg(test)]
mod tests {
    use super::Tableau;

    /// The conditions of the method, which determine all its numbers: with the exponents q below the number of stages,
    /// Σ aᵢⱼ cⱼ^q = cᵢ^(q+1) / (q + 1), and below twice as many Σ bⱼ cⱼ^q = 1 / (q + 1).
    #[test]
    fn the_tableau_has_the_order_of_collocation() {
        let Tableau { nodes, matrix, weights } = Tableau::<f64>::new();
        let integral = |row: [f64; 3], q: i32| row.iter().zip(nodes).map(|(a, c)| a * c.powi(q)).sum::<f64>();
        for q in 0..6 {
            let exact = 1.0 / f64::from(q + 1);
            assert!((integral(weights, q) - exact).abs() < 1e-15, "weights, {q}");
            for (row, node) in matrix.into_iter().zip(nodes).filter(|_| q < 3) {
                assert!((integral(row, q) - node.powi(q + 1) * exact).abs() < 1e-15, "{row:?}, {q}");
            }
        }
    }
}
