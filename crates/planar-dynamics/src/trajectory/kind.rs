//! The list of the kinds of joint trajectories.

use super::{
    Cycloidal, DesiredJoint, JointTrajectory, PointToPoint, Quartic, QuarticAsPrinted, Quintic, Trajectory,
    TrajectoryProperties,
};
use crate::scalar::Real;

macro_rules! kinds {
    ($($kind:ident),*) => {
        /// A kind of joint trajectory.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum TrajectoryKind {
            $(#[doc = concat!("[`", stringify!($kind), "`](super::", stringify!($kind), ").")] $kind,)*
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
            fn joint(&self, joint: usize, time: T) -> Option<DesiredJoint<T>> {
                match self {
                    $(Self::$kind(trajectory) => trajectory.joint(joint, time),)*
                }
            }
        }
    };
}

// a new kind has a file of its own, and an entry here
kinds!(Quartic, QuarticAsPrinted, Cycloidal, Quintic);
