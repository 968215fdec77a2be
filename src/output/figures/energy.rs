//! The kinetic energy of robot and targets together, and what of it the work of the joints does not explain.

use super::figure::{Axis, Figure, Mark, Panel, Series};
use super::style::{Colour, Dash};
use super::time::{CURVE, LEAST};
use crate::capture::{CaseResult, Study};

/// Over the whole case: the second curve changes only at impacts, by what they cost.
pub(super) fn figure(study: &Study, result: &CaseResult) -> Figure {
    let approach = result.approach(study);
    let of_targets: f64 = result.targets.iter().map(|target| target.momentum().1).sum();
    let done = approach.end().map_or(0.0, |end| end.work.total());
    let before = approach.samples.iter().map(|now| {
        let energy = now.momentum.kinetic_energy + of_targets;
        (now.time, [energy, energy - now.work.total()])
    });
    let samples = result.capture.iter().flat_map(|captured| &captured.post_impact.samples);
    let after = samples.map(|now| {
        let energy = now.momentum.kinetic_energy;
        (approach.duration + now.time, [energy, energy - done - now.work.total()])
    });
    let all: Vec<(f64, [f64; 2])> = before.chain(after).collect();
    let curve = |label: &str, i: usize, colour: Colour, dash: Dash| Series {
        label: Some(label.to_owned()),
        colour,
        mark: Mark::Line(dash, CURVE),
        points: all.iter().map(|(time, values)| (*time, values[i])).collect(),
    };
    let series = vec![
        curve("kinetic energy", 0, Colour::Blue, Dash::Solid),
        curve("less the work done", 1, Colour::Vermillion, Dash::Dashed),
    ];
    let end = all.last().map_or(approach.duration, |(time, _)| *time);
    Figure::column(
        &format!("energy_{}", result.name),
        &format!("Kinetic energy of robot and targets together, and less the work of the actuators, {}.", result.name),
        vec![Panel::new(Axis::time("Time [s]", end), Axis::new("Energy [J]", LEAST), series)],
    )
}
