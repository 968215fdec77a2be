//! The overlaps of a case over time, and the outlines of the bodies that overlap at one instant.

use super::figure::{Axis, AxisRange, Figure, Panel, Series};
use super::robot::outline;
use super::style::{Colour, Dash, Symbol};
use crate::capture::clearance::LeastDistance;
use crate::capture::{CaseResult, Study};
use crate::frames::poses;
use crate::output::scene::visuals;
use crate::owned::RobotState;
use crate::scenario::Scenario;
use crate::simulate::system::Body;
use std::collections::BTreeSet;

const BAR: f64 = 5.0;

/// A row for each pair of bodies that overlap, and one for the pair with the least distance; `None` where all bodies
/// are joined.
pub(super) fn figure(study: &Study, case: &CaseResult) -> Option<Figure> {
    let clearance = &case.clearance;
    let least = clearance.least_shown()?;
    let mut pairs: Vec<&[String; 2]> = Vec::new();
    for bodies in clearance.overlaps.iter().map(|overlap| &overlap.bodies).chain([&least.bodies]) {
        if !pairs.contains(&bodies) {
            pairs.push(bodies);
        }
    }
    pairs.reverse(); // the first at the top
    #[allow(clippy::cast_precision_loss, reason = "a few pairs")]
    let row = |bodies: &[String; 2]| 1.0 + pairs.iter().position(|pair| *pair == bodies).expect("a listed pair") as f64;
    let bar = |(bodies, [from, to]): (&[String; 2], [f64; 2])| {
        Series::line("overlap", Colour::RED, Dash::Solid, BAR, vec![(from, row(bodies)), (to, row(bodies))])
    };
    let mut series: Vec<_> = clearance.overlaps.iter().map(|overlap| bar((&overlap.bodies, overlap.span))).collect();
    let LeastDistance { distance, time, bodies } = least;
    let label = format!("least distance, {distance:.4} m").replace('-', "−");
    series.push(Series::symbols(&label, Colour::BLACK, Symbol::Cross, vec![(*time, row(bodies))]));
    let end = end(study, case);
    let names = pairs.iter().map(|[a, b]| format!("{a}, {b}")).collect();
    let y = Axis { label: String::new(), range: AxisRange::Categories(names) };
    Some(Figure::column(&format!("clearance_{}", case.name), vec![Panel::new(Axis::time("Time [s]", end), y, series)]))
}

/// Of a case, s since the start of the approach.
fn end(study: &Study, case: &CaseResult) -> f64 {
    case.approach(study).duration + case.capture.as_ref().map_or(0.0, |capture| capture.post_impact.duration)
}

/// How near to its end an overlap is over, s: a contact, from which on the two are held, is located to 1e-9 s.
const ENDED: f64 = 1e-8;

/// The outlines of the bodies that overlap from a time on, s since the start of the approach.
pub(super) fn overlapping(
    scenario: &Scenario,
    (study, case): (&Study, &CaseResult),
    time: f64,
    state: &RobotState,
    targets: &[Body],
) -> Vec<Series> {
    let end = end(study, case);
    let lasts = |[from, to]: [f64; 2]| from <= time && (time < to - ENDED || to > end - ENDED);
    let now = case.clearance.overlaps.iter().filter(|overlap| lasts(overlap.span));
    let bodies: BTreeSet<&String> = now.flat_map(|overlap| &overlap.bodies).collect();
    let frames = scenario.frames();
    let poses = poses(&frames, state, &targets.iter().map(|target| target.pose).collect::<Vec<_>>());
    let placed = frames.iter().zip(poses).filter(|(frame, _)| bodies.contains(&frame.name));
    let shapes = visuals(scenario);
    placed
        .filter_map(|(frame, pose)| Some((shapes.iter().find(|visual| visual.frame == frame.name)?, pose)))
        .map(|(visual, pose)| outline("overlap", Colour::RED, Dash::Solid, &visual.shape, pose))
        .collect()
}
