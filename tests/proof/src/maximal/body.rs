//! One free planar rigid body.

use nalgebra::{Rotation2, Vector2};

/// A free planar rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// About its COM, kg m².
    pub inertia: f64,
    /// [yaw, x, y] of its axes and its COM; a link's x axis points along the link.
    pub pose: [f64; 3],
    /// [ω, vx, vy] of its COM.
    pub twist: [f64; 3],
}

impl Body {
    /// From body axes to inertial ones.
    pub fn turned(&self, vector: Vector2<f64>) -> Vector2<f64> {
        Rotation2::new(self.pose[0]) * vector
    }

    /// Where its COM is.
    pub fn com(&self) -> Vector2<f64> {
        Vector2::new(self.pose[1], self.pose[2])
    }

    /// Velocity of the point of the body that is now `offset` (inertial axes) from its COM: v + ω × r.
    pub fn velocity(&self, offset: Vector2<f64>) -> Vector2<f64> {
        let [omega, vx, vy] = self.twist;
        Vector2::new(vx - omega * offset.y, vy + omega * offset.x)
    }

    /// ½ I ω² + ½ m v².
    pub fn kinetic_energy(&self) -> f64 {
        let [omega, vx, vy] = self.twist;
        0.5 * (self.inertia * omega * omega + self.mass * (vx * vx + vy * vy))
    }

    /// [l, px, py] about the inertial origin.
    pub fn momentum(&self) -> [f64; 3] {
        let [omega, vx, vy] = self.twist;
        let [_, x, y] = self.pose;
        [self.inertia * omega + self.mass * (x * vy - y * vx), self.mass * vx, self.mass * vy]
    }
}
