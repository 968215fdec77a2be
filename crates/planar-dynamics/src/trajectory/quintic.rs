//! Joint angles as fifth-order polynomials of time, from the angles and rates at both ends.

use super::{DesiredJoint, JointTrajectory, PointToPoint, Trajectory, TrajectoryProperties};
use crate::scalar::{Real, Scalar};

/// The fifth-order polynomial of the angle with given angles and rates and zero acceleration at both ends.
///
/// ```text
/// θ(t) = θ(0) + Δθ(10τ³ − 15τ⁴ + 6τ⁵) + T θ̇(0)(τ − 6τ³ + 8τ⁴ − 3τ⁵) + T θ̇(T)(−4τ³ + 7τ⁴ − 3τ⁵),  τ = t/T
/// ```
///
/// From rest it is eq. (6), [`Quartic`](super::Quartic).
#[derive(Clone, Copy, Debug)]
pub struct Quintic<'a, T> {
    /// Angles and duration.
    pub motion: PointToPoint<'a, T>,
    /// θ̇(0), rad/s.
    pub initial_rates: &'a [T],
    /// θ̇(T), rad/s.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for Quintic<'_, T> {
    #[inline]
    fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
        self.motion.quintic(joint, [*self.initial_rates.get(joint)?, *self.final_rates.get(joint)?], time)
    }

    #[inline(always)]
    fn each_joint<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = J>,
        follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let count = joints.len();
        let rates = self.initial_rates.get(..count)?.iter().zip(self.final_rates.get(..count)?);
        self.motion.each_quintic(time, joints.zip(rates.map(|(start, end)| [*start, *end])), follow)
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Quintic<'a, T> {
    const PROPERTIES: TrajectoryProperties =
        TrajectoryProperties { name: "quintic", starts_at_rest: false, ends_at_rest: false, peak_factor: 1.875 };

    fn new(motion: PointToPoint<'a, T>, initial_rates: &'a [T], final_rates: &'a [T]) -> Self {
        Self { motion, initial_rates, final_rates }
    }
}

/// The polynomial of [`Quintic`] for one joint and any scalar, from the initial and final angles (rad) and rates (rad/s),
/// the duration T (s) and τ = t/T, not limited to 0..=1.
#[inline(always)]
pub fn quintic<T: Scalar>(angles: [T; 2], rates: [T; 2], duration: T, tau: T) -> DesiredJoint<T> {
    QuinticAt::new(duration, tau).joint(angles, rates)
}

/// What the joints have in common at one time: the factors of the change of the angle, the initial and the final rate.
#[derive(Clone, Copy)]
pub(super) struct QuinticAt<T> {
    of_angle: [T; 3],
    of_rate: [T; 3],
    /// Of the acceleration times the duration: of a very short motion, that of a joint which stays is still a number.
    of_acceleration: [T; 3],
    duration: T,
}

impl<T: Scalar> QuinticAt<T> {
    #[inline(always)]
    pub(super) fn new(duration: T, tau: T) -> Self {
        let n = T::constant;
        let (tau2, tau3) = (tau * tau, tau * tau * tau);
        Self {
            of_angle: [
                tau3 * (n(10.0) - n(15.0) * tau + n(6.0) * tau2),
                duration * (tau + tau3 * (n(-6.0) + n(8.0) * tau - n(3.0) * tau2)),
                duration * (tau3 * (n(-4.0) + n(7.0) * tau - n(3.0) * tau2)),
            ],
            of_rate: [
                tau2 * (n(30.0) - n(60.0) * tau + n(30.0) * tau2) / duration,
                T::ONE + tau2 * (n(-18.0) + n(32.0) * tau - n(15.0) * tau2),
                tau2 * (n(-12.0) + n(28.0) * tau - n(15.0) * tau2),
            ],
            of_acceleration: [
                tau * (n(60.0) - n(180.0) * tau + n(120.0) * tau2) / duration,
                tau * (n(-36.0) + n(96.0) * tau - n(60.0) * tau2),
                tau * (n(-24.0) + n(84.0) * tau - n(60.0) * tau2),
            ],
            duration,
        }
    }

    #[inline(always)]
    pub(super) fn joint(&self, [from, to]: [T; 2], [start, end]: [T; 2]) -> DesiredJoint<T> {
        let change = to - from;
        let sum = |[of_change, of_start, of_end]: [T; 3]| change * of_change + start * of_start + end * of_end;
        DesiredJoint {
            angle: from + sum(self.of_angle),
            rate: sum(self.of_rate),
            acceleration: sum(self.of_acceleration) / self.duration,
        }
    }
}
