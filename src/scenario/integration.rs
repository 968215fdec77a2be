//! `integrator`, `tolerance` and `coordinates`: how a phase is integrated.

use crate::diagnostic::{Quantity, Table};
use crate::integrate::Adaptive;

const TOLERANCE: Quantity = Quantity::positive("a tolerance", "parts of 1");

/// The tolerance where a scenario gives none: the paper's approach then is off by less than 1e-12 rad and m.
const DEFAULT_TOLERANCE: f64 = 1e-10;
/// Looser is no longer what anybody wants of an order 9.
const MOST_TOLERANCE: f64 = 1e-3;

/// How a phase is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Integration {
    /// By which integrator.
    pub scheme: Scheme,
    /// In which coordinates.
    pub coordinates: Coordinates,
}

/// An integrator.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Scheme {
    /// Classical Runge–Kutta steps of order 4.
    #[default]
    RungeKutta4,
    /// Rates, then positions by the new rates: order 1.
    SemiImplicitEuler,
    /// Gauss–Legendre steps of order 6 in canonical variables: keeps both momenta, and the energy for very long times.
    GaussLegendre,
    /// Verner's pair of orders 9 and 8, with steps of its own.
    Adaptive {
        /// Relative and per unit, of each step; default 1e-10.
        tolerance: f64,
    },
}

/// What is integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coordinates {
    /// Base and joints.
    #[default]
    Full,
    /// The joints and the base pose; the base twist follows from the momentum.
    Reduced,
}

/// The value of `integrator`.
#[derive(Clone, Copy, PartialEq)]
enum Choice {
    RungeKutta4,
    SemiImplicitEuler,
    GaussLegendre,
    Adaptive,
}

impl Integration {
    pub(super) const KEYS: [&'static str; 3] = ["integrator", "tolerance", "coordinates"];

    pub(super) fn from_table(table: &Table<'_>) -> Option<Self> {
        let choice = match table.get("integrator") {
            Some(value) => value.choice(&[
                ("rk4", Choice::RungeKutta4),
                ("semi_implicit_euler", Choice::SemiImplicitEuler),
                ("gauss_legendre", Choice::GaussLegendre),
                ("adaptive", Choice::Adaptive),
            ]),
            None => Some(Choice::RungeKutta4),
        };
        let coordinates = match table.get("coordinates") {
            Some(value) => value.choice(&[("full", Coordinates::Full), ("reduced", Coordinates::Reduced)]),
            None => Some(Coordinates::Full),
        };
        if let (Some(Choice::GaussLegendre), Some(Coordinates::Reduced), Some(value)) =
            (choice, coordinates, table.get("coordinates"))
        {
            value.reject(
                "gauss_legendre keeps the momentum in full coordinates, expected \"full\" or another integrator",
            );
            return None;
        }
        let tolerance = tolerance(table, choice);
        let scheme = match choice? {
            Choice::RungeKutta4 => Scheme::RungeKutta4,
            Choice::SemiImplicitEuler => Scheme::SemiImplicitEuler,
            Choice::GaussLegendre => Scheme::GaussLegendre,
            Choice::Adaptive => Scheme::Adaptive { tolerance: tolerance? },
        };
        Some(Self { scheme, coordinates: coordinates? })
    }
}

fn tolerance(table: &Table<'_>, choice: Option<Choice>) -> Option<f64> {
    let Some(value) = table.get("tolerance") else { return Some(DEFAULT_TOLERANCE) };
    if choice? != Choice::Adaptive {
        value.reject("only `integrator = \"adaptive\"` has a tolerance, expected that with it; others have a `step`");
        return None;
    }
    let tolerance = value.number(&TOLERANCE)?;
    let least = Adaptive::LEAST_TOLERANCE;
    if !(least..=MOST_TOLERANCE).contains(&tolerance) {
        value.reject(&format!(
            "expected {least:e} to {MOST_TOLERANCE:e}: less is lost in rounding, more is no longer a motion"
        ));
        return None;
    }
    Some(tolerance)
}
