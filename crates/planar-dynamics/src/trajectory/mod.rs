//! Joint trajectories of the approach, from the initial angles to the final ones, and paths of the tips.
//!
//! Outside 0 ≤ t ≤ duration a trajectory stays at the nearer end.

mod quintic;
mod standing;
mod tip_path;

pub use quintic::{Quintic, quintic};
pub use standing::Standing;
pub use tip_path::{DesiredTip, TipPath};

use crate::scalar::{Real, Scalar};

/// What one joint should do at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Desired<T> {
    /// rad.
    pub angle: T,
    /// rad/s.
    pub rate: T,
    /// rad/s².
    pub acceleration: T,
}

/// Desired motion of every joint.
pub trait Trajectory<T> {
    /// What `joint` should do at `time` (s); `None` for a joint that the trajectory does not have.
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>>;
}

/// Ends of a joint motion, in slices of one value per joint.
#[derive(Clone, Copy, Debug)]
pub struct Ends<'a, T> {
    /// Angles at time 0, rad.
    pub initial_angles: &'a [T],
    /// Angles at the end, rad.
    pub final_angles: &'a [T],
    /// s, positive.
    pub duration: T,
}

impl<T: Real> Ends<'_, T> {
    /// (initial angle, final angle less initial, τ = t/T in 0..=1).
    fn at(&self, joint: usize, time: T) -> Option<(T, T, T)> {
        let initial = *self.initial_angles.get(joint)?;
        let change = *self.final_angles.get(joint)? - initial;
        let tau = time / self.duration;
        let tau = if tau > T::ONE { T::ONE } else { tau };
        Some((initial, change, if tau < T::ZERO { T::ZERO } else { tau }))
    }
}

/// Eq. (6): a fourth-order polynomial of the rate, with the dimensionless s that eq. (7) should have,
/// `s = T θ̇(T) / (θ(T) − θ(0))`.
///
/// ```text
/// θ̇(t) = (Δθ/T)(30τ² − 60τ³ + 30τ⁴) + θ̇(T)(−12τ² + 28τ³ − 15τ⁴),  τ = t/T
/// ```
///
/// the same polynomial, defined for Δθ = 0 too. Rate and acceleration are zero at the start, the
/// acceleration is zero and the rate θ̇(T) at the end.
#[derive(Clone, Copy, Debug)]
pub struct Quartic<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
    /// θ̇(T), rad/s.
    pub final_rates: &'a [T],
}

impl<T: Real> Trajectory<T> for Quartic<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let (initial, change, tau) = self.ends.at(joint, time)?;
        Some(quartic(initial, change, *self.final_rates.get(joint)?, self.ends.duration, tau))
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
        let (initial, change, tau) = self.ends.at(joint, time)?;
        let reached = *self.final_rates.get(joint)? / self.ends.duration;
        Some(quartic(initial, change, reached, self.ends.duration, tau))
    }
}

fn quartic<T: Real>(initial: T, change: T, final_rate: T, duration: T, tau: T) -> Desired<T> {
    let n = T::constant;
    let (tau2, tau3) = (tau * tau, tau * tau * tau);
    let mean_rate = change / duration;
    // change: 10τ³ − 15τ⁴ + 6τ⁵; end rate: T(−4τ³ + 7τ⁴ − 3τ⁵); then their derivatives
    let angle = change * tau3 * (n(10.0) - n(15.0) * tau + n(6.0) * tau2)
        + final_rate * duration * tau3 * (n(-4.0) + n(7.0) * tau - n(3.0) * tau2);
    let rate = mean_rate * tau2 * (n(30.0) - n(60.0) * tau + n(30.0) * tau2)
        + final_rate * tau2 * (n(-12.0) + n(28.0) * tau - n(15.0) * tau2);
    let acceleration = (mean_rate * tau * (n(60.0) - n(180.0) * tau + n(120.0) * tau2)
        + final_rate * tau * (n(-24.0) + n(84.0) * tau - n(60.0) * tau2))
        / duration;
    Desired { angle: initial + angle, rate, acceleration }
}

/// Cycloidal motion from rest to rest: `θ(t) = θ(0) + Δθ (τ − sin(2πτ)/2π)`.
#[derive(Clone, Copy, Debug)]
pub struct Cycloidal<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
}

impl<T: Real> Trajectory<T> for Cycloidal<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let (initial, change, tau) = self.ends.at(joint, time)?;
        let turn = T::constant(core::f64::consts::TAU);
        let (sin, cos) = Scalar::sin_cos(turn * tau);
        let mean_rate = change / self.ends.duration;
        Some(Desired {
            angle: initial + change * (tau - sin / turn),
            rate: mean_rate * (T::ONE - cos),
            acceleration: mean_rate * turn * sin / self.ends.duration,
        })
    }
}
