//! The two figures.

use crate::long_time::{DURATION, LongTime, Run};
use crate::work::{Work, logarithms};
use planar_capture::output::figures::{Axis, AxisRange, Dash, Figure, Mark, Panel, Series};

const WIDTH: f64 = 1.4;
/// Number of maxima in a curve over time.
const PARTS: usize = 125;

/// Error over evaluations, a panel per motion.
pub fn work_precision(works: &[Work]) -> Figure {
    let panels = works.iter().map(|work| {
        let series = work.lines.iter().flat_map(|line| {
            let (colour, dash, shape) = line.method.style();
            let points: Vec<_> = line.points.iter().filter_map(|(_, point)| point.map(logarithms)).collect();
            [(Some(line.method.label()), Mark::Line(dash, WIDTH)), (None, Mark::Points(shape))]
                .map(|(label, mark)| Series { label, colour, mark, points: points.clone() })
        });
        let x = Axis { label: "Evaluations of the derivative".to_owned(), range: AxisRange::PowersOfTen(2, 6) };
        let y = Axis { label: "Error [rad, m, rad/s, m/s]".to_owned(), range: AxisRange::PowersOfTen(-16, 0) };
        Panel { title: Some(work.title.to_owned()), ..Panel::new(x, y, series.collect()) }
    });
    Figure::column("work_precision", panels.collect())
}

/// Energy and momentum errors over a thousand seconds, two panels per motion.
pub fn long_time(motions: &[LongTime]) -> Figure {
    let panel = |motion: &LongTime, quantity: &str, values: fn(&Run) -> &[(f64, f64)]| {
        let series = motion.runs.iter().map(|run| {
            let (colour, mut dash, _) = run.method.style();
            let finer =
                motion.runs.iter().any(|other| other.method == run.method && other.evaluations < run.evaluations);
            if finer {
                dash = if dash == Dash::Solid { Dash::DashDot } else { Dash::Dotted };
            }
            let label = Some(format!("{}, {}", run.method.label(), run.fineness));
            Series { label, colour, mark: Mark::Line(dash, WIDTH), points: maxima(values(run)) }
        });
        let x = Axis::time("Time [s]", DURATION);
        let y = Axis { label: format!("{quantity} error, relative"), range: AxisRange::PowersOfTen(-16, 0) };
        Panel { title: Some(motion.title.to_owned()), ..Panel::new(x, y, series.collect()) }
    };
    let panels = motions.iter().flat_map(|motion| {
        [panel(motion, "Energy", |run| &run.energy), panel(motion, "Momentum", |run| &run.momentum)]
    });
    Figure::column("long_time", panels.collect())
}

/// Logarithm of the largest value in each of `PARTS` intervals.
fn maxima(series: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let parts = series.get(1..).unwrap_or_default().chunks(series.len().div_ceil(PARTS).max(1));
    let of_part = |part: &[(f64, f64)]| {
        let most = part.iter().fold(1e-17_f64, |most, (_, error)| most.max(*error));
        part.last().map(|(time, _)| (*time, most.log10().clamp(-16.0, 0.0)))
    };
    parts.filter_map(of_part).collect()
}
