//! The twists of end effector and target at each contact, before and after the impact.

use super::figure::{Axis, AxisRange, Figure, Panel, Series};
use super::style::{Colour, Symbol};
use super::time_curves::{MINIMUM_SPAN, TWIST_COMPONENTS};
use crate::capture::contact_at_time::ImpactContact;
use crate::capture::{CaptureResult, CaseResult, Study};
use crate::contact::ContactKind;
use crate::output::impacts::{ImpactEvent, impacts, time_digits};
use crate::scenario::Scenario;

/// Of a symbol from the line of its contact, in parts of the distance of these lines: four of them have equal distances, half
/// of that between contacts.
const ASIDE: f64 = 0.1;

/// The twists of one contact, at the contact point.
struct ContactTwists {
    name: String,
    /// End effector before, target before, target after, end effector after.
    twists: [[f64; 3]; 4],
    rigid: bool,
}

/// One panel per component; `None` if there are no contacts.
pub(super) fn figure(scenario: &Scenario, study: &Study) -> Option<Figure> {
    let mut contacts = Vec::new();
    for case in &study.cases {
        let Some(capture) = &case.capture else { continue };
        let events = impacts(study, case);
        let digits = time_digits(&events.iter().map(|event| event.time).collect::<Vec<_>>());
        for (i, event) in events.iter().enumerate() {
            let time = (i > 0).then(|| format!(", {:.digits$} s", event.time));
            contacts.extend(contact_twists(scenario, case, capture, time.as_deref(), event));
        }
    }
    if contacts.is_empty() {
        return None;
    }
    contacts.reverse(); // the first at the top
    // the end effector above the line of its contact, the target below, and each after the impact beyond: equal velocities do
    // not hide each other
    let mut kinds = vec![
        ("end effector, before", Colour::BLACK, Symbol::Circle, ASIDE),
        ("target, before", Colour::GREY, Symbol::Square, -ASIDE),
    ];
    if contacts.iter().all(|contact| contact.rigid) {
        // both twists are the same
        kinds.push(("both, after", Colour::BLACK, Symbol::Cross, 0.0));
    } else {
        kinds.extend([
            ("target, after", Colour::GREY, Symbol::Plus, -3.0 * ASIDE),
            ("end effector, after", Colour::BLACK, Symbol::Cross, 3.0 * ASIDE),
        ]);
    }
    let panel = |(label, component): (&str, usize)| {
        let series = kinds.iter().enumerate().map(|(kind, (label, colour, symbol, aside))| {
            let points = (1_u32..).zip(&contacts).map(|(i, c)| (c.twists[kind][component], f64::from(i) + aside));
            Series::symbols(label, *colour, *symbol, points.collect())
        });
        let names = contacts.iter().map(|contact| contact.name.clone()).collect();
        let y = Axis { label: String::new(), range: AxisRange::Categories(names) };
        Panel::new(Axis::new(label, MINIMUM_SPAN), y, series.collect())
    };
    Some(Figure::column("impact_velocities", TWIST_COMPONENTS.map(panel).to_vec()))
}

/// The contacts of an impact of a case, with what tells its time where it is not the first one.
fn contact_twists(
    scenario: &Scenario,
    case: &CaseResult,
    capture: &CaptureResult,
    time: Option<&str>,
    event: &ImpactEvent<'_>,
) -> Vec<ContactTwists> {
    let after = &capture.post_impact.samples[event.after];
    let each = event.solution.contacts.iter().map(|result| {
        let ImpactContact { target, arm, law, offset: [rx, ry], .. } = result.contact;
        let (kind, body) = (law.kind(), &scenario.targets[target]);
        // v + ω × r
        let at_contact = |[omega, vx, vy]: [f64; 3]| [omega, vx - ry * omega, vy + rx * omega];
        let arm_name = (body.contacts.len() > 1).then(|| format!(" at {}", scenario.layout.arms[arm].name));
        let kind_name = (kind != ContactKind::Rigid).then(|| format!(" ({})", kind.name()));
        let additions: String = [arm_name, time.map(str::to_owned), kind_name].into_iter().flatten().collect();
        ContactTwists {
            name: format!("{}, {}{additions}", case.name, body.name),
            twists: [
                event.before.end_effector_twists[arm],
                at_contact(event.targets[target].twist),
                at_contact(event.solution.target_twists[target]),
                after.end_effector_twists[arm],
            ],
            rigid: kind.holds_yaw(),
        }
    });
    each.collect()
}
