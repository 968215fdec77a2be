//! A free rigid body: its momentum, energy and force-free motion.
//!
//! # Example
//! ```
//! use planar_dynamics::body::Body;
//!
//! let body = Body { mass: 2.0, inertia: 0.5, pose: [0.0, 0.0, 3.0], twist: [4.0, 1.0, 0.0] };
//! // angular momentum: 0.5 · 4 of the rotation, −3 · 2 of the motion past the origin
//! let (momentum, energy) = body.momentum();
//! assert_eq!((momentum, energy), ([-4.0, 2.0, 0.0], 5.0));
//! let later = body.after(10.0);
//! assert_eq!((later.pose, later.momentum()), ([40.0, 10.0, 3.0], (momentum, energy)));
//! ```

use super::scalar::Scalar;

/// A free rigid body, in inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Body<T> {
    /// kg.
    pub mass: T,
    /// About its COM, kg m².
    pub inertia: T,
    /// [yaw, x, y] of its COM, inertial frame; rad, m.
    pub pose: [T; 3],
    /// [ω, vx, vy] of its COM; rad/s, m/s.
    pub twist: [T; 3],
}

impl<T: Scalar> Body<T> {
    /// Momentum [l, px, py] about the inertial origin and kinetic energy; N m s, N s, J.
    #[inline]
    #[must_use]
    pub fn momentum(&self) -> ([T; 3], T) {
        let ([_, x, y], [omega, vx, vy]) = (self.pose, self.twist);
        let (px, py) = (self.mass * vx, self.mass * vy);
        let angular = self.inertia * omega + (x * py - y * px);
        let twice = self.inertia * omega * omega + (px * vx + py * vy);
        ([angular, px, py], T::constant(0.5) * twice)
    }

    /// The body after a time (s) of motion without forces.
    #[must_use]
    pub fn after(&self, time: T) -> Self {
        let ([yaw, x, y], [omega, vx, vy]) = (self.pose, self.twist);
        Self { pose: [yaw + omega * time, x + vx * time, y + vy * time], ..*self }
    }
}
