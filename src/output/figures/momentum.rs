//! The momentum of robot and targets together, before and after the impact.

use super::figure::{Axis, Figure, Mark, Panel, Series, Span};
use super::style::{Colour, Dash, Shape};
use super::time::CURVE;
use crate::capture::{CaseResult, Study};
use crate::scenario::Scenario;
use crate::simulate::Phase;

/// Part of the momentum that the moving bodies could have which an axis shows at least: less of it is rounding.
const LEAST_PART: f64 = 0.01;

/// [l, px, py] over the whole case; dashed, what the paper's literal equations would leave of it.
pub(super) fn figure(scenario: &Scenario, study: &Study, result: &CaseResult) -> Figure {
    let captured = result.capture.as_ref();
    let approach = result.approach(study);
    let (free, _) = result.targets_momentum();
    let contact = approach.duration;
    let duration = contact + captured.map_or(0.0, |captured| captured.post_impact.duration);
    let least = least(scenario, study);
    let curve = |label: &str, component: usize, colour: Colour, dash: Dash| {
        let mut points = part(approach, 0.0, component, free[component]);
        if let Some(captured) = captured {
            points.extend(part(&captured.post_impact, contact, component, 0.0));
        }
        Series { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, CURVE), points }
    };
    let literal = |label: &str, component: usize, colour: Colour| {
        let captured = captured?;
        let before = part(approach, 0.0, component, free[component]).pop()?.1;
        let left = before + captured.impact.paper.as_ref()?.momentum_jump[component];
        let mark = Mark::Line(Dash::DashDot, CURVE);
        Some(Series {
            label: Some(format!("{label}, literal eqs.")),
            colour,
            mark,
            points: vec![(contact, left), (duration, left)],
        })
    };
    let panel = |quantity: &str, least, curves: &[(&str, usize, Colour, Dash)]| {
        let solid = curves.iter().map(|(label, i, colour, dash)| curve(label, *i, *colour, *dash));
        let broken = curves.iter().filter_map(|(label, i, colour, _)| literal(label, *i, *colour));
        let mut series: Vec<Series> = solid.chain(broken).collect();
        series.extend(impacts(study, result, &series, curves.len()));
        let y = Axis { label: quantity.to_owned(), span: Span::DataAndZero(least) };
        Panel::new(Axis::time("Time [s]", duration), y, series)
    };
    let linear = [("px", 1, Colour::Blue, Dash::Solid), ("py", 2, Colour::Vermillion, Dash::Dashed)];
    let angular = [("l", 0, Colour::Blue, Dash::Solid)];
    Figure::column(
        &format!("momentum_{}", result.name),
        &format!("Momentum of robot and targets together, about the inertial origin, {}.", result.name),
        vec![panel("Linear momentum [N s]", least[1], &linear), panel("Angular momentum [N m s]", least[0], &angular)],
    )
}

/// Marks on the first curves where impacts were found by detection.
fn impacts(study: &Study, result: &CaseResult, series: &[Series], curves: usize) -> Option<Series> {
    let captured = result.capture.as_ref().filter(|_| result.approach.is_some())?;
    let first = result.approach(study).duration;
    let times: Vec<f64> = captured.further.iter().map(|one| first + one.time).chain([first]).collect();
    let on = |curve: &Series| {
        let at = |time: &f64| curve.points.iter().find(|(t, _)| t >= time).copied();
        times.iter().filter_map(at).collect::<Vec<_>>()
    };
    let points: Vec<_> = series.iter().take(curves).flat_map(on).collect();
    let mark = Mark::Points(Shape::Cross);
    Some(Series { label: Some("impacts".to_owned()), colour: Colour::Black, mark, points })
}

/// One component of the robot's momentum over a phase, `more` added.
fn part(phase: &Phase, start: f64, component: usize, more: f64) -> Vec<(f64, f64)> {
    let value = |s: &crate::simulate::Sample| match component {
        0 => s.momentum.angular_momentum,
        i => s.momentum.linear_momentum[i - 1],
    };
    phase.samples.iter().map(|sample| (start + sample.time, value(sample) + more)).collect()
}

/// [angular, linear]: a part of what the robot would have if all its kinetic energy were in one motion.
fn least(scenario: &Scenario, study: &Study) -> [f64; 2] {
    let energy = study.approach.samples.iter().fold(0.0, |most: f64, sample| most.max(sample.momentum.kinetic_energy));
    [scenario.layout.base.inertia, scenario.layout.mass()].map(|inertia| LEAST_PART * (2.0 * energy * inertia).sqrt())
}
