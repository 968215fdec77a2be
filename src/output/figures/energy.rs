//! The kinetic energy of robot and targets together, and the part of it that the work of the actuators does not
//! explain.

use super::figure::{Axis, Figure, Panel, Series};
use super::style::{Colour, Dash};
use super::time_curves::{CURVE_WIDTH, MINIMUM_SPAN};
use crate::capture::{CaseResult, Study};
use crate::output::time_series::rows;

/// Over the whole case: the second curve changes only at impacts, by the energy that they dissipate.
pub(super) fn figure(study: &Study, case: &CaseResult) -> Figure {
    let approach = &case.approach(study).samples;
    let mut points: [Vec<(f64, f64)>; 2] = Default::default();
    for (i, row) in rows(study, case).enumerate() {
        let earlier_work = if i < approach.len() { 0.0 } else { approach[approach.len() - 1].work.total() };
        let energy = row.total_momentum.kinetic_energy;
        points[0].push((row.time, energy));
        points[1].push((row.time, energy - earlier_work - row.sample.work.total()));
    }
    let end = points[0][points[0].len() - 1].0;
    let styles = [("kinetic energy", Colour::BLACK, Dash::Solid), ("less the work done", Colour::BLACK, Dash::Dashed)];
    let series = styles.into_iter().zip(points);
    let series = series.map(|((label, colour, dash), points)| Series::line(label, colour, dash, CURVE_WIDTH, points));
    Figure::column(
        &format!("energy_{}", case.name),
        vec![Panel::new(Axis::time("Time [s]", end), Axis::new("Energy [J]", MINIMUM_SPAN), series.collect())],
    )
}
