//! Curves over the samples of a phase.

use super::figure::{Axis, Mark, Panel, Series};
use super::style::{Colour, Dash};
use crate::layout::Layout;
use crate::simulate::{Phase, Sample};

/// Width of a curve.
pub(super) const CURVE: f64 = 1.8;

/// Least span of an axis of angles, rad; rates, rad/s; lengths, m; velocities, m/s; torques, N m: less than anybody
/// wants to see of a robot, and more than rounding.
pub(super) const LEAST: f64 = 1e-6;

/// One quantity of the samples.
pub(super) fn curve(
    phase: &Phase,
    label: &str,
    colour: Colour,
    dash: Dash,
    value: impl Fn(&Sample) -> Option<f64>,
) -> Series {
    let points = phase.samples.iter().filter_map(|sample| Some((sample.time, value(sample)?))).collect();
    Series { label: Some(label.to_owned()), colour, mark: Mark::Line(dash, CURVE), points }
}

/// A curve per joint: the colour says which joint, the dash which arm.
pub(super) fn joints(layout: &Layout, phase: &Phase, value: impl Fn(&Sample) -> &[f64]) -> Vec<Series> {
    let mut series = Vec::new();
    for (i, arm) in layout.arms.iter().enumerate() {
        for k in 0..arm.links.len() {
            let (label, joint) = (format!("{} joint {}", arm.name, k + 1), series.len());
            series.push(curve(phase, &label, Colour::of(joint), Dash::of(i), |s| value(s).get(joint).copied()));
        }
    }
    series
}

/// A curve per arm of one component of a pose or twist of its end effector.
pub(super) fn end_effectors(
    layout: &Layout,
    phase: &Phase,
    component: usize,
    value: impl Fn(&Sample) -> &[[f64; 3]],
) -> Vec<Series> {
    let arms = layout.arms.iter().enumerate();
    arms.map(|(i, arm)| {
        curve(phase, &arm.name, Colour::of(i), Dash::of(i), |s| {
            value(s).get(i).map(|end_effector| end_effector[component])
        })
    })
    .collect()
}

/// A panel over the time of a phase.
pub(super) fn panel(phase: &Phase, time: &str, quantity: &str, series: Vec<Series>) -> Panel {
    Panel::new(Axis::time(time, phase.duration), Axis::new(quantity, LEAST), series)
}

/// Yaw, position and their rates of the base.
pub(super) fn base(phase: &Phase, time: &str) -> Vec<Panel> {
    let of = |label: &str, i: usize, value: fn(&Sample) -> &[f64; 3]| {
        let place = i.saturating_sub(1);
        curve(phase, label, Colour::of(place), Dash::of(place), move |s| Some(value(s)[i]))
    };
    let pose: fn(&Sample) -> &[f64; 3] = |s| &s.state.base_pose;
    let twist: fn(&Sample) -> &[f64; 3] = |s| &s.state.base_twist;
    vec![
        panel(phase, time, "Base yaw [rad]", vec![of("yaw", 0, pose)]),
        panel(phase, time, "Base position [m]", vec![of("x", 1, pose), of("y", 2, pose)]),
        panel(phase, time, "Base rate [rad/s]", vec![of("ω", 0, twist)]),
        panel(phase, time, "Base velocity [m/s]", vec![of("vx", 1, twist), of("vy", 2, twist)]),
    ]
}
