//! What can be wrong with numbers; every variant carries them.

/// Why a computation of the core has no result.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// A slice of the wrong length.
    #[error("{quantity} has {found} values, the model has {expected}")]
    Length {
        /// What the slice holds.
        quantity: &'static str,
        /// The model's number.
        expected: usize,
        /// The slice's number.
        found: usize,
    },
    /// A vector that is no state: positions, as many rates, and three entries of actuator work.
    #[error("a state vector has as many rates as positions and three entries of actuator work, not {found} entries")]
    StateVector {
        /// The vector's length.
        found: usize,
    },
    /// An index of something that there is not.
    #[error("there is no {what} {index}, there are {count}")]
    Index {
        /// What is counted.
        what: &'static str,
        /// From 0.
        index: usize,
        /// How many there are.
        count: usize,
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
    #[error("{what} is singular: smallest relative pivot {pivot:e}, wanted more than {limit:e}")]
    Singular {
        /// The matrix that was factored.
        what: &'static str,
        /// Smallest pivot relative to its scale.
        pivot: f64,
        /// What it had to exceed.
        limit: f64,
    },
    /// An iteration that does not come to an end.
    #[error("{what} do not settle: they still change by {change:e} in round {rounds}")]
    Unsettled {
        /// What is iterated.
        what: &'static str,
        /// Rounds made.
        rounds: usize,
        /// Largest change in the last of them.
        change: f64,
    },
    /// A search that does not come to an end.
    #[error("{what}: no solution after {rounds} exchanges")]
    Exhausted {
        /// What is solved.
        what: &'static str,
        /// Exchanges made.
        rounds: u32,
    },
    /// An adaptive integrator that makes no way.
    #[error("the tolerance {tolerance:e} cannot be kept: steps of {step:e} s are still too long")]
    Tolerance {
        /// What was asked for, relative and per unit.
        tolerance: f64,
        /// s.
        step: f64,
    },
    /// Reduced coordinates where there is more than the robot.
    #[error(
        "reduced coordinates are for a robot alone, found {count} bodies or holds beside it, expected `coordinates = \"full\"`"
    )]
    Beside {
        /// How many bodies there are.
        count: usize,
    },
}
