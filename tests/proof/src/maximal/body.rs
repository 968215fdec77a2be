//! A free planar rigid body, and points that are fixed to it.

use nalgebra::{Rotation2, Vector2};

/// A free planar rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// kg.
    pub mass: f64,
    /// About its COM, kg m².
    pub inertia: f64,
    /// [yaw, x, y]: yaw of its axes, position of its COM; a link's x axis points along the link.
    pub pose: [f64; 3],
    /// [ω, vx, vy] of its COM.
    pub twist: [f64; 3],
}

impl Body {
    /// A vector in body axes, rotated to inertial axes.
    pub fn rotated(&self, vector: Vector2<f64>) -> Vector2<f64> {
        Rotation2::new(self.pose[0]) * vector
    }

    /// Position of its COM.
    pub fn com(&self) -> Vector2<f64> {
        Vector2::new(self.pose[1], self.pose[2])
    }

    /// Velocity of the point at `lever_arm` from its COM, inertial axes: v + ω × r.
    pub fn velocity(&self, lever_arm: Vector2<f64>) -> Vector2<f64> {
        let [omega, vx, vy] = self.twist;
        Vector2::new(vx - omega * lever_arm.y, vy + omega * lever_arm.x)
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

/// A point that is fixed to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPoint {
    /// Index of the body.
    pub body: usize,
    /// From the body's COM, body axes, m.
    pub offset: Vector2<f64>,
}

impl BodyPoint {
    /// From the body's COM to the point, inertial axes, m.
    pub fn lever_arm(&self, bodies: &[Body]) -> Vector2<f64> {
        bodies[self.body].rotated(self.offset)
    }

    /// Position in the inertial frame, m.
    pub fn position(&self, bodies: &[Body]) -> Vector2<f64> {
        bodies[self.body].com() + self.lever_arm(bodies)
    }

    /// Velocity in the inertial frame, m/s.
    pub fn velocity(&self, bodies: &[Body]) -> Vector2<f64> {
        bodies[self.body].velocity(self.lever_arm(bodies))
    }
}
