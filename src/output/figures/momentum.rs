//! The momentum of robot and targets together over a case.

use super::figure::{Axis, AxisRange, Figure, Panel, Series};
use super::style::{Colour, Dash, Symbol};
use super::time_curves::CURVE_WIDTH;
use crate::capture::{CaseResult, Study};
use crate::output::impacts::impacts;
use crate::output::time_series::rows;
use crate::scenario::Scenario;

/// Smallest span of an axis over the momentum that the kinetic energy could hold; rounding errors are far below.
const MINIMUM_SPAN: f64 = 0.01;

/// Change of a momentum, over the smallest span of its axis, up to which its curve is said to be level.
const FLAT: f64 = 1e-6;

/// What a panel of level curves says.
const CONSTANT: &str = "constant to rounding";

/// Whether values are the same but for rounding errors.
fn is_flat(values: impl Iterator<Item = f64>, span: f64) -> bool {
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), value| (low.min(value), high.max(value)));
    high - low <= FLAT * span
}

/// [l, px, py] about the inertial origin; in grey, the values after the first impact by the paper's literal equations.
pub(super) fn figure(scenario: &Scenario, study: &Study, case: &CaseResult) -> Figure {
    let momentum: Vec<(f64, [f64; 3])> = rows(study, case)
        .map(|row| {
            let total = row.total_momentum;
            let [px, py] = total.linear_momentum;
            (row.time, [total.angular_momentum, px, py])
        })
        .collect();
    let (contact, before) = momentum[case.approach(study).samples.len() - 1];
    let (end, _) = momentum[momentum.len() - 1];
    let paper = case.capture.as_ref().and_then(|capture| capture.impact.paper.as_ref());
    let panel = |quantity: &str, span: f64, curves: &[(&str, usize, Colour, Dash)]| {
        let exact = curves.iter().map(|&(label, i, colour, dash)| {
            let points = momentum.iter().map(|(time, value)| (*time, value[i]));
            Series::line(label, colour, dash, CURVE_WIDTH, points.collect())
        });
        let literal = curves.iter().filter_map(|&(label, i, _, dash)| {
            let after = before[i] + paper?.momentum_jump[i];
            let (label, points) = (format!("{label}, literal eqs."), vec![(contact, after), (end, after)]);
            Some(Series::line(&label, Colour::GREY, dash, CURVE_WIDTH, points))
        });
        let mut all: Vec<Series> = exact.chain(literal).collect();
        all.extend(detected_impacts(study, case, &all[..curves.len()]));
        let flat = curves.iter().all(|&(_, i, ..)| is_flat(momentum.iter().map(|(_, value)| value[i]), span));
        let y = Axis { label: quantity.to_owned(), range: AxisRange::DataAndZero(span) };
        let title = flat.then(|| format!("{}{CONSTANT}", if paper.is_some() { "exact equations: " } else { "" }));
        Panel { title, ..Panel::new(Axis::time("Time [s]", end), y, all) }
    };
    let linear = [("px", 1, Colour::BLACK, Dash::Solid), ("py", 2, Colour::BLACK, Dash::Dashed)];
    let angular = [("l", 0, Colour::BLACK, Dash::Solid)];
    // a part of the momentum if all kinetic energy were in one motion
    let energy = rows(study, case).fold(0.0, |most: f64, row| most.max(row.total_momentum.kinetic_energy));
    let span = |inertia: f64| MINIMUM_SPAN * (2.0 * energy * inertia).sqrt();
    Figure::column(
        &format!("momentum_{}", case.name),
        vec![
            panel("Linear momentum [N s]", span(scenario.layout.mass()), &linear),
            panel("Angular momentum [N m s]", span(scenario.layout.base.inertia), &angular),
        ],
    )
}

/// Symbols on the curves at the impacts that were found by detection.
fn detected_impacts(study: &Study, case: &CaseResult, curves: &[Series]) -> Option<Series> {
    case.capture.as_ref().filter(|_| case.approach.is_some())?;
    let events = impacts(study, case);
    let on = |curve: &Series| {
        let at = |time: f64| curve.points[curve.points.partition_point(|(t, _)| *t < time)];
        events.iter().map(|event| at(event.time)).collect::<Vec<_>>()
    };
    Some(Series::symbols("impacts", Colour::BLACK, Symbol::Cross, curves.iter().flat_map(on).collect()))
}
