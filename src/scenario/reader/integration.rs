//! `integrator`, `tolerance` and `coordinates`: how a phase is integrated.

use crate::diagnostic::{NumberRule, Table};
use crate::integrate::Adaptive;
use crate::simulate::integration::{Formulation, Integration, Scheme};

pub(super) const KEYS: [&str; 3] = ["integrator", "tolerance", "coordinates"];

const TOLERANCE: NumberRule = NumberRule::positive("a tolerance", "parts of 1");

/// Looser is no longer what anybody wants of an order 9.
const MOST_TOLERANCE: f64 = 1e-3;

pub(super) fn integration(table: &Table<'_>) -> Option<Integration> {
    let scheme = match table.get("integrator") {
        Some(value) => value.choice(&Scheme::ALL.map(|scheme| (scheme.properties().name, scheme))),
        None => Some(Scheme::RungeKutta4),
    };
    let coordinates = match table.get("coordinates") {
        Some(value) => value.choice(&[("full", Formulation::Full), ("reduced", Formulation::Reduced)]),
        None => Some(Formulation::Full),
    };
    if let (Some(scheme), Some(Formulation::Reduced), Some(value)) = (scheme, coordinates, table.get("coordinates"))
        && scheme.properties().is_canonical
    {
        let name = scheme.properties().name;
        value
            .reject(&format!("{name} keeps the momentum in full coordinates, expected \"full\" or another integrator"));
        return None;
    }
    let tolerance = tolerance(table, scheme);
    let scheme = match scheme? {
        Scheme::Adaptive { .. } => Scheme::Adaptive { tolerance: tolerance? },
        scheme => scheme,
    };
    Some(Integration { scheme, coordinates: coordinates? })
}

fn tolerance(table: &Table<'_>, scheme: Option<Scheme>) -> Option<f64> {
    let Some(value) = table.get("tolerance") else { return Some(Scheme::DEFAULT_TOLERANCE) };
    if !scheme?.properties().is_adaptive {
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
