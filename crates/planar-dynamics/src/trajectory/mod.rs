//! Joint trajectories of the approach, from the initial angles to the final ones, and paths of the end effectors.
//!
//! Before t = 0 and after the duration a trajectory has the values at its nearer end.
//!
//! # Example
//! ```
//! use planar_dynamics::trajectory::{PointToPoint, Quartic, Trajectory};
//!
//! let motion = PointToPoint { initial_angles: &[0.0], final_angles: &[1.0], duration: 2.0 };
//! let trajectory = Quartic { motion, final_rates: &[0.0] };
//! // from rest to rest: at half the time half the way, at 15/8 of the mean rate
//! let middle = trajectory.joint(0, 1.0).expect("the only joint");
//! assert_eq!((middle.angle, middle.rate, middle.acceleration), (0.5, 0.9375, 0.0));
//! let after = trajectory.joint(0, 3.0).expect("the only joint");
//! assert_eq!((after.angle, after.rate, after.acceleration), (1.0, 0.0, 0.0));
//! ```

#![allow(clippy::inline_always, reason = "in a loop over joints the powers of the time are then computed once")]

mod constant_setpoint;
mod cycloidal;
mod end_effector_path;
mod quartic;
mod quintic;

pub use constant_setpoint::ConstantSetpoint;
pub use cycloidal::Cycloidal;
pub use end_effector_path::{DesiredEndEffector, EndEffectorPath};
pub use quartic::{Quartic, QuarticAsPrinted};
use quintic::QuinticAt;
pub use quintic::{Quintic, quintic};

use crate::scalar::Real;

/// Desired motion of one joint at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DesiredJoint<T> {
    /// rad.
    pub angle: T,
    /// rad/s.
    pub rate: T,
    /// rad/s².
    pub acceleration: T,
}

/// Desired motion of every joint.
pub trait Trajectory<T> {
    /// The desired motion of `joint` at `time` (s); `None` for a joint that the trajectory does not have.
    fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>>;

    /// Calls `follow` with each item of `joints` and the desired motion of its joint at `time` (s): the first item is the first joint's,
    /// a torque to be filled, for example. `None` where the trajectory has fewer joints, for which `follow` may have been called.
    /// A trajectory of one's own need not have this function; with it, it may compute once what its joints have in common.
    ///
    /// # Example
    /// ```
    /// use planar_dynamics::trajectory::{DesiredJoint, Trajectory};
    ///
    /// /// All joints swing together.
    /// struct Swing {
    ///     amplitudes: [f64; 2],
    ///     frequency: f64,
    /// }
    ///
    /// impl Swing {
    ///     /// The motion of a joint by its amplitude.
    ///     fn at(&self, time: f64) -> impl Fn(f64) -> DesiredJoint<f64> {
    ///         let omega = self.frequency;
    ///         let (sin, cos) = (omega * time).sin_cos();
    ///         move |a| DesiredJoint { angle: a * sin, rate: a * omega * cos, acceleration: -a * omega * omega * sin }
    ///     }
    /// }
    ///
    /// impl Trajectory<f64> for Swing {
    ///     fn joint(&self, joint: usize, time: f64) -> Option<DesiredJoint<f64>> {
    ///         Some(self.at(time)(*self.amplitudes.get(joint)?))
    ///     }
    ///
    ///     // one sine for all joints
    ///     fn each_joint<J>(
    ///         &self,
    ///         time: f64,
    ///         joints: impl ExactSizeIterator<Item = J>,
    ///         mut follow: impl FnMut(J, DesiredJoint<f64>),
    ///     ) -> Option<()> {
    ///         let (at, amplitudes) = (self.at(time), self.amplitudes.get(..joints.len())?);
    ///         joints.zip(amplitudes).for_each(|(joint, amplitude)| follow(joint, at(*amplitude)));
    ///         Some(())
    ///     }
    /// }
    ///
    /// let swing = Swing { amplitudes: [0.1, 0.2], frequency: 2.0 };
    /// let mut angles = [0.0; 2];
    /// swing.each_joint(0.3, angles.iter_mut(), |angle, desired| *angle = desired.angle).expect("two joints");
    /// assert_eq!(angles, [0, 1].map(|joint| swing.joint(joint, 0.3).expect("a joint").angle));
    /// ```
    #[inline(always)]
    fn each_joint<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = J>,
        mut follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()>
    where
        Self: Sized,
        T: Copy,
    {
        // a counter of `enumerate` could overflow, as far as a compiler sees that checks it
        for (index, joint) in (0..joints.len()).zip(joints) {
            follow(joint, self.joint(index, time)?);
        }
        Some(())
    }
}

/// The properties of a kind of joint trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TrajectoryProperties {
    /// Its name in scenarios.
    pub name: &'static str,
    /// Whether it starts at rest and ignores the initial rates.
    pub starts_at_rest: bool,
    /// Whether it ends at rest and takes no final rates.
    pub ends_at_rest: bool,
    /// The largest rate of a motion from rest to rest over its mean rate.
    pub peak_factor: f64,
}

/// A joint trajectory that is determined by angles and rates at its ends.
pub trait JointTrajectory<'a, T>: Trajectory<T> {
    /// The properties of the kind.
    const PROPERTIES: TrajectoryProperties;

    /// The trajectory of a motion with these initial and final rates, rad/s; rates that the kind does not take are
    /// ignored.
    fn new(motion: PointToPoint<'a, T>, initial_rates: &'a [T], final_rates: &'a [T]) -> Self;
}

/// A point-to-point motion in joint space: slices of one value per joint.
#[derive(Clone, Copy, Debug)]
pub struct PointToPoint<'a, T> {
    /// Angles at time 0, rad.
    pub initial_angles: &'a [T],
    /// Angles at the end, rad.
    pub final_angles: &'a [T],
    /// s, positive.
    pub duration: T,
}

impl<T: Real> PointToPoint<'_, T> {
    /// Initial and final angle of a joint.
    #[inline]
    fn angles(&self, joint: usize) -> Option<[T; 2]> {
        Some([*self.initial_angles.get(joint)?, *self.final_angles.get(joint)?])
    }

    /// Initial and final angles of the first joints, as many as these, which are handed to `follow` with them.
    #[inline(always)]
    fn each_joint<J>(&self, joints: impl ExactSizeIterator<Item = J>, mut follow: impl FnMut(J, [T; 2])) -> Option<()> {
        let count = joints.len();
        let angles = self.initial_angles.get(..count)?.iter().zip(self.final_angles.get(..count)?);
        for (joint, (from, to)) in joints.zip(angles) {
            follow(joint, [*from, *to]);
        }
        Some(())
    }

    /// [`quintic()`] of a joint with these initial and final rates.
    #[inline(always)]
    fn quintic(&self, joint: usize, rates: [T; 2], time: T) -> Option<DesiredJoint<T>> {
        Some(quintic(self.angles(joint)?, rates, self.duration, normalized_time(time, self.duration)))
    }

    /// [`quintic()`] of the first joints, each with its initial and final rates.
    #[inline(always)]
    fn each_quintic<J>(
        &self,
        time: T,
        joints: impl ExactSizeIterator<Item = (J, [T; 2])>,
        mut follow: impl FnMut(J, DesiredJoint<T>),
    ) -> Option<()> {
        let at = QuinticAt::new(self.duration, normalized_time(time, self.duration));
        self.each_joint(joints, |(joint, rates), angles| follow(joint, at.joint(angles, rates)))
    }
}

/// τ = t/T, limited to 0..=1.
#[inline(always)]
fn normalized_time<T: Real>(time: T, duration: T) -> T {
    (time / duration).minimum(T::ONE).maximum(T::ZERO)
}

macro_rules! kinds {
    ($($kind:ident),*) => {
        /// A kind of joint trajectory.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        pub enum TrajectoryKind {
            $(#[doc = concat!("[`", stringify!($kind), "`].")] $kind,)*
        }

        impl TrajectoryKind {
            /// All kinds.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// The properties of this kind.
            #[must_use]
            pub const fn properties(self) -> TrajectoryProperties {
                match self {
                    $(Self::$kind => <$kind<'static, f64> as JointTrajectory<'static, f64>>::PROPERTIES,)*
                }
            }

            /// The trajectory of a motion with these initial and final rates, rad/s.
            #[must_use]
            pub fn trajectory<'a, T: Real>(
                self,
                motion: PointToPoint<'a, T>,
                initial_rates: &'a [T],
                final_rates: &'a [T],
            ) -> AnyTrajectory<'a, T> {
                match self {
                    $(Self::$kind => AnyTrajectory::$kind($kind::new(motion, initial_rates, final_rates)),)*
                }
            }
        }

        /// A joint trajectory of any kind.
        #[derive(Clone, Copy, Debug)]
        pub enum AnyTrajectory<'a, T> {
            $(#[doc = concat!("Of the kind ", stringify!($kind), ".")] $kind($kind<'a, T>),)*
        }

        impl<T: Real> Trajectory<T> for AnyTrajectory<'_, T> {
            #[inline(always)]
            fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
                match self {
                    $(Self::$kind(trajectory) => trajectory.joint(joint, time),)*
                }
            }

            #[inline(always)]
            fn each_joint<J>(
                &self,
                time: T,
                joints: impl ExactSizeIterator<Item = J>,
                follow: impl FnMut(J, DesiredJoint<T>),
            ) -> Option<()> {
                match self {
                    $(Self::$kind(trajectory) => trajectory.each_joint(time, joints, follow),)*
                }
            }
        }
    };
}

// a new kind has a file of its own, and an entry here
kinds!(Quartic, QuarticAsPrinted, Cycloidal, Quintic);
