//! Eqs. (6) and (7): joint rates as fourth-order polynomials of time.

use super::{DesiredJoint, JointTrajectory, PointToPoint, Trajectory, TrajectoryProperties};
use crate::scalar::Real;

/// Eq. (6): a fourth-order polynomial of the rate, with the dimensionless s that eq. (7) should have,
/// `s = T θ̇(T) / (θ(T) − θ(0))`.
///
/// ```text
/// θ̇(t) = (Δθ/T)(30τ² − 60τ³ + 30τ⁴) + θ̇(T)(−12τ² + 28τ³ − 15τ⁴),  τ = t/T
/// ```
///
/// In this form the polynomial is also defined for Δθ = 0. It has zero rate and acceleration at the start, and zero
/// acceleration and the rate θ̇(T) at the end: these six conditions make it the [`quintic()`](super::quintic()) that
/// starts at rest.
#[derive(Clone, Copy, Debug)]
pub struct Quartic<'a, T> {
    /// Angles and duration.
    pub motion: PointToPoint<'a, T>,
    /// θ̇(T), rad/s.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for Quartic<'_, T> {
    #[inline(always)]
    fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
        self.motion.quintic(joint, [T::ZERO, *self.final_rates.get(joint)?], time)
    }

    #[inline(always)]
    fn each_joint<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = J>,
        follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let rates = self.final_rates.get(..joints.len())?.iter().map(|rate| [T::ZERO, *rate]);
        self.motion.each_quintic(time, joints.zip(rates), follow)
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Quartic<'a, T> {
    const PROPERTIES: TrajectoryProperties =
        TrajectoryProperties { name: "quartic", starts_at_rest: true, ends_at_rest: false, peak_factor: 1.875 };

    fn new(motion: PointToPoint<'a, T>, _: &'a [T], final_rates: &'a [T]) -> Self {
        Self { motion, final_rates }
    }
}

/// Eqs. (6) and (7) as printed: s has the unit 1/s, so that the rate at T is θ̇(T)/T (1 s).
#[derive(Clone, Copy, Debug)]
pub struct QuarticAsPrinted<'a, T> {
    /// Angles and duration.
    pub motion: PointToPoint<'a, T>,
    /// θ̇(T) of eq. (7), rad/s; the final rate is this divided by the duration in seconds.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for QuarticAsPrinted<'_, T> {
    #[inline(always)]
    fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
        self.motion.quintic(joint, [T::ZERO, *self.final_rates.get(joint)? / self.motion.duration], time)
    }

    #[inline(always)]
    fn each_joint<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = J>,
        follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let rates = self.final_rates.get(..joints.len())?.iter().map(|rate| [T::ZERO, *rate / self.motion.duration]);
        self.motion.each_quintic(time, joints.zip(rates), follow)
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for QuarticAsPrinted<'a, T> {
    const PROPERTIES: TrajectoryProperties =
        TrajectoryProperties { name: "quartic_as_printed", ..Quartic::<'a, T>::PROPERTIES };

    fn new(motion: PointToPoint<'a, T>, _: &'a [T], final_rates: &'a [T]) -> Self {
        Self { motion, final_rates }
    }
}
