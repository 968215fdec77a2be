//! Constraints between two bodies: their Jacobian, centripetal term and residual, from poses and twists.

use super::body::{Body, BodyPoint};
use nalgebra::{DMatrix, DVector};

/// Two points coincide. With an angle, yaw of a's body less yaw of b's body equals it too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// Where the constraint force acts.
    pub a: BodyPoint,
    /// Where the opposite force acts.
    pub b: BodyPoint,
    /// rad; `None` for a pin, which transmits no moment.
    pub angle: Option<f64>,
}

impl Constraint {
    /// Number of scalar constraints.
    pub fn rows(&self) -> usize {
        if self.angle.is_some() { 3 } else { 2 }
    }

    /// Violation of [yaw, x, y], or of [x, y]; rad, m.
    fn residual(&self, bodies: &[Body]) -> Vec<f64> {
        let gap = self.a.position(bodies) - self.b.position(bodies);
        let yaw = self.angle.map(|angle| bodies[self.a.body].pose[0] - bodies[self.b.body].pose[0] - angle);
        yaw.into_iter().chain([gap.x, gap.y]).collect()
    }

    /// Ȧ v of its rows: the difference of the centripetal accelerations −ω² r of the two points.
    fn centripetal(&self, bodies: &[Body]) -> Vec<f64> {
        let acceleration = |point: &BodyPoint| -bodies[point.body].twist[0].powi(2) * point.lever_arm(bodies);
        let difference = acceleration(&self.a) - acceleration(&self.b);
        self.angle.map(|_| 0.0).into_iter().chain([difference.x, difference.y]).collect()
    }

    /// Writes its rows of A: A v is the twist of a less that of b at the point, [ω, vx, vy], or the velocity alone.
    fn write(&self, bodies: &[Body], a: &mut DMatrix<f64>, first: usize) {
        let linear = first + self.rows() - 2;
        for (point, sign) in [(&self.a, 1.0), (&self.b, -1.0)] {
            let arm = point.lever_arm(bodies);
            let column = 3 * point.body;
            if self.angle.is_some() {
                a[(first, column)] = sign;
            }
            a[(linear, column)] = -sign * arm.y;
            a[(linear + 1, column)] = sign * arm.x;
            a[(linear, column + 1)] = sign;
            a[(linear + 1, column + 2)] = sign;
        }
    }
}

/// Constraint Jacobian A: A v = 0, and Aᵀλ are the constraint forces on all bodies.
pub fn jacobian(bodies: &[Body], constraints: &[Constraint]) -> DMatrix<f64> {
    let mut a = DMatrix::zeros(constraints.iter().map(Constraint::rows).sum(), 3 * bodies.len());
    let mut first = 0;
    for constraint in constraints {
        constraint.write(bodies, &mut a, first);
        first += constraint.rows();
    }
    a
}

/// Ȧ v.
pub fn centripetal(bodies: &[Body], constraints: &[Constraint]) -> DVector<f64> {
    DVector::from_vec(constraints.iter().flat_map(|constraint| constraint.centripetal(bodies)).collect())
}

/// Violation of the constraints, rad, m.
pub fn residual(bodies: &[Body], constraints: &[Constraint]) -> DVector<f64> {
    DVector::from_vec(constraints.iter().flat_map(|constraint| constraint.residual(bodies)).collect())
}

/// Multipliers as wrenches [n, fx, fy] on each constraint's a.
pub fn wrenches(constraints: &[Constraint], multipliers: &DVector<f64>) -> Vec<[f64; 3]> {
    let mut rest = multipliers.as_slice();
    let mut wrench = |constraint: &Constraint| {
        let (own, others) = rest.split_at(constraint.rows());
        rest = others;
        match *own {
            [n, fx, fy] => [n, fx, fy],
            [fx, fy] => [0.0, fx, fy],
            _ => unreachable!("two or three rows"),
        }
    };
    constraints.iter().map(&mut wrench).collect()
}
