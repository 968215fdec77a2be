//! `integrator`, `tolerance` and `coordinates`: how a phase is integrated.

use super::read_or;
use crate::diagnostic::{NumberRule, Table};
use crate::integrate::Adaptive;
use crate::simulate::stepper::{Formulation, Integration, Integrator};

const TOLERANCE: NumberRule = NumberRule::positive("a tolerance", "parts of 1");

/// Largest tolerance: beyond it an integrator of order 9 follows no motion.
const LARGEST_TOLERANCE: f64 = 1e-3;

/// Keys of torques that are held, or cut off at a limit: the motion has kinks, which adaptive steps would search for.
const KINKS: [&str; 3] = ["sample_time", "torque_limits", "base_torque_limit"];

/// Adaptive where no key is given and the motion is smooth.
pub(super) fn integration(table: &Table<'_>) -> Option<Integration> {
    let is_smooth = KINKS.iter().all(|key| table.get(key).is_none());
    let default = if is_smooth {
        Integrator::Adaptive { tolerance: Integrator::DEFAULT_TOLERANCE }
    } else {
        Integrator::RungeKutta4
    };
    let integrator = read_or(table, "integrator", default, |value| {
        value.choice(
            &Integrator::ALL.iter().map(|integrator| (integrator.properties().name, *integrator)).collect::<Vec<_>>(),
        )
    });
    let coordinates = read_or(table, "coordinates", Formulation::Full, |value| {
        let coordinates = value.choice(&[("full", Formulation::Full), ("reduced", Formulation::Reduced)])?;
        let properties = integrator.map(Integrator::properties).filter(|properties| properties.is_canonical);
        if let (Some(properties), Formulation::Reduced) = (properties, coordinates) {
            let name = properties.name;
            value.reject(&format!(
                "{name} keeps the momentum in full coordinates, expected \"full\" or another integrator"
            ));
            return None;
        }
        Some(coordinates)
    });
    let tolerance = tolerance(table, integrator);
    let integrator = match integrator? {
        Integrator::Adaptive { .. } => Integrator::Adaptive { tolerance: tolerance? },
        integrator => integrator,
    };
    Some(Integration { integrator, coordinates: coordinates? })
}

fn tolerance(table: &Table<'_>, integrator: Option<Integrator>) -> Option<f64> {
    let Some(value) = table.get("tolerance") else { return Some(Integrator::DEFAULT_TOLERANCE) };
    if !integrator?.properties().is_adaptive {
        value.reject("only `integrator = \"adaptive\"` has a tolerance, expected that with it; others have a `step`");
        return None;
    }
    let tolerance = value.number(&TOLERANCE)?;
    let smallest = Adaptive::SMALLEST_TOLERANCE;
    if !(smallest..=LARGEST_TOLERANCE).contains(&tolerance) {
        value.reject(&format!(
            "expected {smallest:e} to {LARGEST_TOLERANCE:e}: a smaller one is below rounding errors, with a larger one the motion is wrong"
        ));
        return None;
    }
    Some(tolerance)
}
