//! A trajectory of constant joint angles, for control laws that hold a configuration.

use super::{DesiredJoint, Trajectory};
use crate::scalar::Real;

/// The same angles at any time.
#[derive(Clone, Copy, Debug)]
pub struct ConstantSetpoint<'a, T> {
    /// One per joint, rad.
    pub angles: &'a [T],
}

impl<T: Real> Trajectory<T> for ConstantSetpoint<'_, T> {
    #[inline]
    fn joint(&self, joint: usize, _: T) -> Option<DesiredJoint<T>> {
        Some(DesiredJoint { angle: *self.angles.get(joint)?, rate: T::ZERO, acceleration: T::ZERO })
    }

    #[inline(always)]
    fn each_joint<J>(
        &self,
        _: T,
        joints: impl ExactSizeIterator<Item = J>,
        mut follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let angles = self.angles.get(..joints.len())?;
        for (joint, angle) in joints.zip(angles) {
            follow(joint, DesiredJoint { angle: *angle, rate: T::ZERO, acceleration: T::ZERO });
        }
        Some(())
    }
}
