//! Snapshots of robot and targets: at the start, at each impact, and during the post-impact motion.

use super::clearance::overlapping;
use super::figure::{Figure, Series};
use super::robot::{arrow, expected_target, pin, robot, target};
use super::snapshot::{FreeTarget, Snapshot, close_ups, panels};
use super::style::Colour;
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::layout::Arm;
use crate::output::animation::significant;
use crate::output::impacts::{ImpactEvent, impacts, time_digits};
use crate::output::scene::target_colour_index;
use crate::scenario::{Detection, Scenario};
use crate::simulate::Sample;
use crate::simulate::system::Body;

/// Number of snapshots of a post-impact motion.
const SNAPSHOTS: usize = 6;

/// Most impacts of one case that are pictured: of many bounces most pictures are nearly equal.
const MOST: usize = 6;

/// Length of the arrow of the largest impulse over the length of the longest arm.
const ARROW: f64 = 0.3;

/// The same in a close-up, over the length of the arm's last link.
const CLOSE_ARROW: f64 = 0.6;

/// The configuration at the start and at the end of the approach; with contact detection instead of the latter, at each
/// impact of each case.
pub(super) fn figures(scenario: &Scenario, study: &Study) -> Vec<Figure> {
    let (start, end) = (&study.approach.samples[0], study.approach.end());
    let at_start = robot(&scenario.layout, &start.state);
    let single = |name: &str, series| Figure::column(name, panels(vec![Snapshot { series, ..Snapshot::default() }]));
    if scenario.contact.detection == Detection::Event {
        let targets = scenario.targets.iter().enumerate().flat_map(|(i, object)| {
            let [x, y] = object.position.expect("contact detection requires the position of every target");
            target(object, target_colour(scenario, i), [object.yaw, x, y], &[])
        });
        let series = at_start.into_iter().chain(targets).collect();
        let mut figures = vec![single("initial_configuration", series)];
        figures.extend(study.cases.iter().map(|case| impacts_of_case(scenario, study, case)));
        return figures;
    }
    let expected = || expected_targets(scenario, "expected targets");
    let mut at_end = [expected(), robot(&scenario.layout, &end.state)].concat();
    if let Some(case) = study.cases.first() {
        let contacts = case.capture.iter().flat_map(|capture| &capture.impact.contacts).map(|result| result.contact);
        at_end.extend(targets(scenario, &case.targets, end, &contacts.collect::<Vec<_>>()).concat());
    }
    let end_name = if scenario.targets.is_empty() { "final_configuration" } else { "impact_configuration" };
    vec![single("initial_configuration", [expected(), at_start].concat()), single(end_name, at_end)]
}

/// The impacts of a case that were found by detection, several as close-ups; or the end of an approach without contact.
fn impacts_of_case(scenario: &Scenario, study: &Study, case: &CaseResult) -> Figure {
    let events = impacts(study, case);
    let mut title = None;
    let panels = if events.is_empty() {
        let approach = case.approach(study);
        let title = format!("No contact by {} s", approach.duration);
        panels(vec![detected(scenario, title, approach.end(), &case.targets, &[])])
    } else {
        let times: Vec<_> = events.iter().map(|event| event.time).collect();
        let (digits, count) = (time_digits(&times), events.len());
        let of = |(i, event): (usize, &ImpactEvent<'_>)| {
            let which = if count > MOST { format!("Impact {}:", i + 1) } else { "Impact at".to_owned() };
            at_impact(scenario, event, &format!("{which} {:.digits$} s", event.time), count > 1)
        };
        let shown = telling(&events.iter().map(largest_impulse).collect::<Vec<_>>());
        if shown.len() < count {
            let (shown, left) = (shown.len(), count - shown.len());
            title = Some(format!("{shown} of {count} impacts: first, last, largest; {left} left out"));
        }
        close_ups(shown.into_iter().map(|i| of((i, &events[i]))).collect())
    };
    Figure { name: format!("impact_configuration_{}", case.name), title, columns: 2, panels }
}

/// The places of the impacts that are pictured, of the largest impulses of all: the first, the last, and the largest between.
fn telling(impulses: &[f64]) -> Vec<usize> {
    let last = impulses.len() - 1;
    let mut between: Vec<_> = (1..last.max(1)).collect();
    between.sort_by(|a, b| impulses[*b].total_cmp(&impulses[*a]));
    between.truncate(MOST - 2);
    let mut shown = [vec![0, last], between].concat();
    shown.sort_unstable();
    shown.dedup();
    shown
}

/// Of the contacts of an impact, N s.
fn largest_impulse(event: &ImpactEvent<'_>) -> f64 {
    let contacts = event.solution.contacts.iter();
    contacts.map(|result| libm::hypot(result.impulse[1], result.impulse[2])).fold(0.0, f64::max)
}

/// Robot and targets where a contact is detected, or is not.
fn detected(scenario: &Scenario, title: String, now: &Sample, bodies: &[Body], contacts: &[ImpactContact]) -> Snapshot {
    let mut series = expected_targets(scenario, "targets at the start");
    series.extend(robot(&scenario.layout, &now.state));
    series.extend(targets(scenario, bodies, now, contacts).concat());
    Snapshot { title: Some(title), series, ..Snapshot::default() }
}

/// An impact with its impulses, the greatest of them in its title: arrows of several impacts have a scale each, as each may
/// be a small part of the one before.
fn at_impact(scenario: &Scenario, event: &ImpactEvent<'_>, title: &str, is_one_of_several: bool) -> Snapshot {
    let results = &event.solution.contacts;
    let largest = largest_impulse(event);
    let up_to = if results.len() > 1 { "up to " } else { "" };
    let contacts: Vec<_> = results.iter().map(|result| result.contact).collect();
    let title = format!("{title}, {up_to}{} N s", significant(largest));
    let mut snapshot = detected(scenario, title, event.before, event.targets, &contacts);
    let last_link = |arm: usize| scenario.layout.arms[arm].links.last().map_or(0.0, |link| link.length);
    // in a close-up there is the last link to compare it with
    let (length, label) = if is_one_of_several {
        let longest = contacts.iter().map(|contact| last_link(contact.arm)).fold(0.0, f64::max);
        (CLOSE_ARROW * longest, "impulse on the robot (own scale)")
    } else {
        (ARROW * scenario.layout.arms.iter().map(Arm::reach).fold(0.0, f64::max), "impulse on the robot")
    };
    for result in results.iter().filter(|_| largest > 0.0) {
        let [yaw, x, y] = event.before.end_effector_poses[result.contact.arm];
        let [_, fx, fy] = result.impulse.map(|part| part * length / largest);
        snapshot.series.extend(arrow(label, [x, y], [fx, fy]));
        // the arrow, the last link, and the target that it meets
        let back = last_link(result.contact.arm);
        snapshot.focus.extend([(x + fx, y + fy), (x, y), (x - back * libm::cos(yaw), y - back * libm::sin(yaw))]);
        let target = result.contact.target;
        let [_, x, y] = event.targets[target].pose;
        let reach = scenario.targets[target].outline.reach();
        snapshot.focus.extend([(x - reach, y - reach), (x + reach, y + reach)]);
    }
    snapshot
}

/// The post-impact motion at equal intervals.
pub(super) fn post_impact_motion(
    scenario: &Scenario,
    study: &Study,
    case: &CaseResult,
    capture: &CaptureResult,
) -> Figure {
    let samples = &capture.post_impact.samples;
    let since = if capture.impact.contacts.is_empty() { "approach" } else { "impact" };
    let events = impacts(study, case);
    let contacts_until = |i: usize| {
        let past = events.iter().filter(move |event| event.after <= i);
        past.flat_map(|event| &event.solution.contacts).map(|result| result.contact)
    };
    let snapshots = (0..SNAPSHOTS).map(|k| {
        let i = (samples.len() - 1) * k / (SNAPSHOTS - 1);
        let (sample, bodies) = (&samples[i], &capture.targets[i]);
        let held: Vec<_> = contacts_until(i).filter(|contact| contact.law.kind().holds()).collect();
        let mut snapshot = Snapshot {
            title: Some(format!("{} s after the {since}", (sample.time * 1e3).round() / 1e3)),
            series: robot(&scenario.layout, &sample.state),
            ..Snapshot::default()
        };
        let time = case.approach(study).duration + sample.time;
        for (target, series) in targets(scenario, bodies, sample, &held).into_iter().enumerate() {
            if held.iter().any(|contact| contact.target == target) {
                snapshot.series.extend(series);
                continue;
            }
            let [_, x, y] = bodies[target].pose;
            snapshot.free.push(FreeTarget {
                series,
                centre: [x, y],
                radius: scenario.targets[target].outline.reach(),
                in_contact: i == 0 && contacts_until(0).any(|contact| contact.target == target),
            });
        }
        snapshot.series.extend(overlapping(scenario, (study, case), time, &sample.state, bodies));
        snapshot
    });
    let name = format!("post_impact_motion_{}", case.name);
    Figure { name, title: None, columns: 3, panels: panels(snapshots.collect()) }
}

/// The series of each target, with a line to each end effector in contact with it.
fn targets(scenario: &Scenario, bodies: &[Body], now: &Sample, contacts: &[ImpactContact]) -> Vec<Vec<Series>> {
    let pairs = scenario.targets.iter().zip(bodies).enumerate();
    pairs
        .map(|(i, (object, body))| {
            let own = contacts.iter().filter(|contact| contact.target == i);
            let (mut points, mut pins) = (Vec::new(), Vec::new());
            for contact in own {
                let [_, x, y] = now.end_effector_poses[contact.arm];
                points.push([x, y]);
                if contact.law.kind().holds() && !contact.law.kind().holds_yaw() {
                    pins.push(pin([x, y]));
                }
            }
            let mut series = target(object, target_colour(scenario, i), body.pose, &points);
            series.extend(pins);
            series
        })
        .collect()
}

/// The colours of the targets follow those of the arms.
fn target_colour(scenario: &Scenario, target: usize) -> Colour {
    Colour::of(target_colour_index(scenario.layout.arms.len(), target))
}

fn expected_targets(scenario: &Scenario, label: &str) -> Vec<Series> {
    let placed = scenario.targets.iter().filter_map(|target| Some((target, target.position?)));
    placed.map(|(target, position)| expected_target(label, target, position)).collect()
}
