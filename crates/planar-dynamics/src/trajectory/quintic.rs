//! Joint angles as polynomials of fifth order, between two angles and rates.

use super::kind::{JointTrajectory, Properties};
use super::{Desired, Ends, Trajectory, part};
use crate::scalar::{Real, Scalar};

/// The fifth-order polynomial of the angle with given angles and rates at both ends, and no acceleration there.
///
/// ```text
/// θ(t) = θ(0) + Δθ(10τ³ − 15τ⁴ + 6τ⁵) + T θ̇(0)(τ − 6τ³ + 8τ⁴ − 3τ⁵) + T θ̇(T)(−4τ³ + 7τ⁴ − 3τ⁵),  τ = t/T
/// ```
///
/// From rest it is eq. (6), [`Quartic`](super::Quartic).
#[derive(Clone, Copy, Debug)]
pub struct Quintic<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
    /// θ̇(0), rad/s.
    pub initial_rates: &'a [T],
    /// θ̇(T), rad/s.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for Quintic<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let rates = [*self.initial_rates.get(joint)?, *self.final_rates.get(joint)?];
        let duration = self.ends.duration;
        Some(quintic(self.ends.angles(joint)?, rates, duration, part(time, duration)))
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Quintic<'a, T> {
    const PROPERTIES: Properties =
        Properties { name: "quintic", starts_at_rest: false, ends_at_rest: false, peak_factor: 1.875 };

    fn between(ends: Ends<'a, T>, initial_rates: &'a [T], final_rates: &'a [T]) -> Self {
        Self { ends, initial_rates, final_rates }
    }
}

/// The polynomial of [`Quintic`], for one joint and any scalar: angles (rad) and rates (rad/s) at the start and the
/// end, the duration (s), and the part τ of it that has passed, not cut to 0..=1.
pub fn quintic<T: Scalar>([from, to]: [T; 2], [start, end]: [T; 2], duration: T, tau: T) -> Desired<T> {
    let n = T::constant;
    let (tau2, tau3) = (tau * tau, tau * tau * tau);
    let change = to - from;
    let angle = change * tau3 * (n(10.0) - n(15.0) * tau + n(6.0) * tau2)
        + start * duration * (tau + tau3 * (n(-6.0) + n(8.0) * tau - n(3.0) * tau2))
        + end * duration * tau3 * (n(-4.0) + n(7.0) * tau - n(3.0) * tau2);
    let rate = change / duration * tau2 * (n(30.0) - n(60.0) * tau + n(30.0) * tau2)
        + start * (T::ONE + tau2 * (n(-18.0) + n(32.0) * tau - n(15.0) * tau2))
        + end * tau2 * (n(-12.0) + n(28.0) * tau - n(15.0) * tau2);
    let acceleration = (change / duration * tau * (n(60.0) - n(180.0) * tau + n(120.0) * tau2)
        + start * tau * (n(-36.0) + n(96.0) * tau - n(60.0) * tau2)
        + end * tau * (n(-24.0) + n(84.0) * tau - n(60.0) * tau2))
        / duration;
    Desired { angle: from + angle, rate, acceleration }
}
