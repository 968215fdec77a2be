//! What is compared and measured of every route.

use crate::Real;
use crate::mission::Record;
use crate::states::Inputs;

/// One way to compute.
pub trait Route: Sized + 'static {
    /// Its name.
    const NAME: &'static str;
    /// The robot's numbers.
    type Parameters;
    /// The robot.
    type Model;
    /// What the functions take beside [`Inputs`], made of them.
    type Prepared;
    /// What the functions give.
    type Results;
    /// The functions, in the order of [`NAMES`].
    const FUNCTIONS: [Function<Self>; NAMES.len()];

    /// For these inputs.
    fn case(inputs: &Inputs) -> Case<Self>;

    /// The mission.
    ///
    /// # Errors
    /// What the route says of the numbers.
    fn capture(record: &mut Record) -> Result<(), &'static str>;

    /// Whether the reference vectors are met.
    fn self_test() -> bool;
}

/// The functions that are measured.
pub const NAMES: [&str; 7] = [
    "model_new",
    "forward_dynamics",
    "reduced_dynamics",
    "exact_impact",
    "exact_impact_with_impulses",
    "pd_and_rk4_step",
    "merge",
];

/// Arguments and results of the functions.
#[derive(Debug)]
pub struct Case<R: Route> {
    /// The robot's numbers.
    pub parameters: R::Parameters,
    /// The robot.
    pub model: R::Model,
    /// The state.
    pub inputs: Inputs,
    /// What the route makes of it.
    pub prepared: R::Prepared,
    /// What the functions give.
    pub results: R::Results,
}

/// Hands the numbers that a function gave to another.
pub type Results<R> = fn(&Case<R>, &mut dyn FnMut(&[Real]));

/// One function of a route, not inlined; false where it has no result.
#[derive(Clone, Copy, Debug)]
pub struct Function<R: Route> {
    /// Computes.
    pub call: fn(&mut Case<R>) -> bool,
    /// What it gave.
    pub results: Results<R>,
}
