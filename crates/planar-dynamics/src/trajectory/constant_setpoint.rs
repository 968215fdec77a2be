//! Staying where one is.

use super::{Desired, Trajectory};
use crate::scalar::Real;

/// No motion: these angles, at any time.
#[derive(Clone, Copy, Debug)]
pub struct ConstantSetpoint<'a, T> {
    /// One per joint, rad.
    pub angles: &'a [T],
}

impl<T: Real> Trajectory<T> for ConstantSetpoint<'_, T> {
    fn joint(&self, joint: usize, _: T) -> Option<Desired<T>> {
        Some(Desired { angle: *self.angles.get(joint)?, rate: T::ZERO, acceleration: T::ZERO })
    }
}
