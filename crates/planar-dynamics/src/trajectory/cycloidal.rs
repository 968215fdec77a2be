//! Cycloidal joint motion from rest to rest.

use super::{DesiredJoint, JointTrajectory, PointToPoint, Trajectory, TrajectoryProperties, normalized_time};
use crate::scalar::{Real, Scalar};

/// Cycloidal motion from rest to rest: `θ(t) = θ(0) + Δθ (τ − sin(2πτ)/2π)`, τ = t/T.
#[derive(Clone, Copy, Debug)]
pub struct Cycloidal<'a, T> {
    /// Angles and duration.
    pub motion: PointToPoint<'a, T>,
}

impl<T: Real> Trajectory<T> for Cycloidal<'_, T> {
    #[inline]
    fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
        let ([from, to], duration) = (self.motion.angles(joint)?, self.motion.duration);
        let (change, tau) = (to - from, normalized_time(time, duration));
        let turn = T::constant(core::f64::consts::TAU);
        // the second half by the time that is left: at rest at its end, where the sine of 2π rounded is not zero
        let left = T::ONE - tau;
        let (sin, cos) = match Scalar::sin_cos(turn * tau.minimum(left)) {
            (sin, cos) if tau > left => (-sin, cos),
            first_half => first_half,
        };
        let mean_rate = change / duration;
        Some(DesiredJoint {
            angle: from + change * (tau - sin / turn),
            rate: mean_rate * (T::ONE - cos),
            acceleration: mean_rate * turn * sin / duration,
        })
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Cycloidal<'a, T> {
    const PROPERTIES: TrajectoryProperties =
        TrajectoryProperties { name: "cycloidal", starts_at_rest: true, ends_at_rest: true, peak_factor: 2.0 };

    fn new(motion: PointToPoint<'a, T>, _: &'a [T], _: &'a [T]) -> Self {
        Self { motion }
    }
}
