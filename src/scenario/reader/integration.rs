//! `integrator`, `tolerance` and `coordinates`: how a phase is integrated.

use crate::diagnostic::Table;
use crate::simulate::stepper::{Formulation, Integration, Integrator};

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
    let integrator = table.read_or("integrator", default, |value| {
        value.choice(
            &Integrator::ALL.iter().map(|integrator| (integrator.properties().name, *integrator)).collect::<Vec<_>>(),
        )
    });
    let coordinates = table.read_or("coordinates", Formulation::Full, |value| {
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
    if let Some(value) = table.get("tolerance")
        && !integrator?.properties().is_adaptive
    {
        value.reject("only `integrator = \"adaptive\"` has a tolerance, expected that with it; others have a `step`");
        return None;
    }
    table.number("tolerance")
}
