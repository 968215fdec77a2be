//! Pictures of the robot: at the start, at each impact, and while it moves with what it holds.

use super::figure::{Figure, Series};
use super::frame::{self, Picture};
use super::robot::{arrow, expected, pin, robot, target};
use super::style::Colour;
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::contact::ContactKind;
use crate::scenario::{Detection, Scenario};
use crate::simulate::Sample;
use crate::simulate::system::Body;

/// Number of pictures of the motion after an impact.
const PICTURES: usize = 6;

/// The most impacts of one case that are shown.
const IMPACTS: usize = 6;

/// Length of the largest impulse's arrow, as part of the longest arm.
const ARROW: f64 = 0.3;

/// At the start and at the end of the approach; where contacts are found by detection, at each impact of each case.
pub(super) fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let (Some(start), Some(end)) = (study.approach.samples.first(), study.approach.end()) else { return Vec::new() };
    let mut before = robot(&scenario.layout, &start.state);
    let one = |name: &str, caption: &str, series| Figure {
        name: name.to_owned(),
        caption: caption.to_owned(),
        columns: 1,
        panels: frame::panels(vec![Picture { series, ..Picture::default() }]),
    };
    if scenario.contact.detection == Detection::Event {
        before.extend(scenario.targets.iter().enumerate().flat_map(|(i, object)| {
            let pose = object.position.map_or([0.0; 3], |[x, y]| [object.yaw, x, y]);
            target(object, colour(scenario, i), pose, std::iter::empty())
        }));
        let mut figures = vec![one("initial_configuration", "Robot and targets at the start of the approach.", before)];
        figures.extend(study.cases.iter().filter_map(|case| impacts(scenario, study, case)));
        return figures;
    }
    let mut at_start = expected_targets(scenario, "expected targets");
    at_start.extend(before);
    let mut at_impact = expected_targets(scenario, "expected targets");
    at_impact.extend(robot(&scenario.layout, &end.state));
    if let Some(case) = study.cases.first() {
        let touching = case.capture.iter().flat_map(|captured| &captured.impact.contacts).map(|one| one.touching);
        at_impact.extend(drawn_targets(scenario, &case.targets, end, &touching.collect::<Vec<_>>()).concat());
    }
    let (name, caption) = if scenario.targets.is_empty() {
        ("final_configuration", "The robot at the end of the approach.")
    } else {
        ("impact_configuration", "Robot and targets at the impact; dashed: where the targets were expected.")
    };
    vec![
        one("initial_configuration", "The robot at the start of the approach.", at_start),
        one(name, caption, at_impact),
    ]
}

/// The impacts of a case that were found by detection, or the end of an approach that met nothing.
fn impacts(scenario: &Scenario, study: &Study, case: &CaseResult) -> Option<Figure> {
    let approach = case.approach(study);
    let mut pictures = Vec::new();
    let picture = |title: String, now: &Sample, targets: &[Body], impulses: Vec<Series>, touching: &[ImpactContact]| {
        let mut series = expected_targets(scenario, "targets at the start");
        series.extend(robot(&scenario.layout, &now.state));
        series.extend(drawn_targets(scenario, targets, now, touching).concat());
        series.extend(impulses);
        Picture { title: Some(title), series, ..Picture::default() }
    };
    let at_contact = approach.end()?;
    if let Some(captured) = &case.capture {
        let all = || std::iter::once(&captured.impact).chain(captured.further.iter().map(|one| &one.impact));
        let sizes = all().flat_map(|impact| &impact.contacts).map(|one| one.impulse[1].hypot(one.impulse[2]));
        let largest = sizes.fold(0.0, f64::max);
        let reach = scenario.layout.arms.iter().map(crate::layout::Arm::reach).fold(0.0, f64::max);
        let per_impulse = if largest > 0.0 { ARROW * reach / largest } else { 0.0 };
        let first = (approach.duration, at_contact, &case.targets);
        let later = captured.further.iter().filter_map(|one| {
            let i = captured.post_impact.samples.iter().position(|sample| sample.time >= one.time)?;
            Some((approach.duration + one.time, captured.post_impact.samples.get(i)?, captured.targets.get(i)?))
        });
        for ((time, now, targets), impact) in std::iter::once(first).chain(later).zip(all()).take(IMPACTS) {
            let arrows = impact.contacts.iter().filter_map(|one| {
                let [_, x, y] = *now.end_effector_poses.get(one.touching.arm)?;
                let [_, fx, fy] = one.impulse.map(|part| part * per_impulse);
                arrow("impulse on the robot", [x, y], [fx, fy])
            });
            let touching: Vec<_> = impact.contacts.iter().map(|one| one.touching).collect();
            pictures.push(picture(format!("Impact at {time:.3} s"), now, targets, arrows.collect(), &touching));
        }
    } else {
        let title = format!("No contact by {} s", approach.duration);
        pictures.push(picture(title, at_contact, &case.targets, Vec::new(), &[]));
    }
    Some(Figure {
        name: format!("impact_configuration_{}", case.name),
        caption: format!("Robot and targets at each impact, {}; dashed: where the targets started.", case.name),
        columns: 2,
        panels: frame::panels(pictures),
    })
}

/// At equal times from the impact to the end.
pub(super) fn after_impact(scenario: &Scenario, case: &str, captured: &CaptureResult) -> Option<Figure> {
    let phase = &captured.post_impact;
    let last = phase.samples.len().checked_sub(1)?;
    let places = (0..PICTURES).map(|k| last * k / (PICTURES - 1));
    let shown = places.filter_map(|i| Some((phase.samples.get(i)?, captured.targets.get(i)?)));
    let since = if captured.impact.contacts.is_empty() { "approach" } else { "impact" };
    let pictures = shown.map(|(sample, targets)| {
        let held = held(captured, sample.time);
        let mut picture = Picture {
            title: Some(format!("{} s after the {since}", (sample.time * 1e3).round() / 1e3)),
            series: robot(&scenario.layout, &sample.state),
            ..Picture::default()
        };
        let drawn = drawn_targets(scenario, targets, sample, &held).into_iter().zip(targets).enumerate();
        for (i, (series, body)) in drawn {
            if held.iter().any(|touch| touch.target == i) {
                picture.series.extend(series);
            } else if let Some(object) = scenario.targets.get(i) {
                let [_, x, y] = body.pose;
                let touched = sample.time <= 0.0 && captured.impact.contacts.iter().any(|one| one.touching.target == i);
                picture.free.push(frame::Free { series, middle: [x, y], radius: object.surface.reach(), touched });
            }
        }
        picture
    });
    Some(Figure {
        name: format!("post_impact_motion_{case}"),
        caption: format!(
            "Robot and targets after the {since}, {case}; an arrow at the edge points to a target that is outside."
        ),
        columns: 3,
        panels: frame::panels(pictures.collect()),
    })
}

/// What is held at a time since the first impact.
fn held(captured: &CaptureResult, time: f64) -> Vec<ImpactContact> {
    let later = captured.further.iter().filter(|one| one.time <= time).map(|one| &one.impact);
    let contacts = std::iter::once(&captured.impact).chain(later).flat_map(|impact| &impact.contacts);
    contacts.map(|one| one.touching).filter(|touch| touch.law.kind().holds()).collect()
}

/// Each target where it is, with a line to each end effector that touches it.
fn drawn_targets(scenario: &Scenario, targets: &[Body], now: &Sample, touching: &[ImpactContact]) -> Vec<Vec<Series>> {
    let pairs = scenario.targets.iter().zip(targets).enumerate();
    pairs
        .map(|(i, (object, body))| {
            let end_effector = |touch: &ImpactContact| now.end_effector_poses.get(touch.arm).map(|[_, x, y]| [*x, *y]);
            let own = || touching.iter().filter(|touch| touch.target == i);
            let mut series = target(object, colour(scenario, i), body.pose, own().filter_map(end_effector));
            series.extend(own().filter(|touch| touch.law.kind() == ContactKind::Pin).filter_map(end_effector).map(pin));
            series
        })
        .collect()
}

/// A target's, after those of the arms.
fn colour(scenario: &Scenario, target: usize) -> Colour {
    Colour::of(scenario.layout.arms.len() + target)
}

fn expected_targets(scenario: &Scenario, label: &str) -> Vec<Series> {
    let placed = scenario.targets.iter().filter_map(|target| Some((target, target.position?)));
    placed.map(|(target, position)| expected(label, target, position)).collect()
}
