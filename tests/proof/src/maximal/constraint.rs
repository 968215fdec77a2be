//! What holds two bodies together: a pin, or with the angle between them too.

use super::system::System;
use nalgebra::{DMatrix, DVector, Vector2};

/// A point that is fixed to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPoint {
    /// Which.
    pub body: usize,
    /// From its COM, body axes, m.
    pub at: Vector2<f64>,
}

/// Two places coincide; with an angle, yaw of a less yaw of b is that too. Its force acts on a, the opposite on b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tie {
    /// Where the force acts.
    pub a: BodyPoint,
    /// Where the opposite force acts.
    pub b: BodyPoint,
    /// `None` for a pin, which transmits no moment.
    pub angle: Option<f64>,
}

impl Tie {
    /// How many scalar constraints it is.
    pub fn rows(&self) -> usize {
        if self.angle.is_some() { 3 } else { 2 }
    }

    /// How far it is from holding: what should be zero of [yaw, x, y].
    fn residual(&self, all: &System) -> Vec<f64> {
        let apart = all.position(&self.a) - all.position(&self.b);
        let yaw = self.angle.map(|angle| all.bodies[self.a.body].pose[0] - all.bodies[self.b.body].pose[0] - angle);
        yaw.into_iter().chain([apart.x, apart.y]).collect()
    }

    /// d/dt of its rows times the twists: the centripetal accelerations of the two places, −ω² r.
    fn centripetal(&self, all: &System) -> Vec<f64> {
        let inwards = |place: &BodyPoint| {
            let body = &all.bodies[place.body];
            -body.twist[0] * body.twist[0] * body.turned(place.at)
        };
        let difference = inwards(&self.a) - inwards(&self.b);
        self.angle.map(|_| 0.0).into_iter().chain([difference.x, difference.y]).collect()
    }

    /// Its rows of A: A v is the twist of a less that of b at the place, [ω, vx, vy], or the velocity alone.
    fn write(&self, all: &System, a: &mut DMatrix<f64>, first: usize) {
        let point = first + self.rows() - 2;
        for (place, sign) in [(&self.a, 1.0), (&self.b, -1.0)] {
            let arrow = all.bodies[place.body].turned(place.at);
            let column = 3 * place.body;
            if self.angle.is_some() {
                a[(first, column)] = sign;
            }
            a[(point, column)] = -sign * arrow.y;
            a[(point + 1, column)] = sign * arrow.x;
            a[(point, column + 1)] = sign;
            a[(point + 1, column + 2)] = sign;
        }
    }
}

/// A of all ties: with it A v = 0, and Aᵀλ are the forces on all bodies.
pub fn rows(all: &System, ties: &[Tie]) -> DMatrix<f64> {
    let mut a = DMatrix::zeros(ties.iter().map(Tie::rows).sum(), 3 * all.bodies.len());
    let mut first = 0;
    for tie in ties {
        tie.write(all, &mut a, first);
        first += tie.rows();
    }
    a
}

/// Ȧ v.
pub fn centripetal(all: &System, ties: &[Tie]) -> DVector<f64> {
    DVector::from_vec(ties.iter().flat_map(|tie| tie.centripetal(all)).collect())
}

/// How far the ties are from holding.
pub fn residual(all: &System, ties: &[Tie]) -> DVector<f64> {
    DVector::from_vec(ties.iter().flat_map(|tie| tie.residual(all)).collect())
}

/// Multipliers cut into wrenches [n, fx, fy] on each tie's a.
pub fn wrenches(ties: &[Tie], multipliers: &DVector<f64>) -> Vec<[f64; 3]> {
    let mut rest = multipliers.as_slice();
    let mut cut = |tie: &Tie| {
        let (own, others) = rest.split_at(tie.rows());
        rest = others;
        match *own {
            [n, fx, fy] => [n, fx, fy],
            [fx, fy] => [0.0, fx, fy],
            _ => unreachable!("two or three rows"),
        }
    };
    ties.iter().map(&mut cut).collect()
}
