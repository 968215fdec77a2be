//! The errors of the core's computations; every variant carries the numbers that caused it.
//!
//! # Example
//! ```
//! use planar_capture::generated::dual_arm_3r::Model;
//! use planar_dynamics::dynamics::Kinematics;
//! use planar_dynamics::error::Error;
//!
//! let (robot, mut poses) = (Model::<f64>::default(), [[0.0; 3]; 2]);
//! let mut end_effectors = |angles: &[f64]| Kinematics::end_effector_poses(&robot, &[0.0; 3], angles, &mut poses);
//! let error = end_effectors(&[0.5; 5]).expect_err("an angle is missing");
//! assert_eq!(error, Error::Length { quantity: "joint_angles", expected: 6, found: 5 });
//! assert_eq!(error.to_string(), "joint_angles has 5 values, expected 6");
//! let error = end_effectors(&[0.5, 0.5, f64::INFINITY, 0.5, 0.5, 0.5]).expect_err("an angle is infinite");
//! assert_eq!(error.to_string(), "joint_angles[2] = inf is not a finite number");
//! ```

use crate::manifest::ParameterKind;
use core::fmt::{self, Display, Formatter};

/// A pivot, in words where it is no number.
struct PivotText(f64);

impl Display for PivotText {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        if self.0.is_finite() { write!(f, "{:e}", self.0) } else { f.write_str("not a finite number") }
    }
}

/// Why a computation of the core has no result.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A slice of the wrong length.
    #[error("{quantity} has {found} values, expected {expected}")]
    Length {
        /// What the slice holds.
        quantity: &'static str,
        /// That of the model, or of the other slices.
        expected: usize,
        /// The slice's number.
        found: usize,
    },
    /// More contact rows than can be solved together.
    #[error("the contacts have {found} rows, at most {limit} can be solved together")]
    ContactRows {
        /// How many there may be.
        limit: usize,
        /// How many there are.
        found: usize,
    },
    /// A vector that is not an integrated one: positions, as many rates, and three entries of actuator work.
    #[error("a state vector has as many rates as positions and three entries of actuator work, not {found} entries")]
    StateVector {
        /// The vector's length.
        found: usize,
    },
    /// An index out of range.
    #[error("there is no {what} {index}, there are {count}")]
    Index {
        /// What is counted.
        what: &'static str,
        /// From 0.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A parameter that the manifest of a generated model lacks.
    #[error("the model has no parameter {kind:?} (arm {arm}, link {link})")]
    Parameter {
        /// What it is.
        kind: ParameterKind,
        /// From 0.
        arm: usize,
        /// From 0.
        link: usize,
    },
    /// A number that is NaN or infinite.
    #[error("{quantity}[{index}] = {value} is not a finite number")]
    NotFinite {
        /// What the number belongs to.
        quantity: &'static str,
        /// Position in row-major order.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A pivot at or below its limit: the system of equations has no reliable solution.
    #[error("{what} is singular: smallest relative pivot is {}, wanted more than {limit:e}", PivotText(*pivot))]
    Singular {
        /// The matrix that was factored.
        what: &'static str,
        /// Smallest pivot relative to its scale.
        pivot: f64,
        /// What it had to exceed.
        limit: f64,
    },
    /// An iteration that does not converge.
    #[error("{what} do not converge: they still change by {change:e} in iteration {iterations}")]
    NotConverged {
        /// What is iterated.
        what: &'static str,
        /// Iterations made.
        iterations: u32,
        /// Largest change in the last of them.
        change: f64,
    },
    /// An exchange of active constraints that does not end.
    #[error("{what}: no solution after {exchanges} exchanges")]
    Exchanges {
        /// What is solved.
        what: &'static str,
        /// Exchanges made.
        exchanges: u32,
    },
    /// A tolerance that an adaptive integrator cannot meet.
    #[error("the tolerance {tolerance:e} cannot be kept: steps of {step:e} s are still too long")]
    Tolerance {
        /// Relative, and absolute in SI units.
        tolerance: f64,
        /// s.
        step: f64,
    },
    /// An adaptive integrator whose steps are too short to come to the end.
    #[error(
        "steps have shrunk to some {step:.1e} s, so that the whole takes {needed:.1e} of them, expected at most {most:.0e}"
    )]
    Steps {
        /// Mean of the last ones, s.
        step: f64,
        /// Those taken, and those to the end by this mean.
        needed: f64,
        /// How many there may be.
        most: f64,
    },
    /// A law that remembers earlier calls, at every stage of a step.
    #[error("the control law remembers what it was called with, and acts continuously: it needs a sample time")]
    ContinuousMemory,
    /// Reduced coordinates of a system with more than the robot.
    #[error("reduced coordinates are for a robot alone, found {count} bodies or constraints beside it")]
    UnsupportedBodies {
        /// How many bodies and constraints there are.
        count: usize,
    },
}
