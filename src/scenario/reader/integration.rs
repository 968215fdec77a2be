//! `integrator`, `tolerance` and `coordinates`: how a phase is integrated.

use super::read_or;
use crate::diagnostic::{NumberRule, Table};
use crate::integrate::Adaptive;
use crate::simulate::stepper::{Formulation, Integration, Scheme};

const TOLERANCE: NumberRule = NumberRule::positive("a tolerance", "parts of 1");

/// Largest tolerance: beyond it an integrator of order 9 follows no motion.
const LARGEST_TOLERANCE: f64 = 1e-3;

pub(super) fn integration(table: &Table<'_>) -> Option<Integration> {
    let scheme = read_or(table, "integrator", Scheme::RungeKutta4, |value| {
        value.choice(&Scheme::ALL.iter().map(|scheme| (scheme.properties().name, *scheme)).collect::<Vec<_>>())
    });
    let coordinates = read_or(table, "coordinates", Formulation::Full, |value| {
        let coordinates = value.choice(&[("full", Formulation::Full), ("reduced", Formulation::Reduced)])?;
        let properties = scheme.map(Scheme::properties).filter(|properties| properties.is_canonical);
        if let (Some(properties), Formulation::Reduced) = (properties, coordinates) {
            let name = properties.name;
            value.reject(&format!(
                "{name} keeps the momentum in full coordinates, expected \"full\" or another integrator"
            ));
            return None;
        }
        Some(coordinates)
    });
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
    let smallest = Adaptive::SMALLEST_TOLERANCE;
    if !(smallest..=LARGEST_TOLERANCE).contains(&tolerance) {
        value.reject(&format!(
            "expected {smallest:e} to {LARGEST_TOLERANCE:e}: less is lost in rounding, more is no longer a motion"
        ));
        return None;
    }
    Some(tolerance)
}
