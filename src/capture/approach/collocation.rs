//! Quadrature of functions of time at Gauss–Legendre points, from the start of an interval up to each point.

/// Points of one interval.
pub(crate) const POINTS: usize = 8;

/// Positive zeros of the Legendre polynomial of degree 8.
const ZEROS: [f64; POINTS / 2] =
    [0.183_434_642_495_649_8, 0.525_532_409_916_329, 0.796_666_477_413_626_7, 0.960_289_856_497_536_2];

/// 2k + 1.
const ODD: [f64; POINTS] = [1.0, 3.0, 5.0, 7.0, 9.0, 11.0, 13.0, 15.0];

/// Weights of the points of an interval from 0 to 1, and of those up to each point.
pub(crate) struct Collocation {
    /// In order.
    pub(crate) points: [f64; POINTS],
    /// ∫₀¹ of the polynomial through values at the points is their sum with these; exact up to degree 15.
    weights: [f64; POINTS],
    /// Of each point, in the integrals up to all points; exact up to degree 7.
    partial_weights: [[f64; POINTS]; POINTS],
}

impl Collocation {
    /// With the Lagrange polynomial of point j as a sum of Legendre polynomials on −1…1,
    /// `l_j = w_j Σ_k (k + ½) P_k(x_j) P_k`, and `(2k + 1) ∫ P_k = P_{k+1} − P_{k−1}`.
    pub(crate) fn new() -> Self {
        let half = POINTS / 2;
        let zeros: [f64; POINTS] =
            std::array::from_fn(|i| if i < half { -ZEROS[half - 1 - i] } else { ZEROS[i - half] });
        let polynomials = zeros.map(legendre);
        let weights = polynomials.map(|p| {
            let sum: f64 = ODD.iter().zip(p).map(|(odd, p)| odd * p * p).sum();
            1.0 / sum
        });
        let integral = |i: usize, k: usize| {
            let below = if k == 0 { -1.0 } else { polynomials[i][k - 1] };
            polynomials[i][k + 1] - below
        };
        let partial_weights = std::array::from_fn(|j| {
            std::array::from_fn(|i| {
                let sum: f64 = (0..POINTS).map(|k| integral(i, k) * polynomials[j][k]).sum();
                0.5 * weights[j] * sum
            })
        });
        Self { points: zeros.map(|x| 0.5 * (1.0 + x)), weights, partial_weights }
    }

    /// The integrals of a function from its values at the points, up to all points and over the interval, whose length is 1.
    pub(crate) fn integrals(&self, values: &[f64; POINTS]) -> ([f64; POINTS], f64) {
        let (mut partial, mut whole) = ([0.0; POINTS], 0.0);
        for ((value, weight), weights) in values.iter().zip(self.weights).zip(&self.partial_weights) {
            partial.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += weight * value);
            whole += weight * value;
        }
        (partial, whole)
    }
}

/// The polynomials of degrees 0 to 8, by `(k + 1) P_{k+1} = (2k + 1) x P_k − k P_{k−1}`.
fn legendre(x: f64) -> [f64; POINTS + 1] {
    let mut p = [1.0; POINTS + 1];
    p[1] = x;
    for k in 1..POINTS {
        let (twice, odd) = (ODD[k] - 1.0, ODD[k]);
        p[k + 1] = (2.0 * odd * x * p[k] - twice * p[k - 1]) / (twice + 2.0);
    }
    p
}

#[cfg(test)]
mod tests {
    use super::{Collocation, POINTS};

    /// Powers of time up to the degree that is exact, from 0 to 1 and to each point; the next ones are not.
    #[test]
    fn powers_are_integrated() {
        let collocation = Collocation::new();
        let points = collocation.points;
        assert!(points.is_sorted() && points[0] > 0.0 && points[7] < 1.0);
        let errors = |power: i32| {
            let (partial, whole) = collocation.integrals(&points.map(|point| point.powi(power)));
            let error = |sum: f64, to: f64| (sum - to.powi(power + 1) / f64::from(power + 1)).abs();
            (std::array::from_fn::<_, POINTS, _>(|i| error(partial[i], points[i])), error(whole, 1.0))
        };
        for power in 0..16 {
            assert!(errors(power).1 < 1e-15, "{power}");
        }
        assert!(errors(16).1 > 1e-11);
        for power in 0..8 {
            assert!(errors(power).0.iter().all(|error| *error < 1e-15), "{power}");
        }
        assert!(errors(8).0.iter().all(|error| *error > 1e-9));
    }
}
