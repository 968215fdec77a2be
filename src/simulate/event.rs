//! Events that end a phase before its time.
//!
//! # Example
//! ```
//! use planar_capture::generated::single_arm_3r::Model;
//! use planar_capture::simulate::event::{EventState, Events};
//! use planar_capture::simulate::{Timing, simulate, system::System};
//! use planar_capture::{control::ZeroTorque, error::Error, owned::RobotState};
//!
//! /// The base comes to x = 0.5 m.
//! struct Line;
//!
//! impl Events for Line {
//!     fn count(&self) -> usize {
//!         1
//!     }
//!
//!     fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
//!         values[0] = 0.5 - now.state.base_pose[1];
//!         Ok(())
//!     }
//! }
//!
//! let robot = Model::<f64>::default();
//! let (joint_angles, joint_rates) = (vec![0.0; 3], vec![0.0; 3]);
//! let start = RobotState { base_pose: [0.0; 3], joint_angles, base_twist: [0.0, 0.1, 0.0], joint_rates };
//! let timing = Timing { duration: 20.0, step: 0.3, sample: 1.0, ..Timing::default() };
//! let phase = simulate(&System::alone(&robot), &mut ZeroTorque, &start, &timing, &mut Line, &mut || ())?;
//! assert!((phase.duration - 5.0).abs() < 1e-9); // at 0.1 m/s
//! assert_eq!(phase.event, Some((0, phase.duration)));
//! # Ok::<(), planar_capture::simulate::PhaseError>(())
//! ```

use crate::error::Error;
use crate::simulate::path::PathInterval;
use crate::simulate::system::{Body, System};
use crate::state::State;

/// One instant of a phase.
#[derive(Clone, Copy)]
pub struct EventState<'a> {
    /// Since the start of the phase, s.
    pub time: f64,
    /// Robot, bodies and constraints.
    pub system: &'a System<'a>,
    /// The robot.
    pub state: State<'a, f64>,
    /// The bodies beside it, in the system's order.
    pub bodies: &'a [Body],
}

/// Values that end a phase: an event is a value that falls from above 0 to 0 or below.
///
/// A value that is 0 or below when the phase begins is no event until it has been above 0 at the end of a step. Values
/// should be smooth in the state: they are evaluated after every step, and at a minimum within a step.
pub trait Events {
    /// Their number.
    fn count(&self) -> usize;

    /// Their values at an instant, in any unit.
    ///
    /// # Errors
    /// Those of the model.
    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error>;

    /// Whether the phase ends where it starts.
    fn end_at_start(&self) -> bool {
        false
    }

    /// Whether [`Events::crossings`] finds them by bounds of the motion, so that none is missed whatever the step.
    fn are_bounded(&self) -> bool {
        false
    }

    /// For each event two times in a step between which its value falls from above 0 to below 0, for the first time in
    /// the step. Only called where [`Events::are_bounded`].
    ///
    /// # Errors
    /// Those of the bounds.
    fn crossings(&mut self, _step: &PathInterval<'_>) -> Result<Vec<Option<[f64; 2]>>, Error> {
        Ok(vec![None; self.count()])
    }
}

/// A phase that ends at this time, s since its start; where it starts, if that is 0.
#[derive(Clone, Copy, Debug)]
pub struct EndTime(pub f64);

impl Events for EndTime {
    fn count(&self) -> usize {
        1
    }

    fn values(&mut self, now: &EventState<'_>, values: &mut [f64]) -> Result<(), Error> {
        values.fill(self.0 - now.time);
        Ok(())
    }

    fn end_at_start(&self) -> bool {
        self.0 <= 0.0
    }
}

/// A phase that ends when its time is over.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoEvents;

impl Events for NoEvents {
    fn count(&self) -> usize {
        0
    }

    fn values(&mut self, _: &EventState<'_>, _: &mut [f64]) -> Result<(), Error> {
        Ok(())
    }
}
