//! The velocities that meet at each contact, and what becomes of them.

use super::figure::{Axis, Figure, Mark, Panel, Series, Span};
use super::style::{Colour, Shape};
use super::time::LEAST;
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::impact::ImpactSolution;
use crate::capture::{CaseResult, Study};
use crate::contact::ContactKind;
use crate::scenario::Scenario;
use crate::simulate::Sample;
use crate::simulate::system::Body;

/// One contact of one case: twists of the end effector and of the target's contact point, before the impact and after
/// it.
struct Contact {
    name: String,
    /// End effector before, target before, target after, end effector after.
    twists: [[f64; 3]; 4],
    rigid: bool,
}

/// An impact with the samples on both sides of it.
struct Instant<'a> {
    impact: &'a ImpactSolution,
    before: &'a Sample,
    after: &'a Sample,
    targets: &'a [Body],
    /// Since the start of the approach, s; of impacts after the first.
    later: Option<f64>,
}

/// One panel per component; `None` where nothing is captured.
pub(super) fn velocities(scenario: &Scenario, study: &Study) -> Option<Figure> {
    let mut contacts: Vec<Contact> =
        study.cases.iter().flat_map(|result| contacts_of(scenario, study, result)).collect();
    if contacts.is_empty() {
        return None;
    }
    contacts.reverse(); // the first is to be on top
    // what is held rigidly moves as one: a bounce parts along the normal and slides along the surface, a pin turns
    let kinds = if contacts.iter().all(|contact| contact.rigid) {
        vec![
            ("tip, before", Colour::Blue, Shape::Circle),
            ("target, before", Colour::Vermillion, Shape::Square),
            ("both, after", Colour::Black, Shape::Cross),
        ]
    } else {
        vec![
            ("tip, before", Colour::Blue, Shape::Circle),
            ("target, before", Colour::Vermillion, Shape::Square),
            ("target, after", Colour::Green, Shape::Plus),
            ("tip, after", Colour::Black, Shape::Cross),
        ]
    };
    let panel = |(label, component): (&str, usize)| {
        let series = kinds.iter().enumerate().map(|(kind, (label, colour, shape))| Series {
            label: Some((*label).to_owned()),
            colour: *colour,
            mark: Mark::Points(*shape),
            points: (1_u32..).zip(&contacts).map(|(i, c)| (c.twists[kind][component], f64::from(i))).collect(),
        });
        let names = contacts.iter().map(|contact| contact.name.clone()).collect();
        let y = Axis { label: String::new(), span: Span::Names(names) };
        Panel::new(Axis::new(label, LEAST), y, series.collect())
    };
    let quantities = [("Velocity x [m/s]", 1), ("Velocity y [m/s]", 2), ("Angular velocity [rad/s]", 0)];
    let caption = "Twists of tip and target at each contact point, before the impact and after it (exact).";
    Some(Figure::column("impact_velocities", caption, quantities.map(panel).to_vec()))
}

fn contacts_of(scenario: &Scenario, study: &Study, result: &CaseResult) -> Vec<Contact> {
    instants(study, result).iter().flat_map(|instant| contacts(scenario, result, instant)).collect()
}

/// The impacts of a case.
fn instants<'a>(study: &'a Study, result: &'a CaseResult) -> Vec<Instant<'a>> {
    let approach = result.approach(study);
    let (Some(captured), Some(end)) = (&result.capture, approach.end()) else { return Vec::new() };
    let samples = &captured.post_impact.samples;
    let mut instants = Vec::new();
    if let Some(after) = samples.first() {
        instants.push(Instant { impact: &captured.impact, before: end, after, targets: &result.targets, later: None });
    }
    for further in &captured.further {
        // there are two samples at its time, or one at the very end
        let Some(i) = samples.iter().position(|sample| sample.time >= further.time) else { continue };
        let (Some(before), Some(targets)) = (samples.get(i), captured.targets.get(i)) else { continue };
        let after = samples.get(i + 1).unwrap_or(before);
        let later = Some(approach.duration + further.time);
        instants.push(Instant { impact: &further.impact, before, after, targets, later });
    }
    instants
}

fn contacts(scenario: &Scenario, result: &CaseResult, instant: &Instant<'_>) -> Vec<Contact> {
    let each = instant.impact.contacts.iter().filter_map(|contact| {
        let ImpactContact { target: i, arm, law, offset: [rx, ry], .. } = contact.touching;
        let kind = law.kind();
        let (target, before) = (scenario.targets.get(i)?, instant.targets.get(i)?);
        let after = *instant.impact.target_twists.get(i)?;
        let end_effector = |now: &Sample| now.end_effector_twists.get(arm).copied();
        // v + ω × r
        let at_contact = |[omega, vx, vy]: [f64; 3]| [omega, vx - ry * omega, vy + rx * omega];
        let mut name = match (target.touches.len(), scenario.layout.arms.get(arm)) {
            (2.., Some(arm)) => format!("{}, {} at {}", result.name, target.name, arm.name),
            _ => format!("{}, {}", result.name, target.name),
        };
        if let Some(time) = instant.later {
            name = format!("{name}, {time:.1} s");
        }
        if kind != ContactKind::Rigid {
            name = format!("{name} ({})", kind.name());
        }
        Some(Contact {
            name,
            twists: [
                end_effector(instant.before)?,
                at_contact(before.twist),
                at_contact(after),
                end_effector(instant.after)?,
            ],
            rigid: kind == ContactKind::Rigid,
        })
    });
    each.collect()
}
