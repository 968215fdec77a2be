//! Joint rates as cycloids, from rest to rest.

use super::kind::{JointTrajectory, Properties};
use super::{Desired, Ends, Trajectory, part};
use crate::scalar::{Real, Scalar};

/// Cycloidal motion from rest to rest: `θ(t) = θ(0) + Δθ (τ − sin(2πτ)/2π)`.
#[derive(Clone, Copy, Debug)]
pub struct Cycloidal<'a, T> {
    /// Angles and duration.
    pub ends: Ends<'a, T>,
}

impl<T: Real> Trajectory<T> for Cycloidal<'_, T> {
    fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
        let ([from, to], duration) = (self.ends.angles(joint)?, self.ends.duration);
        let (change, tau) = (to - from, part(time, duration));
        let turn = T::constant(core::f64::consts::TAU);
        let (sin, cos) = Scalar::sin_cos(turn * tau);
        let mean_rate = change / duration;
        Some(Desired {
            angle: from + change * (tau - sin / turn),
            rate: mean_rate * (T::ONE - cos),
            acceleration: mean_rate * turn * sin / duration,
        })
    }
}

impl<'a, T: Real> JointTrajectory<'a, T> for Cycloidal<'a, T> {
    const PROPERTIES: Properties =
        Properties { name: "cycloidal", starts_at_rest: true, ends_at_rest: true, peak_factor: 2.0 };

    fn between(ends: Ends<'a, T>, _: &'a [T], _: &'a [T]) -> Self {
        Self { ends }
    }
}
