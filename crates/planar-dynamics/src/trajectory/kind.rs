//! The kinds of joint trajectories that can be named.

use super::{Cycloidal, Desired, Ends, Quartic, QuarticAsPrinted, Quintic, Trajectory};
use crate::scalar::Real;

/// What a kind of joint trajectory is and can.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// As scenarios have it.
    pub name: &'static str,
    /// Whether it starts at rest, whatever the initial rates are.
    pub starts_at_rest: bool,
    /// Whether it ends at rest, and takes no final rates.
    pub ends_at_rest: bool,
    /// The largest rate from rest to rest over the mean rate.
    pub peak_factor: f64,
}

/// A joint trajectory that follows from angles and rates at its ends.
pub trait JointTrajectory<'a, T>: Trajectory<T> {
    /// What the kind is.
    const PROPERTIES: Properties;

    /// The trajectory between these ends, rad/s; rates that the kind does not take are not looked at.
    fn between(ends: Ends<'a, T>, initial_rates: &'a [T], final_rates: &'a [T]) -> Self;
}

macro_rules! kinds {
    ($($kind:ident),*) => {
        /// A kind of joint trajectory.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum TrajectoryKind {
            $(#[doc = concat!("[`", stringify!($kind), "`](super::", stringify!($kind), ").")] $kind,)*
        }

        impl TrajectoryKind {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$kind),*];

            /// What it is and can.
            #[must_use]
            pub const fn properties(self) -> Properties {
                match self {
                    $(Self::$kind => <$kind<'static, f64> as JointTrajectory<'static, f64>>::PROPERTIES,)*
                }
            }

            /// The trajectory between these ends, rad/s.
            #[must_use]
            pub fn between<'a, T: Real>(
                self,
                ends: Ends<'a, T>,
                initial_rates: &'a [T],
                final_rates: &'a [T],
            ) -> AnyTrajectory<'a, T> {
                match self {
                    $(Self::$kind => AnyTrajectory::$kind($kind::between(ends, initial_rates, final_rates)),)*
                }
            }
        }

        /// A joint trajectory of any kind.
        #[derive(Clone, Copy, Debug)]
        pub enum AnyTrajectory<'a, T> {
            $(#[doc = concat!("Of the kind ", stringify!($kind), ".")] $kind($kind<'a, T>),)*
        }

        impl<T: Real> Trajectory<T> for AnyTrajectory<'_, T> {
            fn joint(&self, joint: usize, time: T) -> Option<Desired<T>> {
                match self {
                    $(Self::$kind(trajectory) => trajectory.joint(joint, time),)*
                }
            }
        }
    };
}

// a kind stands in a file of its own, and here
kinds!(Quartic, QuarticAsPrinted, Cycloidal, Quintic);
