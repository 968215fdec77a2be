//! Paths of the end effectors, from poses and twists at both ends.

use super::{normalized_time, quintic};
use crate::scalar::Real;

/// Desired motion of one end effector at one time, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesiredEndEffector<T> {
    /// [yaw, x, y]; rad, m.
    pub pose: [T; 3],
    /// [ω, vx, vy]; rad/s, m/s.
    pub twist: [T; 3],
    /// [α, ax, ay]; rad/s², m/s².
    pub acceleration: [T; 3],
}

/// Yaw, x and y of every end effector as the polynomial of [`Quintic`](super::Quintic), with zero acceleration at both
/// ends: a straight line in the inertial frame where both velocities are along it, or zero.
///
/// The yaw is not wrapped: the rotation is the difference of the two yaws, even beyond a turn.
#[derive(Clone, Copy, Debug)]
pub struct EndEffectorPath<'a, T> {
    /// At time 0, one per arm; rad, m.
    pub initial_poses: &'a [[T; 3]],
    /// At time 0, one per arm; rad/s, m/s.
    pub initial_twists: &'a [[T; 3]],
    /// At the end, one per arm; rad, m.
    pub final_poses: &'a [[T; 3]],
    /// At the end, one per arm; rad/s, m/s.
    pub final_twists: &'a [[T; 3]],
    /// s, positive.
    pub duration: T,
}

impl<T: Real> EndEffectorPath<'_, T> {
    /// The desired motion of the end effector of `arm` at `time` (s); `None` for an arm that the path does not have.
    pub fn end_effector(&self, arm: usize, time: T) -> Option<DesiredEndEffector<T>> {
        let tau = normalized_time(time, self.duration);
        let [x0, y0, z0] = *self.initial_poses.get(arm)?;
        let [x1, y1, z1] = *self.final_poses.get(arm)?;
        let [u0, v0, w0] = *self.initial_twists.get(arm)?;
        let [u1, v1, w1] = *self.final_twists.get(arm)?;
        let components = [([x0, x1], [u0, u1]), ([y0, y1], [v0, v1]), ([z0, z1], [w0, w1])]
            .map(|(positions, rates)| quintic(positions, rates, self.duration, tau));
        Some(DesiredEndEffector {
            pose: components.map(|component| component.angle),
            twist: components.map(|component| component.rate),
            acceleration: components.map(|component| component.acceleration),
        })
    }
}
