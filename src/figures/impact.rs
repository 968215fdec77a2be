//! The velocities that meet at each contact, and the one that both have after it.

use super::figure::{Axis, Figure, Mark, Panel, Series, Span};
use super::style::{Colour, Shape};
use super::time::LEAST;
use crate::scenario::Scenario;
use crate::study::Study;
use crate::study::meeting::Touching;

/// One contact of one case: twists of the tip, of the target's contact point, and of both after the impact.
struct Contact {
    name: String,
    twists: [[f64; 3]; 3],
}

/// One panel per component; `None` where nothing is captured.
pub(super) fn velocities(scenario: &Scenario, study: &Study) -> Option<Figure> {
    let contacts = contacts(scenario, study);
    if contacts.is_empty() {
        return None;
    }
    let kinds = [
        ("tip, before", Colour::Blue, Shape::Circle),
        ("target, before", Colour::Vermillion, Shape::Square),
        ("both, after", Colour::Black, Shape::Cross),
    ];
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

fn contacts(scenario: &Scenario, study: &Study) -> Vec<Contact> {
    let mut contacts = Vec::new();
    for result in &study.cases {
        let (Some(captured), Some(end)) = (&result.capture, result.approach(study).end()) else { continue };
        for contact in &captured.impact.contacts {
            let Touching { target: i, arm, offset: [rx, ry], .. } = contact.touching;
            let (Some(target), Some(before)) = (scenario.targets.get(i), result.targets.get(i)) else { continue };
            let after = captured.impact.target_twists.get(i).copied();
            let (Some(tip), Some(after)) = (end.end_effector_twists.get(arm), after) else { continue };
            // v + ω × r
            let at_contact = |[omega, vx, vy]: [f64; 3]| [omega, vx - ry * omega, vy + rx * omega];
            let name = match (target.touches.len(), scenario.layout.arms.get(arm)) {
                (2.., Some(arm)) => format!("{}, {} at {}", result.name, target.name, arm.name),
                _ => format!("{}, {}", result.name, target.name),
            };
            contacts.push(Contact { name, twists: [*tip, at_contact(before.twist), at_contact(after)] });
        }
    }
    contacts.reverse(); // the first is to be on top
    contacts
}
