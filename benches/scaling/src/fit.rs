//! Least squares: a + b · links + c · arms.

use crate::shape::Shape;
use nalgebra::{Matrix3, Vector3};

/// A plane fitted to counts.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// Independent of the robot.
    pub constant: f64,
    /// Per link, of whichever arm.
    pub per_link: f64,
    /// Per arm, without its links.
    pub per_arm: f64,
    /// Largest distance of a count from the plane.
    pub residual: f64,
}

impl Fit {
    /// The best plane; `None` if the robots do not determine it.
    pub fn of(points: &[(Shape, u32)]) -> Option<Self> {
        let row = |shape: Shape| Vector3::new(1.0, f64::from(shape.joints()), f64::from(shape.arms));
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        for (shape, count) in points {
            normal += row(*shape) * row(*shape).transpose();
            right += row(*shape) * f64::from(*count);
        }
        let found = normal.cholesky()?.solve(&right);
        let off = points.iter().map(|(shape, count)| (row(*shape).dot(&found) - f64::from(*count)).abs());
        let residual = off.fold(0.0, f64::max);
        Some(Self { constant: found.x, per_link: found.y, per_arm: found.z, residual })
    }

    /// The value of the plane at a robot.
    pub fn at(self, shape: Shape) -> f64 {
        self.constant + self.per_link * f64::from(shape.joints()) + self.per_arm * f64::from(shape.arms)
    }
}

/// The exponent n of the best fit y ∝ xⁿ, linear in logarithms.
pub fn exponent(points: impl Iterator<Item = (f64, f64)> + Clone) -> f64 {
    let logs = points.map(|(x, y)| (x.ln(), y.ln()));
    let [n, x, y, xx, xy] =
        logs.fold([0.0; 5], |s, (x, y)| [s[0] + 1.0, s[1] + x, s[2] + y, s[3] + x * x, s[4] + x * y]);
    (n * xy - x * y) / (n * xx - x * x)
}
