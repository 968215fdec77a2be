//! What would keep the bounds of the audit: shorter steps, or a smaller tolerance.
//!
//! The error of steps of length h and order p is C hᵖ, and that of adaptive steps is proportional to their tolerance. From the
//! error r times its bound follow the step h (s/r)^(1/p) and the tolerance times s/r that leave a share s of the bound. Where
//! actuators were at their limits, kinks in the torques make the order 1.
//!
//! # Example
//! ```
//! use planar_capture::capture::{Silent, step_advice::step_advice, study};
//! use planar_capture::registry;
//! use planar_capture::scenario::Scenario;
//!
//! let path = "scenarios/raina_shah_2017.toml";
//! let mut scenario = Scenario::read(path.as_ref(), registry::SHIPPED).expect("a scenario");
//! scenario.approach.step = 0.05; // s, in place of 0.005 s
//! let robot = registry::generated(&scenario.layout)?;
//! let study = study(&scenario, &|| robot.clone_box(), 1.0, &mut Silent)?;
//! let advice = "[approach] is integrated by `rk4` with steps of 0.05 s: `step = 0.01` would probably do, or `integrator = \"adaptive\"`";
//! assert_eq!(step_advice(&scenario, &study), [advice]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::{Study, over_bounds};
use crate::integrate::Adaptive;
use crate::scenario::Scenario;
use crate::simulate::stepper::{Integration, Integrator};
use crate::simulate::{Phase, Saturation};

/// The share of a bound that is aimed at.
const SHARE: f64 = 0.5;

/// Beyond so many steps of a phase no shorter step is advised where steps can follow from a tolerance.
const MOST_STEPS: f64 = 1e6;

/// Errors so many times beyond their bounds are those of steps that have lost the motion, and have no order.
const LOST: f64 = 1e7;

/// For each table of the scenario with a phase beyond a bound of the audit, how it was integrated and what would do.
#[must_use]
pub fn step_advice(scenario: &Scenario, study: &Study) -> Vec<String> {
    let Scenario { approach, post_impact, .. } = scenario;
    let approaches = study.cases.iter().filter_map(|case| case.approach.as_ref());
    let approaches: Vec<_> = study.common_approach().into_iter().chain(approaches).collect();
    let before = advice("approach", [approach.duration, approach.step], approach.integration, &approaches);
    // a momentum that drifts because a target is heavy has a remedy of its own
    let captured = study.cases.iter().filter_map(|case| case.capture.as_ref());
    let captured = captured.filter(|capture| capture.heavy_target.is_none());
    let phases: Vec<_> = captured.map(|capture| &capture.post_impact).collect();
    let after = post_impact.as_ref();
    let after = after.and_then(|after| advice("post_impact", [after.duration, after.step], after.integration, &phases));
    before.into_iter().chain(after).collect()
}

fn advice(
    table: &str,
    [duration, step]: [f64; 2],
    Integration { integrator, .. }: Integration,
    phases: &[&Phase],
) -> Option<String> {
    let ratios = phases.iter().flat_map(|phase| over_bounds(phase)).map(|(_, value, bound)| value / bound);
    let worst = ratios.reduce(f64::max).filter(|ratio| ratio.is_finite())?;
    let name = integrator.properties().name;
    if let Integrator::Adaptive { tolerance } = integrator {
        let wanted = rounded_down(tolerance * SHARE / worst);
        let remedy = if wanted >= Adaptive::SMALLEST_TOLERANCE {
            format!("`tolerance = {wanted:e}` would probably do")
        } else {
            format!("even the smallest, {:e}, would not do", Adaptive::SMALLEST_TOLERANCE)
        };
        return Some(format!("[{table}] is integrated by `{name}` with a tolerance of {tolerance:e}: {remedy}"));
    }
    let is_limited = phases.iter().any(|phase| {
        let Saturation { joints, base } = &phase.saturation;
        *base > 0.0 || joints.iter().any(|time| *time > 0.0)
    });
    let order = if is_limited { 1 } else { integrator.properties().order? };
    let wanted = rounded_down(step * libm::pow(SHARE / worst, 1.0 / f64::from(order)));
    let remedy = if is_limited && duration / wanted > MOST_STEPS {
        "they have to be far shorter, or `integrator = \"adaptive\"`".to_owned()
    } else if is_limited {
        format!("`step = {wanted}` would probably do")
    } else if worst > LOST || duration / wanted > MOST_STEPS {
        "`integrator = \"adaptive\"` would do".to_owned()
    } else {
        format!("`step = {wanted}` would probably do, or `integrator = \"adaptive\"`")
    };
    Some(format!("[{table}] is integrated by `{name}` with steps of {step} s: {remedy}"))
}

/// A number with its first digit alone.
fn rounded_down(value: f64) -> f64 {
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let first = digits.get(..1).unwrap_or(digits);
    format!("{first}e{exponent}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests;
