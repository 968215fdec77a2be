//! Eqs. (6) and (7): joint rates as polynomials of fourth order.

use super::kind::{JointTrajectory, Properties};
use super::{Desired, Ends, Trajectory, part, quintic};
use crate::scalar::Real;

/// Eq. (6): a fourth-order polynomial of the rate, with the dimensionless s that eq. (7) should have,
/// `s = T θ̇(T) / (θ(T) − θ(0))`.
///
/// ```text
/// θ̇(t) = (Δθ/T)(30τ² − 60τ³ + 30τ⁴) + θ̇(T)(−12τ² + 28τ³ − 15τ⁴),  τ = t/T
/// ```
///
/// the same polynomial, defined for Δθ = 0 too. Rate and acceleration are zero at the start, the acceleration is zero
/// and the rate θ̇(T) at the end: six conditions, so that the angle is the [`quintic()`] that starts at rest.
#[derive(Clone, Copy, Debug)]
pub struct Quartic<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
    /// θ̇(T), rad/s.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for Quartic<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let rates = [T::ZERO, *self.final_rates.get(joint)?];
        let duration = self.ends.duration;
        Some(quintic(self.ends.angles(joint)?, rates, duration, part(time, duration)))
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Quartic<'a, T> {
    const PROPERTIES: Properties =
        Properties { name: "quartic", starts_at_rest: true, ends_at_rest: false, peak_factor: 1.875 };

    fn between(ends: Ends<'a, T>, _: &'a [T], final_rates: &'a [T]) -> Self {
        Self { ends, final_rates }
    }
}

/// Eqs. (6) and (7) as printed: s has the unit 1/s, so that the rate reached at T is θ̇(T)/T (1 s).
#[derive(Clone, Copy, Debug)]
pub struct QuarticAsPrinted<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
    /// θ̇(T) of eq. (7), rad/s; what is reached is this divided by the duration's number of seconds.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for QuarticAsPrinted<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let duration = self.ends.duration;
        let rates = [T::ZERO, *self.final_rates.get(joint)? / duration];
        Some(quintic(self.ends.angles(joint)?, rates, duration, part(time, duration)))
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for QuarticAsPrinted<'a, T> {
    const PROPERTIES: Properties =
        Properties { name: "quartic_as_printed", starts_at_rest: true, ends_at_rest: false, peak_factor: 1.875 };

    fn between(ends: Ends<'a, T>, _: &'a [T], final_rates: &'a [T]) -> Self {
        Self { ends, final_rates }
    }
}
