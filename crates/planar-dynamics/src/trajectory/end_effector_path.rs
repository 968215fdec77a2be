//! Where the end effectors should be on their way.

use super::{part, quintic};
use crate::scalar::Real;

/// What one end effector should do at one time, inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DesiredEndEffector<T> {
    /// [yaw, x, y]; rad, m.
    pub pose: [T; 3],
    /// [ω, vx, vy], its rate; rad/s, m/s.
    pub twist: [T; 3],
    /// Its rate; rad/s², m/s².
    pub acceleration: [T; 3],
}

/// Yaw, x and y of every end effector as the polynomial of [`Quintic`](super::Quintic), from pose and twist at the
/// start to pose and twist at the end, without acceleration at either: a straight line in the inertial frame where both
/// velocities are along it, or zero.
///
/// The yaw goes from the one number to the other, by more than a turn where they differ by more. Before the start and
/// after the end it is as at the nearer of them.
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
    /// What the end effector of `arm` should do at `time` (s); `None` for an arm that the path does not have.
    pub fn end_effector(&self, arm: usize, time: T) -> Option<DesiredEndEffector<T>> {
        let tau = part(time, self.duration);
        let [x0, y0, z0] = *self.initial_poses.get(arm)?;
        let [x1, y1, z1] = *self.final_poses.get(arm)?;
        let [u0, v0, w0] = *self.initial_twists.get(arm)?;
        let [u1, v1, w1] = *self.final_twists.get(arm)?;
        let parts = [([x0, x1], [u0, u1]), ([y0, y1], [v0, v1]), ([z0, z1], [w0, w1])];
        let parts = parts.map(|(ends, rates)| quintic(ends, rates, self.duration, tau));
        Some(DesiredEndEffector {
            pose: parts.map(|part| part.angle),
            twist: parts.map(|part| part.rate),
            acceleration: parts.map(|part| part.acceleration),
        })
    }
}
