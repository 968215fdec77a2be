//! The Gauss–Legendre method of three stages: implicit, symmetric, symplectic.

use crate::error::Error;
use crate::linear::copy;
use crate::scalar::Real;
use crate::validate::length;

const STAGES: usize = 3;

/// Rounds of iteration before giving up; a step that is short enough takes ten.
const MOST_ROUNDS: usize = 60;

/// ẋ = f(t, x) by Gauss–Legendre steps of three stages (Kuntzmann, Butcher 1964); the global error is O(step⁶).
///
/// Every invariant of f that is linear or quadratic in x is one of the steps, and where x are canonical variables the
/// steps are symplectic, so that the energy error stays bounded over very long times: Hairer, Lubich, Wanner,
/// *Geometric Numerical Integration*, theorems IV.2.1 and VI.4.2. The momenta of a robot are linear and bilinear in
/// canonical variables, see [`Canonical`](crate::formulation::Canonical); in others, such as rates, this is just a
/// method of order 6.
///
/// The stages are solved by iteration until they no longer change but by rounding: a looser stop would be an error of
/// one sign, which grows with time. It contracts for steps that are short beside the fastest motion; that of a stiff
/// control law counts. The result depends on nothing but `x`.
#[derive(Debug)]
pub struct GaussLegendre<'a, T> {
    slopes: [&'a mut [T]; STAGES],
    stage: &'a mut [T],
    next: &'a mut [T],
}

/// Nodes, and the matrix of the method: c and a; the weights are 5/18, 4/9, 5/18.
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
    /// How many times its vectors' length the workspace is long.
    pub const WORKSPACE: usize = STAGES + 2;

    /// An integrator for vectors of a fifth of the workspace's length.
    ///
    /// # Errors
    /// [`Error::Length`] where that is not whole.
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
    /// [`Error::Length`] where `x` is not as long as the integrator's vectors, [`Error::Unsettled`] where the iteration
    /// does not contract, and what `derivative` says; `x` is then as it was.
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
        let scale = largest(x.iter().copied()) + largest(self.next.iter().map(|slope| step * *slope));
        let limit = T::constant(1e3) * T::EPSILON * scale;
        let mut before = None;
        for round in 1.. {
            let change = self.round(&tableau, time, step, x, &mut derivative)?;
            let stalled = before.is_some_and(|before| change >= before);
            if change == T::ZERO || (change <= limit && stalled) {
                break;
            }
            if round == MOST_ROUNDS {
                if change <= limit {
                    break;
                }
                let what = "the stages of a Gauss–Legendre step";
                return Err(Error::Unsettled { what, rounds: round, change: change.to_f64() });
            }
            before = Some(change);
        }
        let slopes = self.slopes.iter().zip(&tableau.weights);
        for (slope, weight) in slopes {
            add(x, step * *weight, slope);
        }
        Ok(())
    }

    /// One round of iteration, each stage with the newest slopes; the largest change of the step.
    fn round(
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
                add(self.stage, step * *entry, slope);
            }
            derivative(time + *node * step, self.stage, self.next)?;
            let Some(slope) = self.slopes.get_mut(i) else { continue };
            let of_stage = largest(self.next.iter().zip(slope.iter()).map(|(new, old)| step * (*new - *old)));
            change = if of_stage > change { of_stage } else { change };
            copy(self.next, slope);
        }
        Ok(change)
    }
}

fn add<T: Real>(sum: &mut [T], factor: T, part: &[T]) {
    for (sum, part) in sum.iter_mut().zip(part) {
        *sum += factor * *part;
    }
}

fn largest<T: Real>(values: impl Iterator<Item = T>) -> T {
    values.fold(T::ZERO, |most, value| if value.abs() > most { value.abs() } else { most })
}
