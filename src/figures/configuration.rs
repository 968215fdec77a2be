//! Pictures of the robot: at the start, at the impact, and while it moves with what it holds.

use super::figure::{Axis, Figure, Panel, Series, Span};
use super::robot::{expected, robot, target};
use super::style::Colour;
use crate::scenario::Scenario;
use crate::simulate::Sample;
use crate::simulate::system::Body;
use crate::study::{Captured, Study};

/// Number of pictures of the motion after an impact.
const PICTURES: usize = 6;

/// At the start and at the end of the approach.
pub(super) fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    // at the contact of the first case, where that is found by detection
    let (approach, targets) =
        study.cases.first().map_or((&study.approach, &[][..]), |case| (case.approach(study), &case.targets));
    let (Some(start), Some(end)) = (approach.samples.first(), approach.end()) else { return Vec::new() };
    let mut before = expected_targets(scenario);
    before.extend(robot(&scenario.layout, &start.motion));
    let mut at_impact = expected_targets(scenario);
    at_impact.extend(robot(&scenario.layout, &end.motion));
    at_impact.extend(drawn_targets(scenario, targets, end));
    let one = |name: &str, caption: &str, series| Figure {
        name: name.to_owned(),
        caption: caption.to_owned(),
        columns: 1,
        panels: pictures(&[(None, series)]),
    };
    let (name, caption) = if scenario.targets.is_empty() {
        ("final_configuration", "The robot at the end of the approach.")
    } else {
        ("impact_configuration", "Robot and targets at the impact; dashed: where the targets were expected.")
    };
    vec![one("initial_configuration", "The robot at the start of the approach.", before), one(name, caption, at_impact)]
}

/// At equal times from the impact to the end.
pub(super) fn after_impact(scenario: &Scenario, case: &str, captured: &Captured) -> Option<Figure> {
    let phase = &captured.post_impact;
    let last = phase.samples.len().checked_sub(1)?;
    let places = (0..PICTURES).map(|k| last * k / (PICTURES - 1));
    let shown = places.filter_map(|i| Some((phase.samples.get(i)?, captured.targets.get(i)?)));
    let drawn = shown.map(|(sample, targets)| {
        let mut series = robot(&scenario.layout, &sample.motion);
        series.extend(drawn_targets(scenario, targets, sample));
        (Some(format!("{} s after the impact", (sample.time * 1e3).round() / 1e3)), series)
    });
    Some(Figure {
        name: format!("post_impact_motion_{case}"),
        caption: format!("Robot and targets after the impact, {case}."),
        columns: 3,
        panels: pictures(&drawn.collect::<Vec<_>>()),
    })
}

/// The targets where they are, each with a line to its tip where that is at its outline.
fn drawn_targets(scenario: &Scenario, targets: &[Body], now: &Sample) -> Vec<Series> {
    let mut series = Vec::new();
    for (i, (object, body)) in scenario.targets.iter().zip(targets).enumerate() {
        let colour = Colour::of(scenario.layout.arms.len() + i);
        let tips = object.touches.iter().filter_map(|touch| now.end_effector_poses.get(touch.arm));
        series.extend(target(object, colour, body.pose, tips.map(|[_, x, y]| [*x, *y])));
    }
    series
}

fn expected_targets(scenario: &Scenario) -> Vec<Series> {
    let placed = scenario.targets.iter().filter_map(|target| Some((target, target.position?)));
    placed.map(|(target, position)| expected("expected targets", target, position)).collect()
}

/// Panels of one scale that hold everything.
fn pictures(drawn: &[(Option<String>, Vec<Series>)]) -> Vec<Panel> {
    let all = || drawn.iter().flat_map(|(_, series)| series).flat_map(|series| &series.points);
    let span = |values: &mut dyn Iterator<Item = f64>| {
        let (low, high) = values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)));
        let margin = 0.04 * (high - low).max(1e-3);
        (low - margin, high + margin)
    };
    let (x, y) = (span(&mut all().map(|p| p.0)), span(&mut all().map(|p| p.1)));
    // square panels: the longer side decides
    let half = (x.1 - x.0).max(y.1 - y.0) / 2.0;
    let about = |(low, high): (f64, f64)| {
        let middle = f64::midpoint(low, high);
        Span::Between(middle - half, middle + half)
    };
    let axis = |label: &str, span| Axis { label: label.to_owned(), span };
    drawn
        .iter()
        .map(|(title, series)| Panel {
            title: title.clone(),
            x: axis("x [m]", about(x)),
            y: axis("y [m]", about(y)),
            equal_scale: true,
            series: series.clone(),
        })
        .collect()
}
