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
        Some(CycloidalAt::new(self.motion.duration, time).joint(self.motion.angles(joint)?))
    }

    #[inline(always)]
    fn each_joint<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = J>,
        mut follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let at = CycloidalAt::new(self.motion.duration, time);
        self.motion.each_joint(joints, |joint, angles| follow(joint, at.joint(angles)))
    }
}

/// What the joints have in common at one time: the factors of the change of the angle.
struct CycloidalAt<T> {
    of_angle: T,
    of_rate: T,
    /// Of the acceleration times the duration: of a very short motion, that of a joint which stays is still a number.
    of_acceleration: T,
    duration: T,
}

impl<T: Real> CycloidalAt<T> {
    #[inline]
    fn new(duration: T, time: T) -> Self {
        let tau = normalized_time(time, duration);
        let turn = T::constant(core::f64::consts::TAU);
        // the second half by the time that is left: at rest at its end, where the sine of 2π rounded is not zero
        let left = T::ONE - tau;
        let (sin, cos) = match Scalar::sin_cos(turn * tau.minimum(left)) {
            (sin, cos) if tau > left => (-sin, cos),
            first_half => first_half,
        };
        Self {
            of_angle: tau - sin / turn,
            of_rate: (T::ONE - cos) / duration,
            of_acceleration: turn * sin / duration,
            duration,
        }
    }

    #[inline(always)]
    fn joint(&self, [from, to]: [T; 2]) -> DesiredJoint<T> {
        let change = to - from;
        DesiredJoint {
            angle: from + change * self.of_angle,
            rate: change * self.of_rate,
            acceleration: change * self.of_acceleration / self.duration,
        }
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Cycloidal<'a, T> {
    const PROPERTIES: TrajectoryProperties =
        TrajectoryProperties { name: "cycloidal", starts_at_rest: true, ends_at_rest: true, peak_factor: 2.0 };

    fn new(motion: PointToPoint<'a, T>, _: &'a [T], _: &'a [T]) -> Self {
        Self { motion }
    }
}
